"""A turn from one way to another while the target moves on: when it ends, and how far the antenna is off until then."""

from __future__ import annotations

import pytest

from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import STEP_S, Flown, Speeds, Way
from rotator.control.sky.turning import LIFT_LATE_DEG, LITTLE_LATE_DEG, Turning, lifted_between_deg

MOUNT = Mount(Range(0.0, 450.0), Range(0.0, 180.0))
SPEEDS = Speeds(6.0, 3.0)
"""30° of azimuth and 15° of elevation from look to look."""
LOOKS = 20


def standing(azimuth_deg: float, elevation_deg: float) -> tuple[Turning, Flown]:
    """A target that stands."""
    directions = [(azimuth_deg, elevation_deg)] * LOOKS
    return Turning(MOUNT, directions, SPEEDS), Flown(MOUNT, directions, Way(azimuth_deg, flipped=False))


def test_both_motors_turn_at_once_so_the_slower_one_decides() -> None:
    turning, _ = standing(100.0, 0.0)
    assert turning.travel_s((100.0, 10.0), (160.0, 40.0)) == 10.0
    assert turning.travel_s((160.0, 40.0), (100.0, 34.0)) == 10.0
    assert turning.travel_s((100.0, 10.0), (106.0, 40.0)) == 10.0
    assert turning.travel_s((100.0, 10.0), (100.0, 10.0)) == 0.0


def test_on_the_way_each_axis_stops_where_it_shall_be() -> None:
    turning, _ = standing(100.0, 0.0)
    assert turning.after((100.0, 40.0), (160.0, 10.0), 5.0) == (130.0, 25.0)
    assert turning.after((100.0, 40.0), (160.0, 10.0), 60.0) == (160.0, 10.0)


@pytest.mark.parametrize(
    ("from_deg", "left", "earliest", "look"),
    [
        ((100.0, 30.0), 0, 0, 0),
        ((131.0, 30.0), 0, 0, 2),
        ((130.0, 30.0), 0, 0, 1),
        ((130.0, 30.0), 4, 4, 5),
        ((100.0, 61.0), 3, 3, 6),
        ((130.0, 30.0), 0, 7, 7),
        ((100.0, 30.0), 0, 25, LOOKS),
    ],
)
def test_it_arrives_at_the_first_look_that_leaves_time_enough(
    from_deg: tuple[float, float], left: int, earliest: int, look: int
) -> None:
    turning, way = standing(100.0, 30.0)
    assert turning.arrival(from_deg, way, earliest, left=left) == look


def test_what_does_not_arrive_before_the_target_sets_ends_with_the_last_look() -> None:
    turning, way = standing(440.0, 30.0)
    assert turning.arrival((0.0, 30.0), way, LOOKS - 3, left=LOOKS - 3) == LOOKS
    assert len(turning.errors_deg((0.0, 30.0), way, LOOKS - 3, LOOKS)) == 3


def test_a_moving_target_is_met_where_it_will_be_then() -> None:
    """Azimuth runs ahead at 3°/s, half as fast as the motor, from 60° away: they meet after 20 s."""
    directions = [(160.0 + 3.0 * STEP_S * look, 20.0) for look in range(LOOKS)]
    way = Flown(MOUNT, directions, Way(160.0, flipped=False))
    assert Turning(MOUNT, directions, SPEEDS).arrival((100.0, 20.0), way, 0, left=0) == 4


def test_a_change_of_way_takes_at_least_one_look() -> None:
    """Both ways wait at the same limit: with no time between them changes would never come to an end."""
    turning, way = standing(450.0, 30.0)
    other = Flown(MOUNT, [(90.0, 30.0)] * LOOKS, Way(810.0, flipped=False))
    assert way.place(3) == other.place(3)
    assert turning.change(way, other, 3) == 4


