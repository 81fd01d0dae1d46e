"""One coordinate alone: joined with the other one where the mount needs both, else left as it was sent."""

from __future__ import annotations

import pytest

from rotator.control.sky.angles import direction
from rotator.control.sky.joining import joined, places
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.pointing_model import PointingModel
from rotator.exchange.orders import Aim

UPRIGHT = Mount(Range(0, 450), Range(0, 180))
FLIPS = Mount(Range(0, 450), Range(0, 180), flip=True)
LEANS = Mount(Range(0, 450), Range(0, 180), model=PointingModel(an_deg=3.0))
NOWHERE = (None, None)
OVER = (200.0, 150.0)
"""Where the axes of an antenna stand that points at azimuth 20, 30° high."""


@pytest.mark.parametrize("aim", [Aim(200.0, None), Aim(None, 40.0), Aim(None, 100.0)])
def test_an_upright_mount_moves_one_axis(aim: Aim) -> None:
    assert joined(UPRIGHT, aim, NOWHERE, (100.0, 10.0)) == aim
    assert joined(UPRIGHT, aim, NOWHERE, (100.0, 90.0)) == aim, "at the zenith it is not over the top"


@pytest.mark.parametrize("mount", [UPRIGHT, FLIPS])
def test_over_the_top_the_other_coordinate_is_that_on_the_sky(mount: Mount) -> None:
    assert joined(mount, Aim(70.0, None), NOWHERE, OVER) == Aim(70.0, 30.0)
    assert joined(mount, Aim(None, 50.0), NOWHERE, OVER) == Aim(20.0, 50.0)
    assert joined(mount, Aim(None, 90.0), NOWHERE, OVER) == Aim(20.0, 90.0)


def test_the_direction_in_force_counts_before_the_place_of_the_axes() -> None:
    assert joined(FLIPS, Aim(70.0, None), (21.0, 31.0), OVER) == Aim(70.0, 31.0)
    assert joined(FLIPS, Aim(None, 50.0), (21.0, 31.0), OVER) == Aim(21.0, 50.0)
    assert joined(FLIPS, Aim(70.0, None), (21.0, None), OVER) == Aim(70.0, 30.0), "no direction is in force"
    assert joined(FLIPS, Aim(70.0, None), (None, 31.0), OVER) == Aim(70.0, 30.0)


def test_an_elevation_above_90_is_the_axis_s_own_angle_and_azimuth_stays() -> None:
    assert joined(FLIPS, Aim(None, 120.0), (21.0, 31.0), OVER) == Aim(200.0, 120.0)
    assert joined(FLIPS, Aim(None, 180.0), (21.0, 31.0), OVER) == Aim(200.0, 180.0)
    assert joined(FLIPS, Aim(None, 120.0), NOWHERE, OVER) == Aim(200.0, 120.0)
    low = Mount(Range(0, 450), Range(0, 160), flip=True)
    assert joined(low, Aim(None, 170.0), (21.0, 31.0), OVER) == Aim(21.0, 170.0), "that axis has no such angle"


def test_on_a_mount_that_leans_both_axes_move() -> None:
    azimuth_deg, elevation_deg = LEANS.pointed(100.0, 10.0)
    assert joined(LEANS, Aim(200.0, None), NOWHERE, (100.0, 10.0)) == Aim(200.0, elevation_deg)
    assert joined(LEANS, Aim(None, 40.0), NOWHERE, (100.0, 10.0)) == Aim(azimuth_deg, 40.0)


@pytest.mark.parametrize("aim", [Aim(70.0, 30.0), Aim(70.0, None, place=True), Aim(None, 30.0, place=True)])
def test_both_coordinates_and_the_place_of_a_knob_are_taken_as_they_are(aim: Aim) -> None:
    assert joined(FLIPS, aim, (21.0, 31.0), OVER) == aim


@pytest.mark.parametrize("axes", [(None, 150.0), (200.0, None)])
def test_where_an_angle_is_not_known_one_axis_moves(axes: tuple[float | None, float | None]) -> None:
    assert joined(FLIPS, Aim(70.0, None), (21.0, 31.0), axes) == Aim(70.0, None)


def test_an_axis_is_where_it_goes_and_without_a_target_where_it_stands() -> None:
    assert places((0.0, 100.0), (None, 10.0)) == (0.0, 10.0)
    assert places((None, None), (40.0, None)) == (None, 40.0)


@pytest.mark.parametrize(
    ("axes", "sky"),
    [
        ((370.0, 30.0), (10.0, 30.0)),
        ((200.0, 150.0), (20.0, 30.0)),
        ((100.0, 100.0), (280.0, 80.0)),
        ((0.0, 90.0),) * 2,
    ],
)
def test_where_the_antenna_points_as_a_direction_on_the_sky(
    axes: tuple[float, float], sky: tuple[float, float]
) -> None:
    assert direction(*axes) == sky
