"""The sky, compared with ERFA, the astronomers' own library: every place on the earth, 28 years, every star."""

from __future__ import annotations

import math

import erfa
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.orbits.earth import Site
from rotator.orbits.moments import DAY_S, J2000_S

J2000_JD = 2_451_545.0
PROMISED_DEG = 0.02
"""A fifth of the 0.1° that an antenna needs."""

SITES = st.builds(Site, st.floats(-89.9, 89.9), st.floats(-180, 180), st.floats(-400, 9000))
MOMENTS = st.floats(J2000_S, J2000_S + 28 * 365.25 * DAY_S)
STARS = st.tuples(st.floats(0, 359.999), st.floats(-90, 90))


def apart_deg(one: tuple[float, float], other: tuple[float, float]) -> float:
    """The angle between two directions (longitude, latitude)."""
    (lon_a, lat_a), (lon_b, lat_b) = (tuple(map(math.radians, each)) for each in (one, other))
    half = math.sin((lat_a - lat_b) / 2) ** 2 + math.cos(lat_a) * math.cos(lat_b) * math.sin((lon_a - lon_b) / 2) ** 2
    return math.degrees(2 * math.asin(math.sqrt(min(1.0, half))))


def seen_by_erfa(star: Star, at_s: float, site: Site) -> tuple[float, float]:
    """Azimuth and elevation without air, with everything that ERFA knows: aberration and light bending too."""
    day = (at_s - J2000_S) / DAY_S
    place = (math.radians(site.longitude_deg), math.radians(site.latitude_deg), site.altitude_m)
    right_ascension, declination = math.radians(star.right_ascension_deg), math.radians(star.declination_deg)
    if star.equinox is Equinox.J2000:
        azimuth, zenith, *_ = erfa.atco13(
            right_ascension, declination, 0, 0, 0, 0, J2000_JD, day, 0, *place, 0, 0, 0, 0, 0, 0.5
        )
    else:
        origins = erfa.eo06a(J2000_JD, day)
        azimuth, zenith, *_ = erfa.atio13(
            right_ascension + origins, declination, J2000_JD, day, 0, *place, 0, 0, 0, 0, 0, 0.5
        )
    return math.degrees(azimuth) % 360, 90 - math.degrees(zenith)


@pytest.mark.parametrize("equinox", Equinox)
@given(site=SITES, at_s=MOMENTS, place=STARS)
def test_a_star_stands_where_erfa_sees_it(
    equinox: Equinox, site: Site, at_s: float, place: tuple[float, float]
) -> None:
    star = Star(*place, equinox)
    assert apart_deg(Sky(site, lambda: at_s).direction(star), seen_by_erfa(star, at_s, site)) < PROMISED_DEG


@pytest.mark.parametrize("equinox", Equinox)
@given(site=SITES, at_s=MOMENTS, azimuth_deg=st.floats(0, 360), elevation_deg=st.floats(-90, 90))
def test_there_and_back(equinox: Equinox, site: Site, at_s: float, azimuth_deg: float, elevation_deg: float) -> None:
    sky = Sky(site, lambda: at_s)
    star = sky.star(azimuth_deg, elevation_deg, equinox)
    assert star.equinox is equinox
    assert 0 <= star.right_ascension_deg < 360
    assert apart_deg(sky.direction(star), (azimuth_deg, elevation_deg)) < 1e-6


def test_the_pole_star_is_north_as_high_as_the_latitude() -> None:
    azimuth_deg, elevation_deg = Sky(Site(52.5, 13.4), lambda: 1.8e9).direction(Star(37.95, 89.26, Equinox.J2000))
    assert elevation_deg == pytest.approx(52.5, abs=0.8)
    assert min(azimuth_deg, 360 - azimuth_deg) < 1.3


@given(at_s=MOMENTS, longitude_deg=st.floats(-180, 180))
def test_the_sidereal_time(at_s: float, longitude_deg: float) -> None:
    day = (at_s - J2000_S) / DAY_S
    greenwich_h = math.degrees(erfa.gst06a(J2000_JD, day, J2000_JD, day + 69 / DAY_S)) / 15
    expected_h = (greenwich_h + longitude_deg / 15) % 24
    off_h = (Sky(Site(0, longitude_deg), lambda: at_s).sidereal_h() - expected_h + 12) % 24 - 12
    assert abs(off_h) < 1e-5
