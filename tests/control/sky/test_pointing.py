"""From orders to goals: which turn a target that has come to rest is reached on, and streams faster than any pass."""

from __future__ import annotations

import random
from dataclasses import dataclass

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.route import Speeds
from rotator.exchange.orders import Aim
from tests.search import examples
from tests.tables import every_row

SPEEDS = Speeds(6.0, 2.7)


@pytest.fixture
def pointing() -> Pointing:
    return Pointing(Mount(azimuth=Range(0.0, 450.0), elevation=Range(0.0, 180.0)), 4.0, 4.0)


def stream(pointing: Pointing, first_deg: float, last_deg: float, *, rate_dps: float, every_s: float) -> float:
    """Orders along the horizon at 20°, with the antenna at its goals; returns when the last order came."""
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


@every_row("on_sky", [True, False])
@every_row(("rises_deg", "sets_deg"), [(0.0, 180.0), (0.0, 180.0 + 1e-9), (0.0, 181.0), (360.0, 180.0)])
def test_a_target_straight_overhead_is_followed_to_the_other_side(
    rises_deg: float, sets_deg: float, on_sky: bool
) -> None:
    """Its azimuth turns by half a turn at once: the way round that leads beyond the range would wait at its end."""
    rotor = Pointing(Mount(azimuth=Range(0.0, 360.0), elevation=Range(0.0, 180.0)), 4.0, 4.0, on_sky=on_sky)
    for second in range(20):
        up_deg = 70.0 + 2.0 * second
        aim = Aim(rises_deg, up_deg) if up_deg < 90.0 else Aim(sets_deg, 180.0 - up_deg)
        rotor.aim(float(second), aim, 30.0, 20.0)
    goals = rotor.look_ahead(19.1, SPEEDS, had_path=True)
    assert goals is not None
    assert goals[0].target_deg == pytest.approx(sets_deg, abs=2.0)


@every_row("stands_deg", [190.0, 250.0, 335.0])
@every_row("stray_s", [0.2, 1.0, 3.0])
def test_after_one_stray_order_the_antenna_goes_back_the_short_way(stray_s: float, stands_deg: float) -> None:
    """It has begun to unwind towards 68°; 345° is nearer then than the end of the range, where it would wait."""
    rotor = Pointing(Mount(azimuth=Range(0.0, 360.0), elevation=Range(0.0, 90.0)), 4.0, 4.0)
    for second in range(40):
        rotor.aim(float(second), Aim(345.0, 6.0), 345.0, 6.0)
    rotor.aim(40.0, Aim(68.0, 82.0), 345.0, 6.0)
    azimuth, _ = rotor.aim(40.0 + stray_s, Aim(345.0, 6.0), stands_deg, 30.0)
    assert azimuth.target_deg == 345.0


def test_a_target_across_the_end_is_waited_for_at_the_end_that_is_near() -> None:
    rotor = Pointing(Mount(azimuth=Range(0.0, 360.0), elevation=Range(0.0, 90.0)), 4.0, 4.0)
    for second in range(8):
        azimuth, _ = rotor.aim(
            float(second), Aim((8.0 - 2.0 * second) % 360.0, 20.0), max(8.0 - 2.0 * second, 0.0), 20.0
        )
        assert azimuth.target_deg == max(8.0 - 2.0 * second, 0.0)


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


# --- a target that wavers across the end of the range


@dataclass(frozen=True, slots=True)
class Wavers:
    """A target `across_deg` to either side of the end of the range, sent every `every_s`; `gauss`: at random."""

    top_deg: float
    flip: bool
    elevation_deg: float
    across_deg: float
    every_s: float
    gauss: bool
    seed: int


SPEED_DPS = 6.0
WATCHED_S = 240.0
HALF_TURN_DEG = 180.0


def swings(target: Wavers) -> int:
    """How often the azimuth is sent right round while the target wavers."""
    chance = random.Random(target.seed)
    elevation = Range(0.0, 180.0 if target.flip else 90.0)
    pointing = Pointing(Mount(Range(0.0, target.top_deg), elevation, flip=target.flip), 4.0, 4.0)
    antenna_deg, goal_deg, had_path, count, side = target.top_deg - 5.0, target.top_deg - 5.0, False, 0, 1.0
    for step in range(int(WATCHED_S / target.every_s)):
        now_s, side = step * target.every_s, -side
        off_deg = chance.gauss(0.0, target.across_deg) if target.gauss else side * target.across_deg
        goal, _ = pointing.aim(
            now_s, Aim(round((target.top_deg + off_deg) % 360.0), target.elevation_deg), antenna_deg, 20.0
        )
        ahead = pointing.look_ahead(now_s + target.every_s / 2, SPEEDS, had_path=had_path)
        goal = ahead[0] if ahead else goal
        had_path = goal.path is not None
        count += abs(goal.target_deg - goal_deg) > HALF_TURN_DEG
        goal_deg = goal.target_deg
        reach_deg = SPEED_DPS * target.every_s
        antenna_deg += min(max(goal_deg - antenna_deg, -reach_deg), reach_deg)
    return count


@settings(max_examples=examples(15), deadline=None)
@given(
    st.builds(
        Wavers,
        top_deg=st.sampled_from([360.0, 450.0]),
        flip=st.booleans(),
        elevation_deg=st.sampled_from([0.0, 30.0, 75.0]),
        across_deg=st.sampled_from([0.6, 1.0, 3.0, 8.0, 20.0]),
        every_s=st.sampled_from([1.0, 2.0, 5.0, 20.0]),
        gauss=st.booleans(),
        seed=st.integers(0, 1000),
    )
)
@example(Wavers(360.0, False, 20.0, 1.0, 1.0, False, 0))
def test_a_target_that_wavers_across_north_swings_it_round_a_few_times_and_no_more(target: Wavers) -> None:
    assert swings(target) <= 8


def test_one_order_across_north_is_obeyed_at_once() -> None:
    pointing = Pointing(Mount(Range(0.0, 360.0), Range(0.0, 90.0)), 4.0, 4.0)
    pointing.aim(0.0, Aim(350.0, 20.0), 340.0, 20.0)
    assert pointing.aim(30.0, Aim(10.0, 20.0), 350.0, 20.0)[0].target_deg == 10.0


def test_a_target_that_goes_back_while_the_antenna_is_still_near_is_met_at_once() -> None:
    pointing = Pointing(Mount(Range(0.0, 360.0), Range(0.0, 90.0)), 4.0, 4.0)
    for now_s, azimuth_deg in ((0.0, 350.0), (30.0, 10.0)):
        pointing.aim(now_s, Aim(azimuth_deg, 20.0), 350.0, 20.0)
    assert pointing.aim(31.0, Aim(350.0, 20.0), 340.0, 20.0)[0].target_deg == 350.0


def test_a_target_that_goes_back_and_stays_when_the_antenna_is_nearer_to_the_end_is_met_a_little_later() -> None:
    pointing = Pointing(Mount(Range(0.0, 360.0), Range(0.0, 90.0)), 4.0, 4.0)
    for now_s, azimuth_deg in ((0.0, 350.0), (30.0, 10.0)):
        pointing.aim(now_s, Aim(azimuth_deg, 20.0), 350.0, 20.0)
    assert pointing.aim(31.0, Aim(350.0, 20.0), 100.0, 20.0)[0].target_deg == 0.0, "the end next to it"
    assert pointing.look_ahead(33.9, SPEEDS, had_path=False) is None
    goals = pointing.look_ahead(34.1, SPEEDS, had_path=False)
    assert goals is not None
    assert goals[0].target_deg == 350.0
