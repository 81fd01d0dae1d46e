"""Satellites, compared with skyfield: at random moments, from random places."""

from __future__ import annotations

import math
import random
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.orbits import tle
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements, NotAnOrbit
from rotator.orbits.moments import DAY_S
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, expected_error_deg, motion
from tests.orbits import skyfield_oracle
from tests.search import examples

PROMISED_DEG = 0.01
FLYING = {
    each.name: each for each in tle.read(skyfield_oracle.TLE.read_text(encoding="utf-8")) if not isinstance(each, str)
}
PARIS = Site(48.85, 2.35, 35.0)
LATEST_S = 2_082_758_400.0
"""The end of 2035."""


@given(
    name=st.sampled_from(sorted(FLYING)),
    site=st.builds(Site, st.floats(-90, 90), st.floats(-180, 180), st.floats(-400, 4000)),
    days=st.floats(-400, 3900),
)
def test_a_satellite_is_where_skyfield_sees_it(name: str, site: Site, days: float) -> None:
    elements = FLYING[name]
    utc_s = min(elements.epoch_utc_s + days * DAY_S, LATEST_S)
    if name == "ISS":
        utc_s = elements.epoch_utc_s + days / 39 * DAY_S  # later its elements say that it has come down
    seen, expected = Satellite(elements, site).sight(utc_s), skyfield_oracle.of_satellite(name, site, utc_s)
    assert seen.apart_deg(expected) < PROMISED_DEG
    assert seen.range_km == pytest.approx(expected.range_km, abs=0.5)


def test_its_number_may_have_nine_digits() -> None:
    utc_s = FLYING["SO-50"].epoch_utc_s + 1000
    named = replace(FLYING["SO-50"], catalogue_number=799_501_234)
    assert Satellite(named, PARIS).sight(utc_s) == Satellite(FLYING["SO-50"], PARIS).sight(utc_s)


def test_rates_are_the_change_of_the_direction() -> None:
    iss = Satellite(FLYING["ISS"], PARIS)
    for minute in range(100):
        utc_s = FLYING["ISS"].epoch_utc_s + 60 * minute
        moving, before, after = motion(iss, utc_s), iss.sight(utc_s - 2), iss.sight(utc_s + 2)
        turned_deg = math.remainder(after.azimuth_deg - before.azimuth_deg, 360)
        if abs(moving.sight.elevation_deg) < 80:
            assert moving.azimuth_dps == pytest.approx(turned_deg / 4, abs=0.01)
        assert moving.elevation_dps == pytest.approx((after.elevation_deg - before.elevation_deg) / 4, abs=0.01)


def test_elements_of_a_satellite_that_has_come_down_are_an_error() -> None:
    falling = replace(FLYING["ISS"], drag_per_earth_radius=0.05)
    with pytest.raises(NotThere, match="ISS: "):
        Satellite(falling, PARIS).sight(falling.epoch_utc_s + 300 * DAY_S)


def test_the_expected_error_grows_with_age_and_with_the_clocks_error() -> None:
    """A kilometre along the orbit is 0.11° for a satellite 500 km overhead, a second of the clock 0.87°."""
    iss = Satellite(FLYING["ISS"], PARIS)
    rng = random.Random(5)
    for _ in range(50):
        epoch_s = FLYING["ISS"].epoch_utc_s
        utc_s = epoch_s + rng.uniform(0, DAY_S)
        ages = [
            expected_error_deg(iss, utc_s),
            expected_error_deg(iss, utc_s, 1.0),
            expected_error_deg(iss, utc_s, 5.0),
        ]
        assert ages == sorted(ages)
    assert iss.late_s(epoch_s) < iss.late_s(epoch_s + 10 * DAY_S) < iss.late_s(epoch_s - 30 * DAY_S)


@pytest.mark.parametrize("revolutions", [1.0, 2.0, 7.0, 30.0])
def test_elements_that_are_whole_revolutions_wrong_are_no_good_ones(revolutions: float) -> None:
    """A satellite that may be a revolution late may be half of one late, on the other side of the earth."""
    iss = Satellite(FLYING["ISS"], PARIS)
    rng = random.Random(7)
    for _ in range(20):
        utc_s = FLYING["ISS"].epoch_utc_s + rng.uniform(0, DAY_S)
        here = iss.sight(utc_s)
        half_deg = max(here.apart_deg(iss.sight(utc_s + side * iss.period_s / 2)) for side in (-1, 1))
        assert expected_error_deg(iss, utc_s, revolutions * iss.period_s) > 0.8 * half_deg


def test_a_satellite_that_may_have_come_down_may_be_anywhere() -> None:
    falling = Satellite(replace(FLYING["ISS"], drag_per_earth_radius=0.05, mean_motion_dot=0.5), PARIS)
    day = next(day for day in range(1, 300) if not _is_up(falling, day))
    assert expected_error_deg(falling, falling.elements.epoch_utc_s + (day - 1) * DAY_S, 2 * DAY_S) == 180.0


def _is_up(satellite: Satellite, day: int) -> bool:
    try:
        satellite.sight(satellite.elements.epoch_utc_s + day * DAY_S)
    except NotThere:
        return False
    return True


NUMBERS = st.floats() | st.floats(-1000, 1000)


@settings(max_examples=examples(300))
@given(
    st.builds(
        lambda **numbers: numbers,
        mean_motion_rev_per_day=NUMBERS,
        eccentricity=NUMBERS,
        inclination_deg=NUMBERS,
        ascending_node_deg=NUMBERS,
        perigee_argument_deg=NUMBERS,
        mean_anomaly_deg=NUMBERS,
        drag_per_earth_radius=NUMBERS,
        mean_motion_dot=NUMBERS,
        mean_motion_ddot=NUMBERS,
    ),
    st.floats(-1e10, 1e10),
)
def test_odd_numbers_are_refused_or_give_a_direction(numbers: dict[str, float], utc_s: float) -> None:
    try:
        seen = Satellite(Elements("odd", 1, 0.0, **numbers), PARIS).sight(utc_s)
    except (NotAnOrbit, NotThere):
        return
    assert 0 <= seen.azimuth_deg < 360
    assert -90 <= seen.elevation_deg <= 90
