"""Writes the counts of a rotor's axes to their file; the control thread never waits for the disk.

Knows that a motor may start only when the file marks its axis as moving, and that writing may take a second. Only one
thread touches the file.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from enum import Enum

from hw.ports import Axis
from rotator.store.counts import CountsFile, Place

Later = Callable[[Callable[[], None]], object]
"""Runs jobs soon, one after the other."""


def at_once(job: Callable[[], None]) -> None:
    """For simulated time, in which a disk takes no time."""
    job()


class Mark(Enum):
    NONE = "the file does not say that it moves"
    ASKED = "the file is being written"
    SET = "the file says that it moves"
    REFUSED = "the file cannot be written"


class CountsWriter:
    """`later`: how the file is written; None: by a thread of its own, which `close` ends."""

    def __init__(self, file: CountsFile, later: Later | None = None) -> None:
        self._file = file
        self._pool = ThreadPoolExecutor(1, "counts") if later is None else None
        self._later: Later = self._pool.submit if self._pool else later or at_once
        self._marks = dict.fromkeys(Axis, Mark.NONE)

    def load(self) -> dict[Axis, Place]:
        """The kept counts; to be called first."""
        return self._file.load()

    def may_start(self, axis: Axis) -> bool:
        """Whether the motor may start now. False: not yet (ask again), or never (`trouble`)."""
        if self._marks[axis] in (Mark.NONE, Mark.REFUSED):
            self._marks[axis] = Mark.ASKED
            self._later(lambda: self._mark(axis))
        return self._marks[axis] is Mark.SET

    def trouble(self, axis: Axis) -> str:
        """Why it may not start; empty: it may, or soon."""
        return self._file.trouble if self._marks[axis] is Mark.REFUSED else ""

    def rests(self, now_s: float, axis: Axis, angle_deg: float) -> None:
        """The axis stands at this angle, and its count is certain."""
        self._marks[axis] = Mark.NONE
        self._later(lambda: self._file.rest(now_s, axis, angle_deg))

    def lost(self, axis: Axis) -> None:
        self._later(lambda: self._file.lose(axis))

    def homed(self, axis: Axis, angle_deg: float) -> None:
        self._marks[axis] = Mark.NONE
        self._later(lambda: self._file.home(axis, angle_deg))

    def close(self) -> None:
        """Write what is waiting, and end the thread."""
        self._later(self._file.close)
        if self._pool:
            self._pool.shutdown(wait=True)

    def _mark(self, axis: Axis) -> None:
        self._marks[axis] = Mark.SET if self._file.start(axis) else Mark.REFUSED
