"""How many bad readings are ridden out, noticed, and too many."""

from __future__ import annotations

import pytest

from rotator.control.axis.bad_readings import HEALED_S, LOOKED_AT, NOTICED, TOO_MANY, BadReadings

STEP_S = 0.05


def after(pattern: list[bool]) -> BadReadings:
    rate = BadReadings()
    for count, bad in enumerate(pattern):
        rate.note(count * STEP_S, bad=bad)
    return rate


def each(every: int, readings: int = 400) -> list[bool]:
    return [count % every == every - 1 for count in range(readings)]


@pytest.mark.parametrize("every", [2, 3, 7, 10, 12])
def test_one_in_so_few_is_too_many(every: int) -> None:
    assert after(each(every)).too_many(400 * STEP_S)


@pytest.mark.parametrize("every", [15, 20, 25])
def test_one_in_so_many_is_a_notice(every: int) -> None:
    rate = after(each(every))
    assert not rate.too_many(400 * STEP_S)
    assert rate.notice is not None


@pytest.mark.parametrize("every", [34, 60, 200])
def test_fewer_are_nothing(every: int) -> None:
    assert after(each(every)).notice is None


def test_the_notice_ends_long_after_the_last_bad_reading() -> None:
    assert after([True] * NOTICED + [False] * (LOOKED_AT - NOTICED)).notice is not None
    assert after([True] * NOTICED + [False] * LOOKED_AT).notice is None


def test_too_many_stay_too_many_until_a_while_after_the_last_one() -> None:
    rate = after([True] * TOO_MANY)
    last_s = (TOO_MANY - 1) * STEP_S
    assert rate.too_many(last_s + HEALED_S - 0.01)
    assert not rate.too_many(last_s + HEALED_S)
    assert rate.count == 0, "it begins anew"
