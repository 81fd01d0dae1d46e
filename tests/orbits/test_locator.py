"""Places on the earth. Figures are what Hamlib 4.5.4 prints, or geography."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits.locator import (
    KM_PER_DEG,
    distance_and_bearing,
    from_dms,
    from_locator,
    long_path_bearing,
    long_path_km,
    to_dmm,
    to_dms,
    to_locator,
)
from tests.tables import every_row

LONGITUDES, LATITUDES = st.floats(-179.9, 179.9), st.floats(-89.9, 89.9)


@every_row(
    ("longitude_deg", "latitude_deg", "pairs", "text"),
    [
        (-70.5, 42.3, 3, "FN42SH"),
        (-70.5, 42.3, 1, "FN"),
        (-70.5, 42.3, 6, "FN42SH02AA00"),
        (170.5, -42.3, 3, "RE57GQ"),
        (12.3456789, -45.6789012, 6, "JE64EH17LB55"),
        (-179.99, 89.99, 6, "AR09AX17EO84"),
        (-180, -90, 3, "AA00AA"),
        (180, 90, 3, "AA00AA"),
        (200, 42, 3, "BN02AA"),
        (10 + 1 / 12, 50.041667, 3, "JO50BB"),  # a corner, written with six decimals
    ],
)
def test_to_locator(longitude_deg: float, latitude_deg: float, pairs: int, text: str) -> None:
    assert to_locator(longitude_deg, latitude_deg, pairs) == text


@every_row(
    ("text", "place"),
    [
        ("FN42rh", (-70.541667, 42.3125)),
        ("fn42RH", (-70.541667, 42.3125)),
        ("FN42", (-71, 42.5)),
        ("FN42r", (-71, 42.5)),
        ("FN", (-70, 45)),
        ("RR99xx", (179.958333, 89.979167)),
        ("FN42rh12ab", (-70.574826, 42.300260)),
        ("FN42rh12ab34cd", (-70.574878, 42.300252)),
    ],
)
def test_from_locator(text: str, place: tuple[float, float]) -> None:
    assert from_locator(text) == pytest.approx(place, abs=1e-6)


@every_row("text", ["", "F", "ZZ99zz", "SS00aa", "4242", "FNAA", "FN42yy", "FN42rh12ay", "ÄÖ42", "FN4²"])
def test_what_is_no_locator(text: str) -> None:
    with pytest.raises(ValueError, match="locator"):
        from_locator(text)


@given(LONGITUDES, LATITUDES, st.integers(1, 6))
def test_a_place_is_in_its_own_square(longitude_deg: float, latitude_deg: float, pairs: int) -> None:
    text = to_locator(longitude_deg, latitude_deg, pairs)
    assert len(text) == 2 * pairs
    middle = from_locator(text)
    assert to_locator(*middle, pairs) == text
    side_deg = 180.0
    for base in (18, 10, 24, 10, 24, 10)[:pairs]:
        side_deg /= base
    assert abs(middle[0] - longitude_deg) <= side_deg + 1e-5
    assert abs(middle[1] - latitude_deg) <= side_deg / 2 + 1e-5


@every_row(
    ("decimal_deg", "dms"),
    [
        (-70.51, (70, 30, 36, True)),
        (70.51, (70, 30, 36, False)),
        (0, (0, 0, 0, False)),
        (12.1, (12, 6, 0, False)),  # Hamlib: 12 5 60
        (190.5, (169, 30, 0, True)),
        (400.123, (40, 7, 22.8, False)),
        (180, (180, 0, 0, False)),
        (-180, (180, 0, 0, False)),
        (359.999, (0, 0, 3.6, True)),
    ],
)
def test_degrees_minutes_seconds(decimal_deg: float, dms: tuple[int, int, float, bool]) -> None:
    assert to_dms(decimal_deg) == pytest.approx(dms, abs=1e-5)


def test_degrees_and_decimal_minutes() -> None:
    assert to_dmm(-70.51) == pytest.approx((70, 30.6, True))
    assert to_dmm(70.999999) == pytest.approx((70, 59.99994, False))
    assert to_dmm(180) == (180, 0, False)


@given(st.floats(-179.999, 179.999))
def test_there_and_back(decimal_deg: float) -> None:
    degrees, minutes, seconds, is_negative = to_dms(decimal_deg)
    assert 0 <= minutes < 60
    assert 0 <= seconds < 60
    assert from_dms(degrees, minutes, seconds, south_or_west=is_negative) == pytest.approx(decimal_deg, abs=1e-9)
    degrees, decimal_minutes, is_negative = to_dmm(decimal_deg)
    assert from_dms(degrees, decimal_minutes, 0, south_or_west=is_negative) == pytest.approx(decimal_deg, abs=1e-7)


def test_the_signs_of_the_parts_mean_nothing() -> None:
    assert from_dms(-70, 30, 36, south_or_west=False) == pytest.approx(70.51)
    assert from_dms(10, -5, -6, south_or_west=True) == pytest.approx(-10.085)


@every_row(
    ("here", "there", "km", "bearing_deg"),
    [
        ((-70.5, 42.3), (10.2, 50.1), 5963.774144, 52),
        ((0, 0), (90, 0), 90 * KM_PER_DEG, 90),
        ((10, 0), (0, 0), 10 * KM_PER_DEG, 270),
        ((0, 0), (10, 0.2), 1112.220115, 89),
        ((5, 5), (-10, 60), 6247.073887, 351),
        ((0, 90), (0, 0), 90 * KM_PER_DEG, 180),
        ((0, 0), (0, 90), 90 * KM_PER_DEG, 0),
        ((7, 50), (7, 50), 0, 0),
        ((0, 0), (180, 0), 180 * KM_PER_DEG, 0),
    ],
)
def test_distance_and_bearing(
    here: tuple[float, float], there: tuple[float, float], km: float, bearing_deg: float
) -> None:
    assert distance_and_bearing(here, there) == pytest.approx((km, bearing_deg), abs=1e-6)


@given(LONGITUDES, LATITUDES, LONGITUDES, LATITUDES)
def test_it_is_as_far_back(lon_a: float, lat_a: float, lon_b: float, lat_b: float) -> None:
    there_km, _ = distance_and_bearing((lon_a, lat_a), (lon_b, lat_b))
    back_km, _ = distance_and_bearing((lon_b, lat_b), (lon_a, lat_a))
    assert there_km == pytest.approx(back_km, abs=1e-6)
    assert 0 <= there_km <= 180 * KM_PER_DEG


@pytest.mark.parametrize("place", [(181, 0), (-180.5, 0), (0, 90.1), (0, -95)])
def test_what_is_no_place(place: tuple[float, float]) -> None:
    with pytest.raises(ValueError, match="no place on the earth"):
        distance_and_bearing((0, 0), place)


def test_the_long_path() -> None:
    assert [long_path_bearing(deg) for deg in (0, 30, 180, 200, 360)] == [180, 210, 0, 20, 180]
    assert long_path_km(1000) == 39032
    for wrong_deg in (-10, 400):
        with pytest.raises(ValueError, match="no bearing"):
            long_path_bearing(wrong_deg)
