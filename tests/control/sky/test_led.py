"""A path that runs faster than its motor: the motor leads it, and lags behind it by no more."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.led import led


@pytest.mark.parametrize("path", [[], [5.0], [0.0, 2.0, 4.0, 6.0], [6.0, 4.0, 2.0, 1.0]])
def test_a_path_that_the_motor_can_follow_stays(path: list[float]) -> None:
    assert led(path, 2.0) == path


@pytest.mark.parametrize(
    ("fast", "turned"),
    [
        ([], [10.0, 10.0, 10.0, 28.0, 46.0, 64.0, 82.0, 100.0, 100.0, 100.0]),
        ([40.0, 70.0], [10.0, 10.0, 10.0, 28.0, 46.0, 64.0, 82.0, 100.0, 100.0, 100.0]),
    ],
)
def test_half_of_the_turn_is_before_the_jump_and_half_after_it(fast: list[float], turned: list[float]) -> None:
    """90° at 20° a moment take five moments: of the six that are there about the jump the motor takes all."""
    rest = (10 - len(fast)) // 2
    path = [10.0] * rest + fast + [100.0] * rest
    assert led(path, 20.0) == pytest.approx(turned)
    assert led([-angle_deg for angle_deg in path], 20.0) == pytest.approx([-angle_deg for angle_deg in turned])


@pytest.mark.parametrize(
    ("path", "turned"),
    [
        ([0.0, 90.0, 90.0, 90.0, 90.0, 90.0], [0.0, 30.0, 60.0, 90.0, 90.0, 90.0]),
        ([0.0, 0.0, 0.0, 0.0, 90.0], [0.0, 0.0, 30.0, 60.0, 90.0]),
        ([0.0, 90.0], [0.0, 90.0]),
    ],
)
def test_at_the_ends_of_a_path_the_other_side_gives_the_time(path: list[float], turned: list[float]) -> None:
    assert led(path, 30.0) == pytest.approx(turned)


@given(st.lists(st.floats(-5, 5), min_size=40, max_size=80), st.floats(20, 120))
def test_one_swing_is_never_faster_than_the_motor_and_the_rest_of_the_path_stays(
    steps_deg: list[float], swing_deg: float
) -> None:
    path = [0.0]
    for number, step_deg in enumerate(steps_deg):
        path.append(path[-1] + (swing_deg if number == len(steps_deg) // 2 else step_deg))
    turned = led(path, 15.0)
    assert max(abs(b - a) for a, b in pairwise(turned)) <= 15.0 + 1e-9
    assert (turned[0], turned[-1]) == (path[0], path[-1])
