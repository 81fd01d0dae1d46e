"""From a direction in the sky to axis angles: turns, overlap, stops, over the top, below the horizon."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.mount import Mount, Range, Unreachable
from tests.tables import every_row

FULL_EL, HALF_EL = Range(0, 180), Range(0, 90)
G5500 = Mount(Range(0, 450), FULL_EL)
CIRCLE = Mount(Range(0, 360), FULL_EL)
SOUTH_STOP = Mount(Range(-180, 270), FULL_EL)
LOW_BEAM = Mount(Range(0, 360), HALF_EL)
ROUNDING_DEG = 1e-9
MOUNTS = st.sampled_from([G5500, CIRCLE, SOUTH_STOP, LOW_BEAM])


# --- azimuth: which turn


@every_row(
    ("mount", "azimuth_deg", "near_deg", "axis_deg"),
    [
        # 0 to 360: one turn for each direction, and both ends are north
        (CIRCLE, 10, 350, 10),
        (CIRCLE, 350, 10, 350),
        (CIRCLE, 0, 20, 0),
        (CIRCLE, 0, 340, 360),
        (CIRCLE, 360, 20, 0),
        # 0 to 450: north to east is there twice, and the nearer one is taken
        (G5500, 10, 200, 370),
        (G5500, 10, 185, 10),
        (G5500, 45, 350, 405),
        (G5500, 45, 100, 45),
        (G5500, 100, 440, 100),
        (G5500, 350, 440, 350),
        # stop in the south: -180 to 270
        (SOUTH_STOP, 300, 0, -60),
        (SOUTH_STOP, 200, 0, -160),
        (SOUTH_STOP, 200, 180, 200),
        (SOUTH_STOP, 270, 0, -90),
        (SOUTH_STOP, 180, 10, 180),
        (SOUTH_STOP, 180, -10, -180),
        (SOUTH_STOP, -90, 0, -90),
    ],
)
def test_the_turn_nearest_to_the_antenna(mount: Mount, azimuth_deg: float, near_deg: float, axis_deg: float) -> None:
    assert mount.axis_angles(azimuth_deg, 0, near_deg) == (axis_deg, 0)


@pytest.mark.parametrize("near_deg", [0, 200, 450])
def test_an_azimuth_above_360_names_the_overlap(near_deg: float) -> None:
    assert G5500.axis_angles(400, 0, near_deg)[0] == 400


def test_a_rotor_without_that_overlap_takes_it_for_a_direction() -> None:
    assert CIRCLE.axis_angles(400, 0, 0)[0] == 40
    assert SOUTH_STOP.axis_angles(400, 0, 0)[0] == 40


@pytest.mark.parametrize(
    ("azimuth_deg", "mount"), [(355, Mount(Range(0, 350), FULL_EL)), (10, Mount(Range(90, 270), FULL_EL))]
)
def test_a_direction_in_the_gap_is_unreachable_and_says_why(azimuth_deg: float, mount: Mount) -> None:
    with pytest.raises(Unreachable, match=rf"azimuth {azimuth_deg} is outside the rotor's range of \d+ to \d+ degrees"):
        mount.axis_angles(azimuth_deg, 0, 100)


# --- elevation


def test_no_elevation_asked_none_given() -> None:
    assert G5500.axis_angles(10, None, 0) == (10, None)


@pytest.mark.parametrize("elevation_deg", [-0.5, -5, -90])
def test_below_the_horizon_azimuth_follows_and_elevation_rests_at_its_minimum(elevation_deg: float) -> None:
    assert G5500.axis_angles(123, elevation_deg, 0) == (123, 0)
    assert Mount(Range(0, 360), Range(3, 90)).axis_angles(123, elevation_deg, 0) == (123, 3)


def test_a_mount_that_reaches_below_the_horizon_goes_there() -> None:
    assert Mount(Range(0, 360), Range(-10, 90)).axis_angles(123, -5, 0) == (123, -5)


@pytest.mark.parametrize("elevation_deg", [90.1, 135, 180])
def test_above_90_is_obeyed_where_the_range_allows(elevation_deg: float) -> None:
    # the program that sends it has flipped the antenna itself
    assert G5500.axis_angles(30, elevation_deg, 0) == (30, elevation_deg)


@pytest.mark.parametrize(
    ("order", "axes"), [((30, 135), (210, 45)), ((200, 100), (20, 80)), ((0, 180), (180, 0)), ((350, 91), (170, 89))]
)
def test_above_90_is_else_the_direction_that_it_means(order: tuple[float, float], axes: tuple[float, float]) -> None:
    assert LOW_BEAM.axis_angles(*order, 0) == axes


# --- any order


@given(MOUNTS, st.floats(-180, 540), st.floats(-90, 180), st.floats(-200, 460))
def test_the_answer_is_always_within_the_range(
    mount: Mount, azimuth_deg: float, elevation_deg: float, near_deg: float
) -> None:
    axis_az_deg, axis_el_deg = mount.axis_angles(azimuth_deg, elevation_deg, near_deg)
    assert mount.azimuth.min_deg - ROUNDING_DEG <= axis_az_deg <= mount.azimuth.max_deg + ROUNDING_DEG
    assert axis_el_deg is not None
    assert mount.elevation.holds(axis_el_deg)


@given(MOUNTS, st.floats(-180, 540), st.floats(0, 180), st.floats(-200, 460))
def test_the_answer_points_where_it_was_asked_to(
    mount: Mount, azimuth_deg: float, elevation_deg: float, near_deg: float
) -> None:
    axis_az_deg, axis_el_deg = mount.axis_angles(azimuth_deg, elevation_deg, near_deg)
    assert axis_el_deg is not None
    assert great_circle_deg(azimuth_deg, elevation_deg, axis_az_deg, axis_el_deg) < 1e-6


@given(MOUNTS, st.floats(0, 360), st.floats(-200, 460))
def test_asked_again_from_where_it_led_the_answer_stays(mount: Mount, azimuth_deg: float, near_deg: float) -> None:
    first, _ = mount.axis_angles(azimuth_deg, 0, near_deg)
    assert mount.axis_angles(azimuth_deg, 0, first)[0] == first
