"""Where the axes may be: the park position, all places of one direction, trees and roofs, forbidden sectors, ways."""

from __future__ import annotations

import pytest

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.mount import Mount, Range, Sector, Unreachable
from rotator.control.sky.pointing_model import PointingModel
from tests.tables import every_row

FULL_EL = Range(0, 180)
G5500 = Mount(Range(0, 450), FULL_EL)
FLIPS = Mount(Range(0, 450), FULL_EL, flip=True)
HALF = Mount(Range(0, 200), FULL_EL, flip=True)
"""Azimuth reaches half of the sky, and the rest over the top."""
HILLS = ((10.0, 4.0), (100.0, 22.0), (300.0, 2.0))
CHIMNEY = Sector("chimney", Range(100, 120), Range(0, 30), 2.0)


# --- ranges


def test_ranges_meet_where_they_have_more_than_an_end_in_common() -> None:
    limits = Range(10, 20)
    met = [limits.meets(other) for other in (Range(0, 10), Range(0, 11), Range(12, 13), Range(19, 30), Range(20, 30))]
    assert met == [False, True, True, True, False]


# --- over the top


@pytest.mark.parametrize(
    ("mount", "order", "axes"),
    [
        (HALF, (100, 30), (100, 30)),
        (HALF, (300, 30), (120, 150)),
        (HALF, (300, 90), (120, 90)),
        (FLIPS, (300, 30), (300, 30)),
    ],
)
def test_a_direction_that_azimuth_does_not_reach_is_looked_at_over_the_top(
    mount: Mount, order: tuple[float, float], axes: tuple[float, float]
) -> None:
    assert mount.axis_angles(*order, 0.0) == axes


def test_without_leave_to_go_over_the_top_it_is_out_of_reach() -> None:
    with pytest.raises(Unreachable, match="azimuth 300 is outside the rotor's range of 0 to 200 degrees"):
        Mount(Range(0, 200), FULL_EL).axis_angles(300, 30, 0.0)
    with pytest.raises(Unreachable, match="azimuth 270 is outside"):
        Mount(Range(0, 80), FULL_EL, flip=True).axis_angles(270, 30, 0.0)


def test_an_order_to_go_over_the_top_goes_there_on_the_nearest_turn() -> None:
    assert FLIPS.axis_angles(30, 40, 200.0, over=True) == (210, 140)
    assert FLIPS.axis_angles(200, 40, 300.0, over=True) == (380, 140)
    assert FLIPS.axis_angles(200, 40, 100.0, over=True) == (20, 140)


# --- the park position


def test_it_parks_on_the_turn_that_the_file_names() -> None:
    assert Mount(Range(0, 450), FULL_EL, 380.0, 90.0).parked() == (380, 90)
    assert Mount(Range(0, 450), FULL_EL, 20.0, 90.0).parked() == (20, 90)
    assert G5500.parked() == (0, 0)


def test_it_parks_within_its_limits_and_above_what_stands_there() -> None:
    with pytest.raises(Unreachable, match="elevation 0 is outside"):
        Mount(Range(0, 450), Range(5, 90), 20.0, 0.0).parked()
    assert Mount(Range(0, 450), FULL_EL, 100.0, 0.0, horizon=HILLS).parked() == (100, 22)
    with pytest.raises(Unreachable, match="azimuth 100 is outside"):
        Mount(Range(200, 400), FULL_EL, 100.0).parked()


# --- all places of one direction


def test_each_turn_and_each_way_over_the_top_is_a_place() -> None:
    assert G5500.places(30, 40) == [(30, 40, False), (390, 40, False)]
    assert G5500.places(200, 40) == [(200, 40, False)]
    assert FLIPS.places(30, 40) == [(30, 40, False), (390, 40, False), (210, 140, True)]
    assert FLIPS.places(30, 90) == [(30, 90, False), (390, 90, False), (210, 90, True)]
    assert FLIPS.places(200, 40) == [(200, 40, False), (20, 140, True), (380, 140, True)]
    assert FLIPS.places(30, 120) == [(30, 120, False), (390, 120, False)], "that order names the way itself"
    assert Mount(Range(0, 100), FULL_EL).places(200, 40) == []


# --- trees and roofs


@every_row(
    ("azimuth_deg", "high_deg"),
    [
        (10, 4),
        (55, 13),
        (100, 22),
        (200, 12),
        (300, 2),
        (335, 3),
        (0, 3 + 5 / 7),
        (360, 3 + 5 / 7),
        (-25, 3),
        (415, 13),
    ],
)
def test_between_its_points_the_horizon_is_a_straight_line_all_the_way_round(
    azimuth_deg: float, high_deg: float
) -> None:
    assert Mount(Range(0, 450), FULL_EL, horizon=HILLS).horizon_deg(azimuth_deg) == pytest.approx(high_deg)


