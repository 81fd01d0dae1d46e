"""Angles on the circle and on the sphere."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.angles import Vector, direction_of, dot, great_circle_deg, lifted_deg, turn_deg, unit
from tests.tables import every_row

azimuths = st.floats(-720, 720)
elevations = st.floats(-90, 180)


@every_row(
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


@every_row(
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


# --- vectors: to the east, to the north and up


@every_row(
    ("direction", "vector"),
    [
        ((0, 0), (0, 1, 0)),
        ((90, 0), (1, 0, 0)),
        ((180, 0), (0, -1, 0)),
        ((30, 0), (0.5, 0.8660, 0)),
        ((30, 60), (0.25, 0.4330, 0.8660)),
        ((77, 90), (0, 0, 1)),
        ((0, 150), (0, -0.8660, 0.5)),
        ((-90, -30), (-0.8660, 0, -0.5)),
    ],
)
def test_a_direction_as_a_vector(direction: tuple[float, float], vector: Vector) -> None:
    assert unit(*direction) == pytest.approx(vector, abs=1e-4)


@given(st.floats(-179, 179), st.floats(-89, 89), st.floats(0.1, 50.0))
def test_a_vector_of_any_length_has_its_direction_back(azimuth_deg: float, elevation_deg: float, long: float) -> None:
    east, north, up = unit(azimuth_deg, elevation_deg)
    assert direction_of((east * long, north * long, up * long)) == pytest.approx((azimuth_deg, elevation_deg))


@given(azimuths, elevations, azimuths, elevations)
def test_the_product_of_two_directions_is_the_cosine_between_them(
    az_a: float, el_a: float, az_b: float, el_b: float
) -> None:
    between_deg = great_circle_deg(az_a, el_a, az_b, el_b)
    assert dot(unit(az_a, el_a), unit(az_b, el_b)) == pytest.approx(math.cos(math.radians(between_deg)), abs=1e-9)


@given(st.floats(-180, 180), st.floats(0, 90), st.floats(0, 90))
def test_no_other_elevation_points_nearer_while_azimuth_is_off(off_deg: float, target_deg: float, other: float) -> None:
    lifted = lifted_deg(off_deg, target_deg)
    assert target_deg - 1e-9 <= lifted <= 90.0
    nearest_deg = great_circle_deg(off_deg, lifted, 0.0, target_deg)
    assert nearest_deg <= great_circle_deg(off_deg, other, 0.0, target_deg) + 1e-6
    assert nearest_deg <= 90.0 - target_deg + 1e-6


@given(st.floats(-180, 180), st.floats(0, 90), st.floats(0, 180))
def test_past_the_zenith_too_no_other_elevation_points_nearer(off_deg: float, target_deg: float, other: float) -> None:
    lifted = lifted_deg(off_deg, target_deg, over_top=True)
    assert target_deg - 1e-9 <= lifted <= 180.0 - target_deg + 1e-9
    nearest_deg = great_circle_deg(off_deg, lifted, 0.0, target_deg)
    assert nearest_deg <= great_circle_deg(off_deg, other, 0.0, target_deg) + 1e-6
