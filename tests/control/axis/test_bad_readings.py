"""How many bad readings are ridden out, noticed, and too many."""

from __future__ import annotations

import random

import pytest

from rotator.control.axis.readings import HEALED_S, LOOKED_AT, NOTICED, TOO_MANY_BAD, BadReadings

STEP_S = 0.05


def after(pattern: list[bool]) -> BadReadings:
    rate = BadReadings()
    for count, bad in enumerate(pattern):
        rate.note(count * STEP_S, bad=bad)
    return rate


def each(every: int, readings: int = 400) -> list[bool]:
    return [count % every == every - 1 for count in range(readings)]


def test_the_notice_ends_long_after_the_last_bad_reading() -> None:
    assert after([True] * NOTICED + [False] * (LOOKED_AT - NOTICED)).notice is not None
    assert after([True] * NOTICED + [False] * LOOKED_AT).notice is None


@pytest.mark.parametrize(("bad", "noticed"), [(1, False), (2, True), (3, True)])
def test_once_noticed_they_stay_so_until_all_but_one_are_over(bad: int, noticed: bool) -> None:
    rate = after([True] * NOTICED + [False] * (LOOKED_AT - bad) + [True] * bad)
    assert (rate.notice is not None) is noticed


@pytest.mark.parametrize(("bad", "noticed"), [(3, False), (4, True)])
def test_four_of_a_hundred_are_noticed(bad: int, noticed: bool) -> None:
    assert (after([False] * 50 + [True] * bad).notice is not None) is noticed


@pytest.mark.parametrize(("bad", "too_many"), [(7, False), (8, True)])
def test_eight_of_a_hundred_are_too_many(bad: int, too_many: bool) -> None:
    assert after([True, False] * bad).too_many(2.0 * bad * STEP_S) is too_many


def test_a_sensor_that_has_not_been_read_is_not_noticed() -> None:
    assert (BadReadings().notice, BadReadings().count, BadReadings().too_many(10.0)) == (None, 0, False)


@pytest.mark.parametrize("seed", range(5))
def test_only_the_latest_hundred_count(seed: int) -> None:
    draw, rate, seen = random.Random(seed), BadReadings(), list[bool]()
    for count in range(600):
        seen.append(draw.random() < 0.04)
        rate.note(count * STEP_S, bad=seen[-1])
        assert rate.count == sum(seen[-100:])


def test_too_many_stay_too_many_until_a_while_after_the_last_one() -> None:
    rate = after([True] * TOO_MANY_BAD)
    last_s = (TOO_MANY_BAD - 1) * STEP_S
    assert rate.too_many(last_s + HEALED_S - 0.01)
    assert not rate.too_many(last_s + HEALED_S)
    assert rate.count == 0, "it begins anew"
