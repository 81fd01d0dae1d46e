"""The file that keeps a latched stop or a storm park: after a restart of the program or the Pi it still holds.

Knows the file's form, and that a damaged file means a stop: the box cannot know that there was none. Written only when
a stop begins or ends, because each write wears the card. Does not know who may stop or release the antenna.
"""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Any

from rotator.exchange.status import Latch
from rotator.store.forms import Form
from rotator.store.spared import SparedFile

FILE_NAME = "latch.json"
"""Beside the state file."""
FORM = Form("rotator latch")
BEFORE = " before the restart"
LONGEST_NAME = 200
DAMAGED = Latch(f"the damaged file {FILE_NAME}")
"""The box gives this as the sender of the stop when it cannot read its file."""


class Kept(Enum):
    """The states in the file."""

    NOTHING = "no stop"
    STOP = "a stop"
    STORM = "a storm park"
    UNKNOWN = "not readable, or not written to the card"


class LatchFile:
    """Call `load` first, then `save` after each change. Failures go to the log, and nothing is raised."""

    def __init__(self, path: Path, memory: Path | None = None) -> None:
        """`memory`: a folder that outlives the program, and not a boot; None: there is none."""
        self._file = SparedFile(path, FORM, "a latched stop", memory)
        self._kept = Kept.NOTHING

    @property
    def outlives(self) -> bool:
        """Whether what was saved last outlives the program: it is on the card, or in memory."""
        return self._file.outlives

    def load(self) -> Latch | None:
        """The stop that the last run left, in words for the new run; None: no stop."""
        latch = self._file.load(
            _parse, absent=None, damaged=DAMAGED, consequence="it may have kept a stop: nothing moves until resume"
        )
        # A state in memory only would not outlive a power cut: the next `save` writes it to the card.
        self._kept = Kept.UNKNOWN if latch is DAMAGED or self._file.in_memory else _kind(latch)
        if latch is None or latch is DAMAGED:
            return latch
        return Latch(latch.by.removesuffix(BEFORE) + BEFORE, storm=latch.storm)

    def save(self, latch: Latch | None) -> bool:
        """Write it, unless the file already has it: a repeated stop is the same stop. False: the write failed.

        Call it again now and then: another program may have changed the file.
        """
        if self._kept is _kind(latch) and not self._file.changed:
            return True
        done = self._file.save(_content(latch))
        self._kept = _kind(latch) if done else Kept.UNKNOWN
        return done

    def spare(self, latch: Latch | None) -> None:
        """Note it in memory, while another thread still waits for the card. May be called from any thread."""
        self._file.note(_content(latch))

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._file.trouble


def _content(latch: Latch | None) -> dict[str, object]:
    return {"by": latch.by if latch else "", "storm": latch is not None and latch.storm}


def _kind(latch: Latch | None) -> Kept:
    if latch is None:
        return Kept.NOTHING
    return Kept.STORM if latch.storm else Kept.STOP


def _parse(content: dict[str, Any]) -> Latch | None:
    by, storm = content["by"], content["storm"]
    if not isinstance(by, str) or len(by) > LONGEST_NAME or not by.isprintable():
        raise ValueError("by is no name of a sender")
    if not isinstance(storm, bool) or (storm and not by):
        raise ValueError("storm is not true or false, or names no sender")
    return Latch(by, storm=storm) if by else None
