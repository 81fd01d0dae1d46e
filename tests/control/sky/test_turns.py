"""When the antenna turns right round for a target that wavers across the end of its range, and when it waits first."""

from __future__ import annotations

import pytest

from rotator.control.sky.turns import LONGEST_WAIT_S, QUIET_S, Swings

CYCLE_S = 0.5


def waited_s(swings: Swings, from_s: float) -> float:
    """The target stays beyond the end of the range from this moment on: how long it waits for the swing."""
    now_s = from_s
    while not swings.may_begin(now_s):
        assert not swings.due(now_s)
        now_s += CYCLE_S
    return now_s - from_s


def test_the_first_swing_begins_at_once_and_each_further_one_waits_twice_as_long() -> None:
    swings, now_s, waits_s = Swings(), 1000.0, []
    for _ in range(9):
        waits_s.append(waited_s(swings, now_s))
        now_s += waits_s[-1] + 1.0
    assert waits_s == [0.0, 3.0, 6.0, 12.0, 24.0, 48.0, 96.0, 96.0, 96.0]
    assert LONGEST_WAIT_S == 96.0


@pytest.mark.parametrize(("quiet_s", "wait_s"), [(QUIET_S, 6.0), (QUIET_S + 1.0, 0.0)])
def test_after_two_minutes_without_a_wish_the_next_swing_begins_at_once_again(quiet_s: float, wait_s: float) -> None:
    swings = Swings()
    assert waited_s(swings, 0.0) == 0.0
    assert waited_s(swings, 100.0) == 3.0
    assert waited_s(swings, 103.0 + quiet_s) == wait_s
    assert QUIET_S == 120.0


def test_a_target_that_stays_is_due_although_no_order_comes() -> None:
    swings = Swings()
    assert not swings.due(0.0), "no target has waited"
    assert waited_s(swings, 0.0) == 0.0
    assert not swings.due(5.0), "it has begun"
    assert not swings.may_begin(10.0)
    assert [swings.due(at_s) for at_s in (12.9, 13.0)] == [False, True]


def test_a_swing_that_is_broken_off_makes_the_next_one_wait_for_longer() -> None:
    swings = Swings()
    assert waited_s(swings, 0.0) == 0.0
    assert not swings.may_begin(1.0)
    swings.break_off()
    assert not swings.due(4.0), "the target is back"
    assert waited_s(swings, 5.0) == 6.0
