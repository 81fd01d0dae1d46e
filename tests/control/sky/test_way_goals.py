"""The goals of a way: the limits, the horizon and the tolerance of each axis, over the top too."""

from __future__ import annotations

import pytest

from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.plan import OFFSETS_S
from rotator.control.sky.route import Way
from rotator.control.sky.way_goals import LEAST_WEIGHT, WayGoals

MOUNT = Mount(Range(0.0, 450.0), Range(0.0, 180.0), horizon=((0.0, 5.0), (180.0, 20.0)))
AZIMUTH_TOLERANCE_DEG, ELEVATION_TOLERANCE_DEG = 4.0, 2.0


@pytest.fixture
def goals() -> WayGoals:
    return WayGoals(MOUNT, AZIMUTH_TOLERANCE_DEG, ELEVATION_TOLERANCE_DEG, on_sky=True)


def test_a_direction_is_met_on_the_turn_of_the_way(goals: WayGoals) -> None:
    for azimuth_deg in (30.0, 390.0):
        azimuth, elevation = goals.towards(Way(azimuth_deg, flipped=False), 30.0, 40.0)
        assert (azimuth.target_deg, elevation and elevation.target_deg) == pytest.approx((azimuth_deg, 40.0))


def test_over_the_top_both_axes_are_on_the_other_side(goals: WayGoals) -> None:
    azimuth, elevation = goals.towards(Way(210.0, flipped=True), 30.0, 40.0)
    assert (azimuth.target_deg, elevation and elevation.target_deg) == pytest.approx((210.0, 140.0))


def test_a_way_beyond_the_range_ends_at_the_limit_and_above_the_trees(goals: WayGoals) -> None:
    azimuth, elevation = goals.towards(Way(-10.0, flipped=False), 350.0, 0.0)
    assert (azimuth.target_deg, elevation and elevation.target_deg) == pytest.approx((0.0, 5.0))


@pytest.mark.parametrize("elevation_deg", [0.0, 60.0, 120.0, 90.0])
def test_high_up_the_tolerance_of_azimuth_is_wider(elevation_deg: float) -> None:
    share = {0.0: 1.0, 60.0: 0.5, 120.0: 0.5, 90.0: LEAST_WEIGHT}[elevation_deg]
    for on_sky in (True, False):
        goals = WayGoals(MOUNT, AZIMUTH_TOLERANCE_DEG, ELEVATION_TOLERANCE_DEG, on_sky=on_sky)
        azimuth, elevation = goals.at(100.0, elevation_deg)
        assert azimuth.tolerance_deg == pytest.approx(AZIMUTH_TOLERANCE_DEG / (share if on_sky else 1.0))
        assert elevation is not None
        assert elevation.tolerance_deg == ELEVATION_TOLERANCE_DEG


def test_azimuth_alone_is_as_exact_as_at_the_lowest_of_the_elevations(goals: WayGoals) -> None:
    way = Way(460.0, flipped=False)
    for heights_deg, tolerance_deg in ((), 4.0), ((60.0,), 8.0), ((80.0, 60.0), 8.0):
        azimuth, elevation = goals.azimuth_alone(way, heights_deg)
        assert (azimuth.target_deg, elevation) == (450.0, None)
        assert azimuth.tolerance_deg == pytest.approx(tolerance_deg)


def test_elevation_alone_stays_above_the_trees_at_that_azimuth(goals: WayGoals) -> None:
    assert goals.elevation_alone(180.0, 3.0).target_deg == pytest.approx(20.0)
    assert goals.elevation_alone(180.0, 30.0).target_deg == pytest.approx(30.0)


def test_a_moving_target_is_followed_to_the_limit_and_not_round(goals: WayGoals) -> None:
    directions = [((440.0 + offset_s) % 360.0, 60.0) for offset_s in OFFSETS_S]
    azimuth, elevation = goals.along(100.0, Way(440.0, flipped=False), directions)
    assert azimuth.path is not None
    assert elevation is not None
    assert elevation.path is not None
    for offset_s in (0.0, 5.0, 20.0, 60.0):
        assert azimuth.path.angle_deg(100.0 + offset_s) == pytest.approx(min(440.0 + offset_s, 450.0), abs=1.0)
        assert azimuth.path.weight(100.0 + offset_s) == pytest.approx(0.25)
        assert elevation.path.weight(100.0 + offset_s) == 1.0
    assert (azimuth.tolerance_deg, elevation.tolerance_deg) == (AZIMUTH_TOLERANCE_DEG, ELEVATION_TOLERANCE_DEG)