def test_how_far_it_is_off_is_the_angle_on_the_sky_half_way_from_look_to_look() -> None:
    turning, way = standing(100.0, 0.0)
    assert turning.errors_deg((160.0, 0.0), way, 0, 2) == pytest.approx([45.0, 15.0])
    assert turning.errors_deg((160.0, 0.0), way, 5, 7) == pytest.approx([45.0, 15.0])
    high, way = standing(100.0, 60.0)
    (off_deg,) = high.errors_deg((130.0, 60.0), way, 0, 1)
    assert off_deg == pytest.approx(7.5, abs=0.1), "at 60° of elevation a degree of azimuth is half a degree"


def test_nothing_is_off_while_the_target_is_not_seen() -> None:
    directions = [(100.0, -5.0)] * 2 + [(100.0, 0.0)] * 8
    way = Flown(MOUNT, directions, Way(100.0, flipped=False))
    errors_deg = Turning(MOUNT, directions, SPEEDS).errors_deg((190.0, 0.0), way, 0, 3)
    assert errors_deg == pytest.approx([15.0])
    behind_trees = Mount(Range(0.0, 450.0), Range(0.0, 180.0), horizon=((0.0, 10.0), (180.0, 10.0)))
    assert Turning(behind_trees, directions, SPEEDS).errors_deg((190.0, 0.0), way, 0, 3) == []


def test_below_the_horizon_the_antenna_waits_level() -> None:
    """Azimuth follows, and elevation rests at 0: that is no error of its own."""
    low = Mount(Range(0.0, 450.0), Range(0.0, 180.0), horizon=((0.0, -10.0), (180.0, -10.0)))
    directions = [(100.0, -5.0)] * 4
    way = Flown(low, directions, Way(100.0, flipped=False))
    assert Turning(low, directions, SPEEDS).errors_deg((160.0, 0.0), way, 0, 2) == pytest.approx([45.0, 15.0])


@pytest.mark.parametrize(
    ("elevation_deg", "between_deg", "lifted"),
    [
        (80.0, (80.0, 80.0), 90.0),
        (75.0, (60.0, 70.0), 90.0),
        (74.9, (80.0, 80.0), None),  # too low to be kept
        (74.9, (74.9, 105.1), None),
    ],
)
def test_under_a_target_near_the_zenith_elevation_is_lifted_while_azimuth_turns_back(
    elevation_deg: float, between_deg: tuple[float, float], lifted: float | None
) -> None:
    assert lifted_between_deg(300.0, (100.0, elevation_deg), between_deg) == lifted


@pytest.mark.parametrize("between_deg", [(80.0, 100.0), (100.0, 80.0), (100.0, 100.0)])
def test_a_turn_over_the_top_goes_through_the_zenith_half_way(between_deg: tuple[float, float]) -> None:
    target = 100.0, 80.0
    for azimuth_deg, lifted in [(100.0, 80.0), (190.0, 90.0), (10.0, 90.0), (280.0, 100.0)]:
        assert lifted_between_deg(azimuth_deg, target, between_deg) == pytest.approx(lifted)


def test_of_a_turn_within_one_look_the_middle_counts() -> None:
    """From over the top to this side, in 3.6 s: half way the antenna points at the zenith."""
    fast = Speeds(50.0, 50.0, stepped=False)
    directions = [(0.0, 80.0)] * LOOKS
    way = Flown(MOUNT, directions, Way(0.0, flipped=False))
    errors_deg = Turning(MOUNT, directions, fast).errors_deg((180.0, 100.0), way, 0, 1)
    assert errors_deg == pytest.approx([10.0 + LITTLE_LATE_DEG])


def test_a_turn_right_round_under_a_high_target_stays_within_its_distance_from_the_zenith() -> None:
    turning, there = standing(10.0, 84.0)
    errors_deg = turning.errors_deg((370.0, 84.0), there, 0, 12)
    assert len(errors_deg) == 12
    assert max(errors_deg) <= 6.0 + LIFT_LATE_DEG + 1e-6
    low, below = standing(10.0, 70.0)
    assert max(low.errors_deg((370.0, 70.0), below, 0, 12)) > 35.0
