"""A card that hangs: which writes are under way, since when they are looked at, and that a start does not wait."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from rotator.store.hanging import HANGS_S, Hanging, within, writes
from rotator.store.whole import write_whole
from tests.refusing import hanging, refuse, wait_until


def test_a_write_is_under_way_until_it_returns(tmp_path: Path) -> None:
    path = tmp_path / "kept.json"

    def refused() -> None:
        with pytest.raises(OSError, match="Invalid"):
            write_whole(path, "x")

    with hanging(path):
        threading.Thread(target=refused, daemon=True).start()
        wait_until(lambda: path in writes().values())
    assert path not in writes().values()


def test_a_write_that_failed_is_not_under_way(tmp_path: Path) -> None:
    path = tmp_path / "kept.json"
    refuse(path)
    with pytest.raises(OSError, match="directory"):
        write_whole(path, "x")
    assert path not in writes().values()


def test_the_same_write_for_seconds_hangs_and_a_new_one_does_not() -> None:
    hangs: Hanging[int] = Hanging()
    assert hangs.look([1], 10.0) == []
    assert hangs.look([1, 2], 10.0 + HANGS_S) == []
    assert hangs.look([1, 2], 10.1 + HANGS_S) == [1]
    assert hangs.look([2], 10.2 + HANGS_S) == []
    assert hangs.look([2], 10.1 + 2 * HANGS_S) == [2]


def test_one_write_after_the_other_never_hangs() -> None:
    hangs: Hanging[int] = Hanging()
    assert not any(hangs.look([number], number * HANGS_S) for number in range(20))


def test_a_job_that_hangs_is_left_behind() -> None:
    free = threading.Event()
    assert not within(0.01, free.wait, "hangs")
    assert within(20.0, free.set, "works")
