"""What a jog is to the axis: a direction and its end; short presses where the axis is not commissioned."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.goals import LONGEST_WAIT_S, JogGoal, jog

MINUS, OFF, PLUS = Direction


@pytest.mark.parametrize(
    ("seconds", "commissioned", "until_s"),
    [
        (5.0, True, 105.0),
        (None, True, None),
        (1.5, False, 101.5),
        (2.0, False, 102.0),
        (60.0, False, 102.0),
        (None, False, 102.0),
    ],
)
def test_how_long_a_jog_lasts(seconds: float | None, commissioned: bool, until_s: float | None) -> None:
    for way in (MINUS, PLUS):
        assert jog(way, seconds, 100.0, commissioned=commissioned) == JogGoal(way, until_s)


def test_a_jog_without_a_direction_is_a_stop() -> None:
    assert jog(OFF, 5.0, 100.0, commissioned=True) is None
    assert jog(OFF, None, 100.0, commissioned=False) is None


def test_while_its_relay_waits_the_time_of_a_press_does_not_pass() -> None:
    press = JogGoal(PLUS, 105.0)
    for _ in range(3):
        press = press.put_off(0.5)
    assert press == JogGoal(PLUS, 106.5, waits_s=LONGEST_WAIT_S - 1.5)


def test_a_press_that_has_waited_six_seconds_waits_no_longer() -> None:
    press = JogGoal(PLUS, 105.0)
    for _ in range(1000):
        press = press.put_off(0.5)
    assert press.until_s == 111.0


def test_a_jog_without_a_time_has_none_to_put_off() -> None:
    assert JogGoal(PLUS, None).put_off(0.5) == JogGoal(PLUS, None)


def test_what_is_put_off_keeps_its_way_and_its_end() -> None:
    assert JogGoal(MINUS, 105.0, end_deg=90.0).put_off(1.0) == JogGoal(MINUS, 106.0, waits_s=5.0, end_deg=90.0)
