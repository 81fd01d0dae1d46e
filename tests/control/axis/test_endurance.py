"""How long a motor may run: running fills the count, standing empties it."""

from __future__ import annotations

import pytest

from rotator.control.axis.run_permit import Endurance


def after(endurance: Endurance, *spells: tuple[float, bool]) -> bool:
    now_s = 0.0
    for seconds, running in spells:
        endurance.note(now_s, running=running)
        now_s += seconds
        endurance.note(now_s, running=running)
    return endurance.resting


@pytest.mark.parametrize(
    ("spells", "resting"),
    [
        ([(299.0, True)], False),
        ([(300.0, True)], True),
        ([(200.0, True), (150.0, False), (140.0, True)], False),  # 150 s of standing make up for 50 s of running
        ([(200.0, True), (150.0, False), (151.0, True)], True),
        ([(300.0, True), (440.0, False)], True),
        ([(300.0, True), (451.0, False)], False),
        ([(60.0, True), (180.0, False)] * 20, False),
    ],
)
def test_running_fills_and_standing_empties(spells: list[tuple[float, bool]], resting: bool) -> None:
    endurance = Endurance(300.0, 900.0)
    assert after(endurance, *spells) is resting
    assert bool(endurance.notice) is resting


def test_no_limit_is_no_limit() -> None:
    assert not after(Endurance(0.0, 900.0), (100_000.0, True))


def test_it_says_for_how_long_it_has_run() -> None:
    endurance = Endurance(300.0, 900.0)
    after(endurance, (300.0, True))
    assert str(endurance.notice) == "motor hot: it has run for 300 s and has to rest"


def test_half_cooled_it_may_run_again_and_not_before() -> None:
    assert after(Endurance(300.0, 900.0), (300.0, True), (449.9, False))
    assert not after(Endurance(300.0, 900.0), (300.0, True), (450.0, False))


def test_a_motor_that_stood_for_a_day_has_no_more_than_its_longest_run() -> None:
    assert after(Endurance(300.0, 900.0), (86_400.0, False), (300.0, True))


def test_without_a_rest_it_is_cool_as_soon_as_it_stands() -> None:
    assert not after(Endurance(300.0, 0.0), (299.0, True), (0.1, False), (299.0, True))


def test_before_the_first_moment_it_stood() -> None:
    endurance = Endurance(10.0, 20.0)
    endurance.note(100.0, running=False)
    endurance.note(200.0, running=True)
    assert not endurance.resting, "what it does from now on says nothing of before"
    endurance.note(209.9, running=True)
    assert not endurance.resting
    endurance.note(210.0, running=True)
    assert endurance.resting
