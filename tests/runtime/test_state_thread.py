"""The thread that writes the state: the newest counts, however slow or broken the card is, and at the end too."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import pytest

from rotator.exchange.status import Latch
from rotator.runtime.state_thread import StateThread
from rotator.store.latch import BEFORE, DAMAGED, KeptLatch
from rotator.store.state import State
from tests.refusing import hanging, refuse, wait_until
from tests.search import some

Events = tuple[Latch | str | None, ...]
Script = Sequence[tuple[Events, Events, bool]]
STOP, STORM = Latch("panel"), Latch("console#3", storm=True)
END = "end"
"""The box ends: nothing is noted after this."""
AGES_S = 1000.0


class SlowCard(State):
    """Each write takes a while. Meanwhile other threads do what `script` says, write by write.

    Each entry of `script`: what they do before the old content is replaced, what they do after it, and whether the
    card takes the write. When the script is over the card is quick, and takes every write.
    """

    def __init__(self, path: Path, script: Script) -> None:
        super().__init__(path)
        self._script = iter(script)
        self.others: Callable[[Latch | str | None], None] = lambda _event: None

    def save(self) -> bool:
        before, after, takes = next(self._script, ((), (), True))
        for event in before:
            self.others(event)
        blocked = None if takes else refuse(self.path)
        done = super().save()
        if blocked:
            blocked.rmdir()
        for event in after:
            self.others(event)
        return done


def left_in(path: Path) -> Latch | None:
    return KeptLatch(State(path)).load()


def told(found: Latch | None) -> Latch | None:
    return found and Latch(found.by.removesuffix(BEFORE), storm=found.storm)


def begun(path: Path, memory: Path | None = None) -> tuple[KeptLatch, StateThread]:
    kept = KeptLatch(State(path, memory))
    kept.note(kept.load())
    thread = StateThread(kept.state, looks_s=AGES_S)
    thread.start()
    return kept, thread


def test_a_stop_is_in_the_file_while_the_program_still_runs(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    kept, thread = begun(path)
    kept.note(STOP)
    wait_until(path.exists)
    assert left_in(path) == Latch("panel before the restart")
    thread.close()


def test_of_many_changes_the_newest_is_kept_and_the_end_waits_for_it(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    kept, thread = begun(path)
    for latch in (STOP, None, STOP, None, STORM):
        kept.note(latch)
    thread.close()
    assert left_in(path) == Latch("console#3 before the restart", storm=True)
    thread.close()


def test_a_damaged_file_is_replaced_at_the_start_by_one_that_says_stopped(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    path.write_text("x")
    begun(path)[1].close()
    assert left_in(path) == Latch(f"{DAMAGED.by} before the restart")


def test_what_the_card_refused_is_tried_once_more_at_the_end(tmp_path: Path) -> None:
    folder = tmp_path / "run"
    folder.write_text("a file where the folder should be")
    kept, thread = begun(folder / "state.json")
    kept.note(STOP)
    wait_until(lambda: kept.state.trouble)
    folder.unlink()
    thread.close()
    assert left_in(folder / "state.json") == Latch("panel before the restart")


def test_something_new_does_not_wait_until_a_refusing_card_is_tried_again(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    blocked = refuse(path)
    kept, thread = begun(path)
    kept.note(STOP)
    wait_until(lambda: kept.state.trouble)
    blocked.rmdir()
    kept.note(STORM)
    wait_until(path.exists)
    assert left_in(path) == Latch("console#3 before the restart", storm=True)
    thread.close()


def test_a_card_that_refused_is_tried_again_and_a_changed_file_is_written(tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    blocked = refuse(path)
    kept = KeptLatch(State(path))
    thread = StateThread(kept.state, looks_s=0.01)
    thread.start()
    kept.note(STOP)
    wait_until(lambda: kept.state.trouble)
    blocked.rmdir()
    wait_until(path.exists)
    path.unlink()
    wait_until(path.exists)
    thread.close()
    assert left_in(path) == Latch("panel before the restart")


def test_while_the_card_hangs_each_change_is_in_memory_and_the_end_does_not_wait(tmp_path: Path) -> None:
    path, memory = tmp_path / "state.json", tmp_path / "memory"
    with hanging(path):
        kept, thread = begun(path, memory)
        for latch in (STOP, None, STORM):
            kept.note(latch)
            wait_until(lambda: told(KeptLatch(State(path, memory)).load()) == latch)  # noqa: B023 - at once
        thread.end()
        assert left_in(path) is None


def scripts(events: Events) -> Iterator[Script]:
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
        path = tmp_path / str(number) / "state.json"
        KeptLatch(State(path)).save(left)
        card = SlowCard(path, script)
        kept = KeptLatch(card)
        kept.load()
        thread = StateThread(card, looks_s=0.0)
        card.others = partial(happen, kept, thread)
        thread.start()
        thread.close()
        assert told(left_in(path)) == newest, script


def happen(kept: KeptLatch, thread: StateThread, event: Latch | str | None) -> None:
    if isinstance(event, str):
        thread.end()
    else:
        kept.note(event)
