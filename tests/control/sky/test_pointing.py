"""From orders to goals: which turn a target that has come to rest is reached on, and streams faster than any pass."""

from __future__ import annotations

import time

import pytest

from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.route import Speeds
from rotator.orders import Aim

SPEEDS = Speeds(6.0, 2.7)


@pytest.fixture
def pointing() -> Pointing:
    return Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0)


def stream(pointing: Pointing, first_deg: float, last_deg: float, *, rate_dps: float, every_s: float) -> float:
    """Orders along the horizon at 20°, the antenna wherever the goals are; returns when the last one came."""
    now_s, azimuth_deg = 0.0, first_deg
    antenna_deg = first_deg % 360
    step_deg = rate_dps * every_s * (1 if last_deg > first_deg else -1)
    while (last_deg - azimuth_deg) * step_deg >= 0:
        goal, _ = pointing.aim(now_s, Aim(azimuth_deg % 360, 20.0), antenna_deg, 20.0)
        antenna_deg = goal.target_deg
        now_s += every_s
        azimuth_deg += step_deg
    return now_s


def test_a_target_that_rests_below_the_range_is_reached_on_the_other_turn(pointing: Pointing) -> None:
    ended_s = stream(pointing, 30.0, -20.0, rate_dps=5.0, every_s=1.0)
    goals = pointing.look_ahead(ended_s + 4.0, SPEEDS, had_path=True)
    assert goals is not None
    assert goals[0].target_deg == pytest.approx(340.0)


def test_the_same_order_again_does_not_leave_it_at_the_end_stop(pointing: Pointing) -> None:
    ended_s = stream(pointing, 30.0, -20.0, rate_dps=5.0, every_s=1.0)
    goals = pointing.aim(ended_s + 10.0, Aim(340.0, 20.0), 0.0, 20.0)
    assert goals[0].target_deg == pytest.approx(340.0)


def test_a_target_that_rests_in_the_overlap_stays_there(pointing: Pointing) -> None:
    ended_s = stream(pointing, 330.0, 400.0, rate_dps=5.0, every_s=1.0)
    goals = pointing.look_ahead(ended_s + 4.0, SPEEDS, had_path=True)
    assert goals is not None
    assert goals[0].target_deg == pytest.approx(400.0)


def test_fifty_orders_a_second_are_followed_like_one(pointing: Pointing) -> None:
    slow = Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0)
    ended_s = stream(pointing, 100.25, 200.25, rate_dps=1.0, every_s=0.02)
    stream(slow, 100.25, 200.25, rate_dps=1.0, every_s=1.0)
    fast_goals = pointing.look_ahead(ended_s, SPEEDS, had_path=True)
    slow_goals = slow.look_ahead(ended_s, SPEEDS, had_path=True)
    assert fast_goals is not None
    assert slow_goals is not None
    assert fast_goals[0].target_deg == pytest.approx(slow_goals[0].target_deg, abs=0.3)


def test_fifty_orders_a_second_cost_little_more_than_one() -> None:
    def cost_s(every_s: float) -> float:
        pointing = Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0)
        begun_s = time.process_time()
        stream(pointing, 100.0, 200.0, rate_dps=1.0, every_s=every_s)
        return time.process_time() - begun_s

    # Fifty times as many orders; without thinning each would cost fifty times as much as well.
    assert cost_s(0.02) < 50 * cost_s(1.0)


def test_high_up_a_tolerance_on_the_sky_is_more_degrees_of_azimuth(pointing: Pointing) -> None:
    azimuth, elevation = pointing.aim(0.0, Aim(100.0, 60.0), 50.0, 60.0)
    assert elevation is not None
    assert (azimuth.tolerance_deg, elevation.tolerance_deg) == (pytest.approx(8.0), 4.0)


@pytest.mark.parametrize("elevation_deg", [0.0, 60.0, 89.0, 120.0])
def test_a_tolerance_of_the_axis_is_the_same_everywhere(elevation_deg: float) -> None:
    plain = Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 3.0, on_sky=False)
    azimuth, elevation = plain.aim(0.0, Aim(100.0, elevation_deg), 50.0, elevation_deg)
    assert elevation is not None
    assert (azimuth.tolerance_deg, elevation.tolerance_deg) == (4.0, 3.0)


def test_with_a_tolerance_of_the_axis_a_stream_is_followed_order_by_order() -> None:
    plain = Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0, on_sky=False)
    ended_s = stream(plain, 100.0, 150.0, rate_dps=1.0, every_s=1.0)
    goals = plain.look_ahead(ended_s - 0.9, SPEEDS, had_path=False)
    assert goals is not None
    assert (goals[0].target_deg, goals[0].path) == (150.0, None)


def test_with_a_tolerance_of_the_axis_too_a_target_beyond_the_end_is_reached_on_the_other_turn() -> None:
    plain = Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0, on_sky=False)
    ended_s = stream(plain, 30.0, -20.0, rate_dps=2.0, every_s=1.0)
    plain.look_ahead(ended_s - 0.9, SPEEDS, had_path=False)
    goals = plain.look_ahead(ended_s + 4.0, SPEEDS, had_path=False)
    assert goals is not None
    assert goals[0].target_deg == pytest.approx(340.0)
    assert plain.look_ahead(ended_s + 5.0, SPEEDS, had_path=False) is None
