"""Threads that a mistake of the program ends, and who hears of them. Real threads; each one is joined."""

from __future__ import annotations

import logging
import sys
import threading
from collections.abc import Callable

import pytest

from hw.ports import HardwareError
from rotator.runtime.own_thread import dead_threads


def raises(failure: BaseException) -> Callable[[], None]:
    def work() -> None:
        raise failure

    return work


def deaths(work: Callable[[], None]) -> list[str]:
    heard: list[HardwareError] = []
    with dead_threads(heard.append):
        thread = threading.Thread(target=work, name="display")
        thread.start()
        thread.join()
    return [str(each) for each in heard]


def test_a_thread_that_dies_is_reported_by_name_and_its_mistake_is_in_the_log(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.ERROR):
        assert deaths(raises(KeyError("rows"))) == ["the thread 'display' has ended by a mistake of the program"]
    assert "please report it" in caplog.text
    assert "KeyError: 'rows'" in caplog.text


def test_a_thread_that_returns_is_not_reported() -> None:
    assert deaths(lambda: None) == []


def test_a_thread_that_a_library_has_ended_is_reported_too() -> None:
    """That of the moteus calls sys.exit when one of its handlers fails."""
    assert deaths(lambda: sys.exit(1)) == ["the thread 'display' has ended by a mistake of the program"]


def test_each_dead_thread_is_reported() -> None:
    heard: list[HardwareError] = []
    with dead_threads(heard.append):
        threads = [threading.Thread(target=raises(OSError("x")), name=name) for name in ("latch", "signals")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert sorted(str(each).split("'")[1] for each in heard) == ["latch", "signals"]


def test_afterwards_python_s_own_way_is_back() -> None:
    before = threading.excepthook
    with pytest.raises(ZeroDivisionError), dead_threads(lambda _: None):
        raise ZeroDivisionError
    assert threading.excepthook is before
