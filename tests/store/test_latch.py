"""A latched stop survives the program; it is written once, however often it is repeated."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.exchange.status import Latch
from rotator.store.latch import DAMAGED, KeptLatch
from rotator.store.state import State
from tests.refusing import refuse

STOP, STORM = Latch("page#2"), Latch("console#3", storm=True)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "state.json"


def kept(path: Path, memory: Path | None = None) -> KeptLatch:
    return KeptLatch(State(path, memory))


def test_without_a_file_nothing_was_stopped_and_none_is_written_for_that(path: Path) -> None:
    latch = kept(path)
    assert latch.load() is None
    assert latch.save(None)
    assert not path.exists()


def test_after_ten_restarts_it_says_who_stopped_it_and_says_before_the_restart_once(path: Path) -> None:
    for stop in (STOP, STORM):
        kept(path).save(stop)
        for _ in range(10):
            again = kept(path)
            latch = again.load()
            assert latch == Latch(f"{stop.by} before the restart", storm=stop.storm)
            again.save(latch)


def test_a_release_is_kept_too(path: Path) -> None:
    kept(path).save(STOP)
    again = kept(path)
    again.load()
    assert again.save(None)
    assert kept(path).load() is None


def test_a_repeated_stop_writes_nothing(path: Path) -> None:
    latch = kept(path)
    latch.save(STOP)
    written_ns = path.stat().st_mtime_ns
    for number in range(100):
        assert latch.save(Latch(f"console#{number}"))
    assert path.stat().st_mtime_ns == written_ns
    latch.save(STORM)
    assert path.stat().st_mtime_ns != written_ns, "a storm park is another thing"


def test_a_stop_for_a_damaged_file_is_a_stop_like_others(path: Path) -> None:
    path.parent.mkdir()
    path.write_text("")
    latch = kept(path)
    assert latch.load() == DAMAGED
    assert latch.save(DAMAGED)
    again = kept(path)
    assert again.load() == Latch("the damaged state file before the restart")
    assert again.save(None)
    assert kept(path).load() is None


@pytest.mark.parametrize("before", [None, STORM])
@pytest.mark.parametrize("latch", [STOP, STORM, None])
def test_what_memory_alone_kept_is_written_to_the_card_by_the_next_run(
    tmp_path: Path, before: Latch | None, latch: Latch | None
) -> None:
    path, memory = tmp_path / "state.json", tmp_path / "memory"
    first = kept(path, memory)
    first.save(before)
    blocked = refuse(path)
    first.save(latch)
    blocked.rmdir()
    second = kept(path, memory)
    assert second.save(second.load())
    after = kept(path).load()  # after a power cut there is only the card
    assert (after and after.storm) == (latch and latch.storm)
