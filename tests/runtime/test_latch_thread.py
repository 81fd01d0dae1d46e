"""The thread that writes a latched stop: the newest counts, however slow or broken the card is, and at the end too."""

from __future__ import annotations

import itertools
import queue
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import pytest

from rotator.exchange.status import Latch
from rotator.runtime.latch_thread import LatchThread
from rotator.store.latch import BEFORE, DAMAGED, LatchFile
from tests.search import some

PATIENCE_S = 20.0
Events = tuple[Latch | str | None, ...]
STOP, STORM = Latch("panel"), Latch("console#3", storm=True)
END = "end"
"""The box ends: nothing is noted after this."""


class SlowCard:
    """A card on which each write takes a while. Meanwhile other threads do what `script` says, write by write.

    Each entry of `script`: what they do before the old content is replaced, what they do after it, and whether the
    card takes the write. When the script is over the card is quick, and takes every write.
    """

    def __init__(self, file: LatchFile, script: Sequence[tuple[Events, Events, bool]]) -> None:
        self._file = file
        self._script = iter(script)
        self.others: Callable[[Latch | str | None], None] = lambda _event: None

    def save(self, latch: Latch | None) -> bool:
        before, after, takes = next(self._script, ((), (), True))
        for event in before:
            self.others(event)
        done = takes and self._file.save(latch)
        for event in after:
            self.others(event)
        return done


def left_in(path: Path) -> Latch | None:
    return LatchFile(path).load()


def begun(path: Path) -> LatchThread[Latch | None]:
    file = LatchFile(path)
    thread = LatchThread(file.save, file.load())
    thread.start()
    return thread


def come(path: Path) -> bool:
    """Whether the file is there, soon."""
    end_s = time.monotonic() + PATIENCE_S
    waits = threading.Event()
    while not path.exists() and time.monotonic() < end_s:
        waits.wait(0.01)
    return path.exists()


def test_a_stop_is_in_the_file_while_the_program_still_runs(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    thread = begun(path)
    thread.note(STOP)
    assert come(path)
    assert left_in(path) == Latch("panel before the restart")
    thread.close()


def test_of_many_changes_the_newest_is_kept_and_the_end_waits_for_it(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    thread = begun(path)
    for latch in (STOP, None, STOP, None, STORM):
        thread.note(latch)
    thread.close()
    assert left_in(path) == Latch("console#3 before the restart", storm=True)
    thread.close()


def test_a_damaged_file_is_replaced_at_the_start_by_one_that_says_stopped(tmp_path: Path) -> None:
    path = tmp_path / "latch.json"
    path.write_text("x")
    begun(path).close()
    assert left_in(path) == Latch(f"{DAMAGED.by} before the restart")


def test_what_the_card_refused_is_tried_once_more_at_the_end(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    thread = begun(folder / "latch.json")
    folder.write_text("a file where the folder should be")
    thread.note(STOP)
    folder.unlink()
    thread.close()
    assert left_in(folder / "latch.json") == Latch("panel before the restart")


def test_something_new_does_not_wait_until_a_refusing_card_is_tried_again() -> None:
    tried: queue.SimpleQueue[Latch | None] = queue.SimpleQueue()

    def refused(latch: Latch | None) -> bool:
        tried.put(latch)
        return False

    thread: LatchThread[Latch | None] = LatchThread(refused, None, again_s=100 * PATIENCE_S)
    thread.start()
    assert tried.get(timeout=PATIENCE_S) is None
    for latch in (STOP, None, STORM):
        thread.note(latch)
        assert tried.get(timeout=PATIENCE_S) == latch
    thread.close()


def scripts(events: Events) -> Iterator[Sequence[tuple[Events, Events, bool]]]:
    """Every way in which these events, in this order, fall into the first two writes, and each outcome of both."""
    places = range(4)  # before and after the first write, before and after the second one
    for at in itertools.combinations_with_replacement(places, len(events)):
        parts = [tuple(event for event, place in zip(events, at, strict=True) if place == each) for each in places]
        for first, second in itertools.product((True, False), repeat=2):
            if first or second or END in (*parts[2], *parts[3]):  # the end tries twice
                yield [(parts[0], parts[1], first), (parts[2], parts[3], second)]


@pytest.mark.search
@pytest.mark.parametrize(
    ("left", "notes"),
    [(None, (STOP,)), (STOP, (None,)), (None, (STOP, STORM)), (None, (None, STOP)), (STOP, (STOP, None))],
)
def test_with_a_card_that_is_slow_or_refuses_at_any_time_the_file_has_the_latest_note(
    tmp_path: Path, left: Latch | None, notes: tuple[Latch | None, ...]
) -> None:
    """Each order of the notes, the end, and the begin, the end and the outcome of a write."""
    newest = notes[-1]
    for number, script in enumerate(some(list(scripts((*notes, END))))):
        path = tmp_path / str(number) / "latch.json"
        LatchFile(path).save(left)
        file = LatchFile(path)
        card = SlowCard(file, script)
        thread = LatchThread(card.save, file.load(), again_s=0.0)
        card.others = partial(happen, thread)
        thread.start()
        thread.close()
        found = left_in(path)
        if newest is None:
            assert found is None, script
        else:
            assert found is not None, script
            assert (found.by.removesuffix(BEFORE), found.storm) == (newest.by, newest.storm), script


def happen(thread: LatchThread[Latch | None], event: Latch | str | None) -> None:
    if isinstance(event, str):
        thread.end()
    else:
        thread.note(event)