def test_one_point_is_a_horizon_of_the_same_height_all_round() -> None:
    wall = Mount(Range(0, 450), FULL_EL, horizon=((20.0, 7.0),))
    assert [wall.horizon_deg(azimuth_deg) for azimuth_deg in (0, 20, 200, 359)] == [7, 7, 7, 7]
    assert G5500.horizon_deg(20) == 0


@every_row(
    ("place", "clear_deg"),
    [
        ((100, 30), 30),
        ((100, 22), 22),
        ((100, 10), 22),
        ((100, -5), 22),
        ((300, 1), 2),
        # Over the top the boom points the other way: at axis azimuth 280 to the hill at 100.
        ((280, 150), 150),
        ((280, 160), 158),
        ((280, 200), 158),
        ((120, 179), 178),
    ],
)
def test_the_elevation_stays_above_what_stands_where_the_boom_points(
    place: tuple[float, float], clear_deg: float
) -> None:
    assert Mount(Range(0, 450), FULL_EL, horizon=HILLS).clear_deg(*place) == pytest.approx(clear_deg)


def test_limits_count_for_more_than_trees() -> None:
    low = Mount(Range(0, 450), Range(0, 15), horizon=HILLS)
    assert low.clear_deg(100, 10) == 15
    assert G5500.clear_deg(100, -3) == 0
    assert G5500.clear_deg(100, 190) == 180


# --- forbidden sectors


@every_row(
    ("place", "inside_deg"),
    [
        ((110, 15), 12),
        ((103, 15), 5),
        ((117, 15), 5),
        ((110, 28), 4),
        ((110, 1), 3),
        ((99, 15), 1),
        ((121, 31), 1),
        ((98, 15), 0),
        ((122, 15), 0),
        ((110, 32), 0),
        ((300, 80), 0),
    ],
)
def test_how_deep_a_place_is_in_a_sector_with_its_margin(place: tuple[float, float], inside_deg: float) -> None:
    assert Mount(Range(0, 450), FULL_EL, sectors=(CHIMNEY,)).inside_deg(*place) == pytest.approx(inside_deg)
    assert G5500.inside_deg(*place) == 0


def test_of_two_sectors_the_deeper_one_counts() -> None:
    mast = Sector("mast", Range(105, 130), Range(0, 90), 1.0)
    assert Mount(Range(0, 450), FULL_EL, sectors=(CHIMNEY, mast)).inside_deg(118, 15) == pytest.approx(13)


# --- ways


@every_row(
    ("order", "from_deg", "flipped", "axes"),
    [
        ((10, 20), 350, False, (370, 20)),
        ((350, 20), 10, False, (-10, 20)),
        ((10, 20), 445, False, (370, 20)),
        ((20, 30), 190, True, (200, 150)),
        ((200, 30), 10, True, (20, 150)),
    ],
)
def test_a_way_goes_on_the_short_way_also_beyond_the_limits(
    order: tuple[float, float], from_deg: float, flipped: bool, axes: tuple[float, float]
) -> None:
    assert FLIPS.on_the_way(*order, from_deg, flipped=flipped) == axes


@every_row(
    ("azimuth_deg", "from_deg", "axis_deg"),
    [
        (280, 100, 280),
        # Half a turn is as short both ways: the one within the range is taken, also a degree beside it.
        (180, 360, 180),
        (180.5, 0.0, 180.5),
        (179.5, 0.0, 179.5),
        (200, 20.5, 200),
        (20, 200.5, 380),
        (300, 119.5, 300),
        (270, 91.5, 270),
        (90, 271.5, 450),
        (190, 9.2, 190),
        # With more than a degree between them the shorter one is taken, at any angle.
        (190, 8, -170),
    ],
)
def test_half_a_turn_goes_where_the_range_allows(azimuth_deg: float, from_deg: float, axis_deg: float) -> None:
    there_deg, _ = G5500.on_the_way(azimuth_deg, 85, from_deg, flipped=False)
    assert there_deg == pytest.approx(axis_deg)


# --- a mount that leans


def test_where_elevation_ends_before_the_azimuth_fits_the_elevation_at_which_it_rests() -> None:
    """A mast that leans by 5°, and a target below what elevation reaches: azimuth points at it all the same."""
    model = PointingModel(an_deg=5.0, npae_deg=3.0)
    low = Mount(Range(0, 450), Range(10, 90), model=model)
    for azimuth_deg in range(0, 360, 20):
        axes = low.axis_angles(azimuth_deg, -8.0, 0.0)
        assert axes[1] == 10
        sky_azimuth_deg, _ = low.pointed(axes[0], 10.0)
        assert great_circle_deg(sky_azimuth_deg, 0.0, azimuth_deg, 0.0) < 0.1
