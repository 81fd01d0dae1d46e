"""Keeps the counts of a rotor's axes in their file, and never makes the control thread wait for a disk.

Knows that a motor may start only when the file says that its axis moves, and that a write may take a second. Only one
thread touches the file.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from enum import Enum

from hw.ports import Axis
from rotator.store.counts import CountsFile, Place

COUNTS_THREAD = "counts"
"""How the name of the writing thread begins."""

Later = Callable[[Callable[[], None]], object]
"""Runs a job soon, one job after the other."""


def at_once(job: Callable[[], None]) -> None:
    """Runs a job now: for simulated time, in which a disk takes none."""
    job()


class Mark(Enum):
    NONE = "the file does not say that it moves"
    ASKED = "the file is being told"
    SET = "the file says that it moves"
    REFUSED = "the file cannot be written"


class CountsWriter:
    """`later` runs the writing jobs; None: a thread of the writer's own does, which `close` ends.

    After `close` no motor may start, and what the other calls say is dropped: a sensor thread may outlive the rotor.
    """

    def __init__(self, file: CountsFile, later: Later | None = None) -> None:
        self._file = file
        self._pool = ThreadPoolExecutor(1, COUNTS_THREAD) if later is None else None
        self._run_later: Later = self._pool.submit if self._pool else later or at_once
        self._marks = dict.fromkeys(Axis, Mark.NONE)
        self._closing = threading.Lock()
        self._closed = False

    def load(self) -> dict[Axis, Place]:
        """What the last run left. To be called before any other method."""
        return self._file.load()

    def may_start(self, axis: Axis) -> bool:
        """Whether the motor may start now. False: not yet (ask again), or not at all (`trouble` says why)."""
        if self._closed:
            return False
        if self._marks[axis] in (Mark.NONE, Mark.REFUSED):
            self._marks[axis] = Mark.ASKED
            self._later(lambda: self._mark(axis))
        return self._marks[axis] is Mark.SET

    def trouble(self, axis: Axis) -> str:
        """Why the motor may not start; empty: it may, now or soon."""
        return self._file.trouble if self._marks[axis] is Mark.REFUSED else ""

    def rests(self, now_s: float, axis: Axis, angle_deg: float) -> None:
        """The axis stands at this angle on the rotor's own scale, and its count is sure."""
        self._marks[axis] = Mark.NONE
        self._later(lambda: self._file.rest(now_s, axis, angle_deg))

    def lost(self, axis: Axis) -> None:
        self._later(lambda: self._file.lose(axis))

    def homed(self, axis: Axis, angle_deg: float) -> None:
        self._marks[axis] = Mark.NONE
        self._later(lambda: self._file.home(axis, angle_deg))

    def close(self) -> None:
        """Write where each axis stands, and end the thread. May be called twice."""
        with self._closing:
            if not self._closed:
                self._run_later(self._file.close)
            self._closed = True
        if self._pool:
            self._pool.shutdown(wait=True)

    def _later(self, job: Callable[[], None]) -> None:
        with self._closing:
            if not self._closed:
                self._run_later(job)

    def _mark(self, axis: Axis) -> None:
        self._marks[axis] = Mark.SET if self._file.start(axis) else Mark.REFUSED
