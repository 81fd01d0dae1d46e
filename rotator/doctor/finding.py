"""The parts of a `rotator doctor` report: a check, its findings, and the mark and colour of each finding.

Knows the form of a check and the four marks. Does not know any single check, nor how the report is laid out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, ParamSpec

from hw.ports import HardwareError
from rotator.config.model import Config

P = ParamSpec("P")


class Mark(StrEnum):
    """The character in front of a finding."""

    GOOD = "✓"
    WRONG = "✗"
    WARNING = "!"
    SKIPPED = "–"

    @property
    def colour(self) -> str:
        """The style in `rich`'s words."""
        return _COLOURS[self]


_COLOURS = {Mark.GOOD: "green", Mark.WRONG: "bold red", Mark.WARNING: "yellow", Mark.SKIPPED: "dim"}


@dataclass(frozen=True, slots=True)
class Finding:
    """One result of a check. `ok` None: not checked, or nothing to check. `ok` True with an `advice` is a warning."""

    ok: bool | None
    found: str
    advice: str = ""

    @property
    def mark(self) -> Mark:
        match self.ok:
            case None:
                return Mark.SKIPPED
            case False:
                return Mark.WRONG
            case True:
                return Mark.WARNING if self.advice else Mark.GOOD


def fine(found: str) -> Finding:
    return Finding(True, found)


def warn(found: str, advice: str) -> Finding:
    return Finding(True, found, advice)


def wrong(found: str, advice: str) -> Finding:
    return Finding(False, found, advice)


def skipped(found: str, advice: str = "") -> Finding:
    """A check that was not made. `advice`: what the user can check by hand instead."""
    return Finding(None, found, advice)


def refused(about: str, fault: HardwareError) -> Finding:
    """A driver's error as a finding about this part. The text after the error's first semicolon is the advice."""
    problem, _, cure = str(fault).partition("; ")
    return wrong(
        f"{about}: {problem}", f"{cure[:1].upper()}{cure[1:]}." if cure else "See: rotator help troubleshooting"
    )


@dataclass(frozen=True, slots=True)
class Check(Generic[P]):
    """One check: its name, a sentence for the documentation, and the function that returns its findings."""

    name: str
    looks_at: str
    look: Callable[P, Iterator[Finding]]
    on_chips: bool = False
    """The check reads chips, so it also runs on a simulated station."""
    alone: bool = False
    """It uses chips or lines that a running box uses too, so it is left out while the box runs."""
    on_a_pi: bool = False
    """It reads what only the system of a Raspberry Pi has, and only of a rotor that is real."""
    concerns: Callable[[Config], object] = lambda config: config
    """Whether the configuration uses the checked part. False: the report leaves the check out."""
