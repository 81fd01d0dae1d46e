"""Writes the counts of a rotor's axes to their file, in a thread of its own: a write may take a second.

Knows that the control loop must not wait for a disk, and that a motor may start only after the file marks its axis
as moving. Does not know the file's form, nor which angle to write: `rotator.store.counts` does.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from enum import Enum
from queue import SimpleQueue

from hw.ports import Axis
from rotator.store.counts import CountsFile, Place
from rotator.store.hanging import HANGS, Hanging

COUNTS_THREAD = "counts"
"""The writing thread's name."""
CLOSES_S = 2.0
"""The end of the program waits for this time at most: a card may hang."""

Later = Callable[[Callable[[], None]], object]
"""Runs a job soon, one job after the other."""


def at_once(job: Callable[[], None]) -> None:
    """Run a job now: for simulated time, where a write takes no time."""
    job()


class Mark(Enum):
    """Whether the file marks an axis as moving."""

    NONE = "not marked"
    ASKED = "the mark is being written"
    SET = "marked as moving"
    REFUSED = "the mark could not be written"


class _Jobs:
    """A thread that does jobs one after the other, until `end`."""

    def __init__(self) -> None:
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name=COUNTS_THREAD, daemon=True)
        self._thread.start()

    def __call__(self, job: Callable[[], None]) -> None:
        self._jobs.put(job)

    def end(self, patience_s: float) -> None:
        """Do what has been asked, and end. Returns after this time, also while a job hangs."""
        self._jobs.put(None)
        self._thread.join(patience_s)

    def _run(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()


class CountsWriter:
    """`later` runs the writing jobs; None: the writer starts a thread for them, which `close` ends.

    May be used from any thread. After `may_start` returned True, the caller must not call `rests` before the relay
    closes. After `close` no motor may start, and the other calls do nothing: a sensor thread may outlive the rotor.
    """

    def __init__(self, file: CountsFile, later: Later | None = None) -> None:
        self._file = file
        self._thread = _Jobs() if later is None else None
        self._run_later: Later = self._thread or later or at_once
        self._marks = dict.fromkeys(Axis, Mark.NONE)
        self._requests = dict.fromkeys(Axis, 0)
        """The number of the latest request for a mark. The result of an older request is ignored, and so is one that a
        rest followed: the file may already say that the axis stands."""
        self._lock = threading.RLock()
        """Reentrant, because `at_once` runs its jobs within a call."""
        self._hanging: dict[Axis, Hanging[int]] = {axis: Hanging() for axis in Axis}
        self._closed = False

    def load(self) -> dict[Axis, Place]:
        """The counts of the last run. Call this first."""
        return self._file.load()

    def may_start(self, axis: Axis) -> bool:
        """Whether the motor may start now. False: not yet (ask again), or not at all (`trouble` says why)."""
        with self._lock:
            if self._closed:
                return False
            if self._marks[axis] in (Mark.NONE, Mark.REFUSED):
                self._new_state(axis, Mark.ASKED)
                request = self._requests[axis]
                self._later(lambda: self._mark(axis, request))
            return self._marks[axis] is Mark.SET

    def trouble(self, axis: Axis, now_s: float) -> str:
        """Why the motor may not start; empty when it may start now or soon. Ask again and again."""
        awaited = [self._requests[axis]] if self._marks[axis] is Mark.ASKED else []
        if self._hanging[axis].look(awaited, now_s):
            return f"its file is not written: {HANGS}"
        return self._file.trouble if self._marks[axis] is Mark.REFUSED else ""

    def rests(self, axis: Axis, angle_deg: float, travelled_deg: float = 0.0) -> None:
        """The axis stands at this angle on the rotor's own scale, and its count is right."""
        with self._lock:
            self._new_state(axis, Mark.NONE)
            self._later(lambda: self._file.rest(axis, angle_deg, travelled_deg))

    def lost(self, axis: Axis) -> None:
        """The count of the axis may be wrong. Call this repeatedly: a card may have refused the write."""
        self._later(lambda: self._file.lose(axis))

    def homed(self, axis: Axis, angle_deg: float) -> None:
        """The axis was found at this angle on the rotor's own scale."""
        with self._lock:
            self._new_state(axis, Mark.NONE)
            self._later(lambda: self._file.home(axis, angle_deg))

    def close(self, patience_s: float = CLOSES_S) -> None:
        """Write the angle of each axis that stands, and end the thread; do not wait for a card that hangs.

        May be called twice.
        """
        with self._lock:
            if not self._closed:
                self._run_later(self._file.close)
            self._closed = True
        if self._thread:
            self._thread.end(patience_s)

    def _later(self, job: Callable[[], None]) -> None:
        with self._lock:
            if not self._closed:
                self._run_later(job)

    def _new_state(self, axis: Axis, mark: Mark) -> None:
        self._requests[axis] += 1
        self._marks[axis] = mark

    def _mark(self, axis: Axis, request: int) -> None:
        """Runs in the writing thread."""
        done = self._file.start(axis)
        with self._lock:
            if request == self._requests[axis]:
                self._marks[axis] = Mark.SET if done else Mark.REFUSED
