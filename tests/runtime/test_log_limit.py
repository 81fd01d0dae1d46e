"""Complaints at 16 Hz: told at once, then once a minute with their number."""

from __future__ import annotations

import pytest

from rotator.runtime.log_limit import EVERY_S, MOST, LogLimit


class Clock:
    now_s = 1000.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    return Clock()


def test_once_and_then_every_minute_with_a_count(clock: Clock) -> None:
    limit, told = LogLimit(clock), []
    for _ in range(int(2.5 * EVERY_S * 16)):
        told.append(limit.admit("refused"))
        clock.now_s += 1 / 16
    assert [text for text in told if text] == [
        "refused",
        "refused (959 similar lines before this one are not shown)",
        "refused (959 similar lines before this one are not shown)",
    ]


def test_another_complaint_is_logged_at_once(clock: Clock) -> None:
    limit = LogLimit(clock)
    assert limit.admit("one") == "one"
    assert limit.admit("other") == "other"
    assert limit.admit("one") is None


def test_a_complaint_that_is_different_each_time_is_soon_not_logged_any_more(clock: Clock) -> None:
    limit = LogLimit(clock)
    assert [limit.admit(f"azimuth {n}") is not None for n in range(100)] == [True] * MOST + [False] * (100 - MOST)
    clock.now_s += EVERY_S
    assert limit.admit("azimuth 100") == "azimuth 100 (95 similar lines before this one are not shown)"


def test_after_a_quiet_minute_it_is_news_again(clock: Clock) -> None:
    limit = LogLimit(clock)
    limit.admit("refused")
    clock.now_s += 2 * EVERY_S
    assert limit.admit("refused") == "refused"
