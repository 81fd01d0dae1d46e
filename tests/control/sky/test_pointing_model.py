"""The terms of the mount against rotation matrices, their first-order formulae, and each other."""

from __future__ import annotations

import math
from dataclasses import astuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rotator.control.sky.angles import great_circle_deg, turn_deg, unit
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.pointing_model import PERFECT, PointingModel
from tests.tables import every_row

term = st.floats(-5, 5)
models = st.builds(PointingModel, term, term, term, term, term, term)
azimuths, elevations = st.floats(-180, 540), st.floats(0, 180)


def _about(axis: tuple[float, float, float], angle_deg: float) -> np.ndarray:
    """The matrix that turns about an axis, by the right-hand rule."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(angle_deg)
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross)


def boom_by_matrices(model: PointingModel, azimuth_deg: float, elevation_deg: float) -> np.ndarray:
    """East, north, up, for a boom that points north on level axes; each axis turned with what it carries."""
    east, north, up = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    askew = _about(up, model.ca_deg)
    raised = _about(east, elevation_deg + model.ie_deg)
    hanging = _about(north, -model.npae_deg)
    turned = _about(up, -(azimuth_deg - model.ia_deg))
    lean_deg = math.hypot(model.an_deg, model.aw_deg)
    line = (-model.an_deg / lean_deg, -model.aw_deg / lean_deg, 0.0) if lean_deg else east
    return np.asarray(_about(line, lean_deg) @ turned @ hanging @ raised @ askew @ np.array(north))


@given(models, azimuths, elevations)
def test_the_boom_is_where_the_axes_turned_one_after_the_other_bring_it(
    model: PointingModel, azimuth_deg: float, elevation_deg: float
) -> None:
    assert model.boom(azimuth_deg, elevation_deg) == pytest.approx(
        boom_by_matrices(model, azimuth_deg, elevation_deg), abs=1e-9
    )


@every_row(
    ("model", "axes", "boom"),
    [
        (PointingModel(ia_deg=2), (100, 30), (98, 30)),
        (PointingModel(ie_deg=2), (100, 30), (100, 32)),
        (PointingModel(an_deg=2), (0, 30), (0, 28)),
        (PointingModel(an_deg=2), (180, 30), (180, 32)),
        (PointingModel(aw_deg=2), (270, 30), (270, 28)),
        (PointingModel(aw_deg=2), (90, 30), (90, 32)),
        (PointingModel(ca_deg=2), (100, 0), (98, 0)),
        (PointingModel(npae_deg=2), (100, 0), (100, 0)),
        (PointingModel(npae_deg=2), (100, 90), (10, 88)),
    ],
)
def test_each_term_moves_the_boom_as_its_sign_says(
    model: PointingModel, axes: tuple[float, float], boom: tuple[float, float]
) -> None:
    assert great_circle_deg(*model.pointed(*axes), *boom) < 1e-9


@given(st.builds(PointingModel, *[st.floats(-0.01, 0.01)] * 6), azimuths, st.floats(0, 70))
def test_small_terms_follow_the_formulae_of_the_papers(
    model: PointingModel, azimuth_deg: float, elevation_deg: float
) -> None:
    ia, ie, an, aw, ca, npae = astuple(model)
    az, el = math.radians(azimuth_deg), math.radians(elevation_deg)
    there = model.pointed(azimuth_deg, elevation_deg)
    turn = -ia - ca / math.cos(el) - (npae + an * math.sin(az) + aw * math.cos(az)) * math.tan(el)
    assert there[0] - azimuth_deg == pytest.approx(turn, abs=1e-4)
    assert there[1] - elevation_deg == pytest.approx(ie - an * math.cos(az) + aw * math.sin(az), abs=1e-4)


@given(models, azimuths, elevations)
def test_the_axes_go_to_where_the_boom_points_in_the_direction_ordered(
    model: PointingModel, azimuth_deg: float, elevation_deg: float
) -> None:
    axes = model.axis_angles(azimuth_deg, elevation_deg)
    ordered = unit(azimuth_deg, elevation_deg)
    # Next to the azimuth axis is a place that the boom cannot reach; it is as wide as the boom is not square.
    lean_deg = math.hypot(model.an_deg, model.aw_deg)
    assume(abs(elevation_deg - 90) > 1.5 * lean_deg + abs(model.ca_deg) + abs(model.npae_deg))
    assert model.boom(*axes) == pytest.approx(ordered, abs=1e-9)
    assert model.over_the_top(axes[1]) is (elevation_deg > 90)
    assert model.pointed(*axes) == pytest.approx((azimuth_deg, elevation_deg), abs=1e-6)


@given(models, azimuths, elevations)
def test_the_boom_never_ends_further_off_than_it_is_askew(
    model: PointingModel, azimuth_deg: float, elevation_deg: float
) -> None:
    there = model.pointed(*model.axis_angles(azimuth_deg, elevation_deg))
    assert great_circle_deg(*there, azimuth_deg, elevation_deg) <= abs(model.ca_deg) + abs(model.npae_deg) + 1e-6


@given(models, st.floats(0, 360), st.floats(-12, 12))
def test_past_the_zenith_no_axis_jumps(model: PointingModel, heading_deg: float, aside_deg: float) -> None:
    """Along a line that passes the zenith `aside_deg` away: a step of azimuth moves the boom no more than the target
    moves, as wide as it is from the azimuth axis."""
    step_deg = 0.05
    heading, aside = math.radians(heading_deg), math.radians(aside_deg)
    ahead = np.array([math.sin(heading), math.cos(heading), 0.0])
    right = np.array([math.cos(heading), -math.sin(heading), 0.0])
    before = None
    for count in range(-200, 201):
        along = math.radians(count * step_deg)
        there = math.cos(aside) * (math.cos(along) * np.array([0, 0, 1]) + math.sin(along) * ahead)
        east, north, up = there + math.sin(aside) * right
        direction = math.degrees(math.atan2(east, north)), math.degrees(math.asin(up))
        axes = model.axis_angles(*direction)
        if before is not None:
            turned = math.radians(abs(turn_deg(before[0], axes[0])))
            wide = min(math.cos(math.radians(each[1] + model.ie_deg)) for each in (before, axes))
            if turned < math.pi / 2:  # else the target went across the azimuth axis itself
                assert math.degrees(turned) * wide <= 1.6 * step_deg + 1e-6
            # At the edge of what a boom that is not square cannot reach, elevation moves as a square root does.
            askew_deg = abs(model.ca_deg) + abs(model.npae_deg)
            assert abs(axes[1] - before[1]) <= 1.1 * step_deg + math.sqrt(4 * askew_deg * step_deg) + 1e-6
        before = axes


def test_a_perfect_mount_changes_no_digit() -> None:
    assert PERFECT.axis_angles(123.4, 67.8) == PERFECT.pointed(123.4, 67.8) == (123.4, 67.8)


LEANS = PointingModel(ia_deg=3, ie_deg=-2, an_deg=4, aw_deg=-3, ca_deg=1, npae_deg=-2)
G5500 = Mount(Range(0, 450), Range(0, 180), model=LEANS)


@given(st.floats(0, 359.9), st.floats(8, 80), st.floats(0, 450))
def test_a_direction_is_met_within_the_range(azimuth_deg: float, elevation_deg: float, near_deg: float) -> None:
    axes = G5500.axis_angles(azimuth_deg, elevation_deg, near_deg)
    assert axes[1] is not None
    assert G5500.azimuth.holds(axes[0])
    assert great_circle_deg(*G5500.pointed(axes[0], axes[1]), azimuth_deg, elevation_deg) < 1e-6


@given(st.floats(0, 359.9), st.floats(8, 80), st.floats(-400, 800))
def test_over_the_top_it_points_in_the_same_direction(
    azimuth_deg: float, elevation_deg: float, from_deg: float
) -> None:
    for flipped in (False, True):
        axes = G5500.on_the_way(azimuth_deg, elevation_deg, from_deg, flipped=flipped)
        turned_deg = axes[0] - from_deg
        if abs(turned_deg) > 180:  # as good as half a turn, whose short way ends at the end of the range
            assert abs(turned_deg) <= 181
            assert G5500.azimuth.holds(axes[0])
            assert not G5500.azimuth.holds(axes[0] - math.copysign(360.0, turned_deg))
        assert great_circle_deg(*G5500.pointed(*axes), azimuth_deg, elevation_deg) < 1e-6
        assert LEANS.over_the_top(axes[1]) is flipped


@given(st.floats(0, 359.9), st.floats(-90, 3))
def test_below_the_horizon_the_azimuth_follows_and_the_elevation_rests(
    azimuth_deg: float, elevation_deg: float
) -> None:
    axes = G5500.axis_angles(azimuth_deg, elevation_deg, 180)
    assert axes[1] is not None
    assume(axes[1] == 0)
    assert abs(turn_deg(G5500.pointed(axes[0], 0)[0], azimuth_deg)) < 0.1


def test_a_turn_that_the_sender_names_is_kept() -> None:
    axis_azimuth_deg, _ = G5500.axis_angles(400, 20, 40)
    assert abs(axis_azimuth_deg - 400) < 10


def test_the_park_position_is_a_place_on_the_rotors_own_scale() -> None:
    assert Mount(Range(0, 450), Range(0, 180), 90, 45, model=LEANS).parked() == (90, 45)


def test_trees_are_on_the_sky() -> None:
    mount = Mount(Range(0, 450), Range(0, 90), horizon=((0, 20),), model=PointingModel(ie_deg=5))
    axes = mount.axis_angles(100, 3, 100)
    assert axes == pytest.approx((100, 15))
