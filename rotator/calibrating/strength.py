"""The question for a receiver's signal strength, as Hamlib's rigctld answers it, and what an answer means.

Knows lines of text: the strength comes in decibels, 0 is S9. Knows no socket and no clock.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

PORT = 4532
"""rigctld's own."""
ASKS_VFO = b"\\chk_vfo\n"
"""A rigctld that was started with --vfo wants a VFO in each question."""
_NUMBER = re.compile(r"[-+]?[0-9]{1,4}(?:\.[0-9]+)?")
_REFUSED = "RPRT "
_NOT_THERE = ("-4", "-11")
SHOWN = 40


@dataclass(frozen=True, slots=True)
class Strength:
    """The receiver's answer at this moment. `problem`: why it has no strength; empty: it has one.

    `asked_s`: when it was asked; None: at this moment. It may answer seconds later, of any moment in between.
    """

    at_s: float
    strength_db: float = 0.0
    problem: str = ""
    asked_s: float | None = None

    def is_of(self, begin_s: float) -> bool:
        """Whether the strength is of a moment after `begin_s`."""
        return not self.problem and (self.at_s if self.asked_s is None else self.asked_s) >= begin_s


class NoStrength(ValueError):  # noqa: N818 - a sentence for a person
    """What the receiver answered in place of a strength."""


def question(*, names_vfo: bool) -> bytes:
    return b"l currVFO STRENGTH\n" if names_vfo else b"l STRENGTH\n"


def wants_vfo(answer: str) -> bool:
    """Older ones answer `CHKVFO 1`."""
    return answer.split()[-1:] == ["1"]


def strength_db(answer: str) -> float:
    """Raises NoStrength."""
    text = answer.strip()
    if _NUMBER.fullmatch(text) and math.isfinite(float(text)):
        return float(text)
    if text.startswith(_REFUSED):
        code = text.removeprefix(_REFUSED)
        if code in _NOT_THERE:
            raise NoStrength(f"it cannot tell a strength: Hamlib's driver for it has no S meter ({text})")
        raise NoStrength(f"it refuses to tell its strength ({text}): is it switched on and connected?")
    raise NoStrength(f"it answers {text[:SHOWN]!r} for a strength: is that a rigctld?")
