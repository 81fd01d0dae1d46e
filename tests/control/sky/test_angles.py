"""Angles on the circle and on the sphere."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.angles import great_circle_deg, turn_deg

azimuths = st.floats(-720, 720)
elevations = st.floats(-90, 180)


@pytest.mark.parametrize(
    ("start_deg", "end_deg", "turn"),
    [(0, 90, 90), (350, 10, 20), (10, 350, -20), (0, 180, -180), (180, 0, -180), (90, 450, 0), (-10, 10, 20)],
)
def test_the_short_way_round(start_deg: float, end_deg: float, turn: float) -> None:
    assert turn_deg(start_deg, end_deg) == turn


@given(azimuths, azimuths)
def test_a_turn_is_at_most_half_a_circle_and_arrives(start_deg: float, end_deg: float) -> None:
    turn = turn_deg(start_deg, end_deg)
    assert -180 <= turn <= 180
    assert math.cos(math.radians(start_deg + turn - end_deg)) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("a", "b", "angle_deg"),
    [
        ((0, 0), (90, 0), 90),  # along the horizon an azimuth is an angle on the sky
        ((0, 60), (10, 60), 4.9952),  # at 60° it counts about half
        ((0, 90), (123, 90), 0),  # at the zenith nothing
        ((0, 0), (180, 0), 180),
        ((0, 80), (180, 80), 20),  # over the top
        ((10, 20), (10, 20.001), 0.001),
    ],
)
def test_known_angles_on_the_sky(a: tuple[float, float], b: tuple[float, float], angle_deg: float) -> None:
    assert great_circle_deg(*a, *b) == pytest.approx(angle_deg, abs=1e-3)


@given(azimuths, elevations)
def test_over_the_top_is_the_same_point_seen_from_behind(azimuth_deg: float, elevation_deg: float) -> None:
    assert great_circle_deg(azimuth_deg, elevation_deg, azimuth_deg + 180, 180 - elevation_deg) < 1e-6


@given(azimuths, elevations, azimuths, elevations)
def test_it_is_the_same_both_ways(az_a: float, el_a: float, az_b: float, el_b: float) -> None:
    there, back = great_circle_deg(az_a, el_a, az_b, el_b), great_circle_deg(az_b, el_b, az_a, el_a)
    assert there == pytest.approx(back, abs=1e-6)
    assert 0 <= there <= 180
