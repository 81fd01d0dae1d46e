"""The memory card of the box of a drill: it refuses to be written, as a full or read-only one does; or it hangs.

Knows the names of the files in its state folder, how a file is replaced, and the threads that write files: at once as a
rule, and in a real thread on a card that hangs. What can be read stays readable. A write that a hanging card has begun
returns when the hang ends, with an error. A job waits for the card when its file is under way and the job has not
ended, so a drill is the same each time.
"""

from __future__ import annotations

import os
import shutil
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from rotator.runtime.state_thread import LOOKS_S as LOOKS_AGAIN_S
from rotator.store import counts
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


STATE = "state.json"
NAMES = (STATE, counts.FILE_NAME)
WORKS, REFUSES, REFUSES_LATER, HANGS = 0.0, 1.0, 2.0, 3.0
"""The numbers of an event `card`. `REFUSES_LATER`: it refuses from the next end of the program on, so that the next run
finds the content from before."""


WAYS = ("deleted", "emptied", "garbled", "older")
"""How another program or a person changes a file."""
NOTICES_S = 11.0
"""Within this time the running box writes a changed file again."""


class Card:
    """`folder`: with the state files. `memory`: the folder that stands for the service's memory."""

    def __init__(self, folder: Path, memory: Path) -> None:
        self.folder, self.memory = folder, memory
        self._state = WORKS
        self._lanes: list[Lane] = []
        self._older: dict[str, bytes] = {}
        """By file: what it held when a run of the program began."""
        self._changed: dict[str, tuple[float, bytes | None, bytes | None]] = {}
        """By file: when it was changed under the running box, and what it held before and after; None: there was no
        such file."""

    @property
    def hangs(self) -> bool:
        return self._state == HANGS

    @property
    def waited_for(self) -> bool:
        """Whether a write is under way that does not return."""
        return any(lane.busy for lane in self._lanes)

    def lane(self, name: str) -> Lane:
        """The thread of this run of the program that writes this file."""
        self._lanes.append(Lane(self.folder / (name + NEW), lambda: self.hangs))
        return self._lanes[-1]

    def become(self, state: float) -> None:
        """From now on it works, refuses, or hangs; or refuses from the next end of the program on."""
        if state == self._state:
            return
        before, self._state = self._state, state
        if before == HANGS:
            self._let_go()
            for lane in self._lanes:
                lane.catch_up()
        for name in NAMES:
            where = self.folder / (name + NEW)
            if before == REFUSES and where.is_dir():
                where.rmdir()
            # A folder takes the name under which the new content would first be written; a pipe that no program reads
            # keeps its writer waiting.
            if state == REFUSES:
                where.mkdir(exist_ok=True)
            elif state == HANGS:
                where.unlink(missing_ok=True)
                os.mkfifo(where)

    def work(self) -> None:
        """While it hangs: the threads begin what has come for them."""
        for lane in self._lanes:
            lane.work()

    def change(self, name: str, how: str, now_s: float) -> None:
        """Another program or a person changes this file."""
        path = self.folder / name
        before = _held(path)
        if how == "deleted" or (how == "older" and name not in self._older):
            path.unlink(missing_ok=True)
        else:
            path.write_bytes({"emptied": b"", "garbled": b"\x00{}" * 40}.get(how) or self._older.get(name, b""))
        self._changed[name] = now_s, before, _held(path)

    def program_begins(self) -> None:
        """A run has begun: its files as they are now."""
        for name in NAMES:
            if (held := _held(self.folder / name)) is not None:
                self._older[name] = held

    def end_program(self, now_s: float, end: Callable[[], None], *, killed: bool) -> None:
        """The program ends."""
        if killed or self.hangs:
            with self._as_it_is():
                end()
        else:
            end()
        self._lanes.clear()
        self._put_back(now_s)
        if self._state == REFUSES_LATER:
            self.become(REFUSES)

    def _put_back(self, now_s: float) -> None:
        """A person puts back what was changed so late that the box could not write it again: a box that counts, and one
        with a weld or a stop, cannot know better than their files."""
        for name, (at_s, before, after) in self._changed.items():
            path = self.folder / name
            if now_s - at_s >= NOTICES_S or _held(path) != after:
                continue
            if before is None:
                path.unlink(missing_ok=True)
            else:
                path.write_bytes(before)
        self._changed.clear()

    @contextmanager
    def _as_it_is(self) -> Iterator[None]:
        """Within it the program ends: what its threads still wait for is never written."""
        kept = [(folder, folder.with_name(f"kept-{folder.name}")) for folder in (self.folder, self.memory)]
        for folder, copy in kept:
            shutil.copytree(folder, copy, ignore=_pipes)
        yield
        state, self._state = self._state, WORKS
        if state == HANGS:
            self._let_go()
        self._lanes.clear()
        for folder, copy in kept:
            shutil.rmtree(folder)
            copy.rename(folder)
        if state == HANGS:
            self.become(HANGS)
        else:
            self._state = state

    def _let_go(self) -> None:
        """End the hang: every write that is under way fails."""
        pipes = [self.folder / (name + NEW) for name in NAMES]
        ends = [os.open(pipe, os.O_RDONLY | os.O_NONBLOCK) for pipe in pipes if pipe.is_fifo()]
        for lane in self._lanes:
            lane.join()
        while any(path.parent == self.folder.resolve() for path in writes().values()):
            time.sleep(LOOKS_S)  # the first write of a run has a thread of its own
        for end in ends:
            os.close(end)
        for pipe in pipes:
            pipe.unlink(missing_ok=True)


def _held(path: Path) -> bytes | None:
    return path.read_bytes() if path.is_file() else None


def _pipes(folder: str, names: list[str]) -> list[str]:
    return [name for name in names if Path(folder, name).is_fifo()]
