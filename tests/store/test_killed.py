"""A program that is killed at any line while it writes the state, by a kill or a power cut, leaves a stop that holds.

A kill leaves the card and memory to the next run, a power cut the card alone. What was kept before is there, or what is
new; never nothing.
"""

from __future__ import annotations

import itertools
import os
import shutil
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

import rotator.store.state
from rotator.exchange.status import Latch
from rotator.store.latch import BEFORE, LATCH
from rotator.store.learnt import KNOBS
from rotator.store.state import EARLIER, Sections, State
from tests.refusing import refuse
from tests.search import some

FOLDER = str(Path(rotator.store.state.__file__).parent)
EARLIER_FILES = Path(__file__).parents[1] / "formats" / "1"
OLD, NEW = Latch("page#1"), Latch("console#2", storm=True)
DONE, KILLED = 0, 1


def killed_at(line: int, job: Callable[[], object]) -> bool:
    """Do the job in a process that dies at this line of the store. Returns whether it came so far."""
    child = os.fork()
    if child == 0:
        left = line

        def traced(frame: FrameType, event: str, _arg: Any) -> Any:
            nonlocal left
            if not frame.f_code.co_filename.startswith(FOLDER):
                return None
            left -= event == "line"
            if left < 0:
                os._exit(KILLED)
            return traced

        sys.settrace(traced)
        job()
        os._exit(DONE)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == KILLED


def left(path: Path, memory: Path | None) -> Latch | None:
    found = State(path, memory).load(LATCH)
    return found and Latch(found.by.removesuffix(BEFORE), storm=found.storm)


def lines(begin: Callable[[Path], object], job: Callable[[Path], object], folder: Path) -> list[tuple[Path, bool]]:
    """For lines throughout the job: a folder in which it was killed there; and whether the job was over by then."""

    def over_by(line: int) -> tuple[Path, bool]:
        place = folder / str(line)
        place.mkdir()
        begin(place)
        return place, not killed_at(line, lambda: job(place))

    last = next(line for line in itertools.count(100, 100) if over_by(line)[1])
    return [over_by(line) for line in [*some([line for line in range(last) if line % 100]), last + 1]]


@pytest.mark.search
@pytest.mark.parametrize("refuses", [False, True])
@pytest.mark.parametrize(("old", "new"), [(None, NEW), (OLD, NEW), (NEW, None)])
def test_killed_while_a_stop_changes(tmp_path: Path, old: Latch | None, new: Latch | None, *, refuses: bool) -> None:
    def begin(place: Path) -> None:
        State(place / "state.json").keep(LATCH, old)
        if refuses:
            refuse(place / "state.json")

    def job(place: Path) -> None:
        State(place / "state.json", place / "memory").keep(LATCH, new)

    for place, over in lines(begin, job, tmp_path):
        path, memory = place / "state.json", place / "memory"
        after_a_kill, after_a_cut = left(path, memory), left(path, None)
        assert after_a_kill in ((new,) if over else (old, new))
        assert after_a_cut in ((old,) if refuses else (old, new))
        assert after_a_cut != new or after_a_kill == new, "memory never hides what is newer"


@pytest.mark.search
def test_killed_while_yesterday_s_files_are_taken_over(tmp_path: Path) -> None:
    def begin(place: Path) -> None:
        for name in EARLIER:
            if (file := EARLIER_FILES / f"{name}.json").exists():
                shutil.copy(file, place)
        shutil.copy(EARLIER_FILES / "g5500-state.json", place / "state.json")

    def job(place: Path) -> None:
        State(place / "state.json", place / "memory").save()

    for place, over in lines(begin, job, tmp_path):
        for memory in (None, place / "memory"):
            state = State(place / "state.json", memory)
            assert state.load(LATCH) == Latch("console#3", storm=True)
            assert state.load(KNOBS)
            assert "learnt" in state.sections
        assert not over or [each.name for each in place.iterdir() if each.is_file()] == ["state.json"]


class Watched(State):
    """Says after each write what a next run would know, if the program were killed now."""

    other: threading.Thread
    known: Latch | None = None
    spared = False
    """Whether the other thread had done its part by then."""

    def _write(self, newest: Sections) -> bool:
        done = super()._write(newest)
        self.spared = self.other.ident is not None and not self.other.is_alive()
        self.known = left(self.path, self.path.parent / "memory")
        return done


@pytest.mark.search
def test_what_another_thread_notes_at_any_line_of_a_write_is_not_hidden_by_it(tmp_path: Path) -> None:
    """Above all where that is what the card had before."""
    seen = 0
    for line in some(range(320)):
        state = Watched(tmp_path / str(line) / "state.json", tmp_path / str(line) / "memory")
        state.other = threading.Thread(target=lambda: None)
        state.keep(LATCH, OLD)
        state.note(LATCH, None)
        state.other = threading.Thread(target=lambda state=state: (state.note(LATCH, OLD), state.spare()))
        meanwhile_at(line, state.other, state.save)
        if state.other.ident is not None:
            state.other.join()
            assert left(state.path, state.path.parent / "memory") == OLD
        if state.spared:
            seen += 1
            assert state.known == OLD
    assert seen > 1


def meanwhile_at(line: int, other: threading.Thread, job: Callable[[], object]) -> None:
    """Do the job; at this line of the store the other thread runs as far as the locks let it."""
    left = line

    def traced(frame: FrameType, event: str, _arg: Any) -> Any:
        nonlocal left
        if not frame.f_code.co_filename.startswith(FOLDER):
            return None
        left -= event == "line"
        if left < 0 and other.ident is None:
            other.start()
            other.join(0.05)
        return traced

    before = sys.gettrace()
    sys.settrace(traced)
    try:
        job()
    finally:
        sys.settrace(before)
