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
from typing import TypeVar

from rotator.runtime.state_thread import LOOKS_S as LOOKS_AGAIN_S
from rotator.store.hanging import writes
from rotator.store.state import State
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


class StateLane:
    """`rotator.runtime.state_thread` in simulated time: the newest is written, and noted in memory meanwhile."""

    def __init__(self, lane: Lane, state: State) -> None:
        self._lane, self._state = lane, state
        self._tried_s = 0.0

    def after(self, note: Callable[[T], None]) -> Callable[[T], None]:
        """This note, and then the state is written. On a card that hangs that begins in `work`."""

        def noted(newest: T) -> None:
            note(newest)
            if not self._lane.hangs:
                self.save()

        return noted

    def save(self) -> None:
        """Does not wait for a card that hangs."""
        self._lane(self._state.save)

    def work(self) -> None:
        """The card hangs: write what is new, or note it in memory while something older waits for the card."""
        if self._state.unspared or self._state.unwritten:
            if self._lane.busy:
                self._state.spare()
            else:
                self.save()
                self._lane.work()

    def look(self, now_s: float) -> None:
        """Save the same again: the card may have refused it, or the file have been changed."""
        if not self._lane.busy and now_s - self._tried_s >= LOOKS_AGAIN_S:
            self._tried_s = now_s
            self.save()
