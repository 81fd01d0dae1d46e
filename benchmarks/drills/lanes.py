"""The threads of the box that write files, in simulated time: at once as a rule, and in a real thread on a card that
hangs.

Knows that a thread does one job after the other, and when a job waits for the card: its file is under way and the job
has not ended. So a drill is the same each time. Knows no file's content.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Generic, TypeVar

from rotator.runtime.latch_thread import LOOKS_S as SAVES_AGAIN_S
from rotator.store.hanging import writes
from rotator.store.whole import NEW

T = TypeVar("T")
LOOKS_S, GIVES_UP_S = 0.0005, 20.0


class Lane:
    """One thread. `pipe`: where the new content of its file is written. `hangs`: whether the card hangs."""

    def __init__(self, pipe: Path, hangs: Callable[[], bool]) -> None:
        self._file = pipe.with_name(pipe.name.removesuffix(NEW)).resolve()
        self._hangs = hangs
        self._jobs: deque[Callable[[], object]] = deque()
        self._thread: threading.Thread | None = None

    @property
    def busy(self) -> bool:
        """Whether a job waits for the card."""
        return self._thread is not None

    @property
    def hangs(self) -> bool:
        return self._hangs()

    def __call__(self, job: Callable[[], object]) -> None:
        """Do this job after those that came before. On a card that hangs it begins in `work`: its caller may hold what
        the job needs."""
        if self.busy or self.hangs:
            self._jobs.append(job)
        else:
            job()

    def work(self) -> None:
        """The card hangs: begin the jobs that have come, up to the first one that waits for the card."""
        while self._jobs and self._thread is None:
            self._thread = threading.Thread(target=self._jobs.popleft(), daemon=True)
            self._thread.start()
            while self._thread.is_alive() and self._file not in writes().values():
                self._thread.join(LOOKS_S)
            if self._file not in writes().values():
                self._thread = None

    def join(self) -> None:
        """The hang ends: wait for the job that waited for the card."""
        if self._thread is not None:
            self._thread.join(GIVES_UP_S)
            assert not self._thread.is_alive(), "the write has not returned"
            self._thread = None

    def catch_up(self) -> None:
        """Do the jobs that came meanwhile."""
        while self._jobs:
            self._jobs.popleft()()


class KeptLane(Generic[T]):
    """`rotator.runtime.latch_thread` in simulated time: the newest note is written, and noted in memory meanwhile."""

    def __init__(self, lane: Lane, save: Callable[[T], bool], spare: Callable[[T], None], kept: T) -> None:
        self._lane, self._save, self._spare = lane, save, spare
        self._newest = kept
        self._tried_s = 0.0
        self._fresh = False
        """The newest note has come since the card hangs, and is nowhere yet."""

    def start(self) -> None:
        self.note(self._newest)

    def note(self, newest: T) -> None:
        self._newest = newest
        if self._lane.hangs:
            self._fresh = True
        else:
            self._lane(lambda: self._save(newest))

    def work(self) -> None:
        """The card hangs: write the newest note, or note it in memory while an older one waits for the card."""
        if self._fresh:
            self._fresh, newest = False, self._newest
            if self._lane.busy:
                self._spare(newest)
            else:
                self._lane(lambda: self._save(newest))
                self._lane.work()

    def end(self, save: Callable[[T], bool]) -> None:
        """The program ends: write the present state this way. It does not wait for a card that hangs."""
        self._lane(lambda: save(self._newest))

    def look(self, now_s: float) -> None:
        """Save the same again: the card may have refused it, or the file have been changed."""
        if not self._lane.busy and (self._fresh or now_s - self._tried_s >= SAVES_AGAIN_S):
            self._tried_s, self._fresh = now_s, False
            self.note(self._newest)
