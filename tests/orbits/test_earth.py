"""Where a place on or above the earth stands, as the antenna sees it."""

from __future__ import annotations

import math

import erfa
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits.earth import Site, direction
from tests.tables import every_row

BERLIN = Site(52.52, 13.405, 34)
PLACES = st.builds(Site, st.floats(-89, 89), st.floats(-180, 180), st.floats(0, 40_000))


@every_row(
    ("place", "azimuth_deg", "elevation_deg"),
    [
        (Site(52.52, 13.405, 30_000), None, 90),
        (Site(53.52, 13.405, 34), 0, -0.5),
        (Site(51.52, 13.405, 34), 180, -0.5),
        (Site(52.52, 13.5, 34), 90, -0.03),
        (Site(52.52, 13.3, 34), 270, -0.03),
        # 100 km away and 30 km up: 16.7° less half the earth's curve of 0.9°.
        (Site(52.52 + 100 / 111.27, 13.405, 30_034), 0, 16.25),
    ],
)
def test_a_place(place: Site, azimuth_deg: float | None, elevation_deg: float) -> None:
    seen = direction(BERLIN, place)
    assert seen is not None
    assert seen[1] == pytest.approx(elevation_deg, abs=0.05)
    if azimuth_deg is not None:
        assert (seen[0] - azimuth_deg + 180) % 360 - 180 == pytest.approx(0, abs=0.1)


def test_the_station_itself_is_no_direction() -> None:
    assert direction(BERLIN, BERLIN) is None


@given(station=PLACES, place=PLACES)
def test_as_erfa_has_it(station: Site, place: Site) -> None:
    """The same points on the ellipsoid, and the elevation as the angle from the plumb line."""
    here, there = (
        erfa.gd2gc(1, math.radians(each.longitude_deg), math.radians(each.latitude_deg), each.altitude_m)
        for each in (station, place)
    )
    seen = direction(station, place)
    way = there - here
    far_m = math.sqrt(sum(way**2))
    if seen is None:
        assert far_m < 1.1
        return
    lat, lon = math.radians(station.latitude_deg), math.radians(station.longitude_deg)
    up = (math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat))
    risen = sum(each * along for each, along in zip(up, way, strict=True)) / far_m
    assert math.sin(math.radians(seen[1])) == pytest.approx(risen, abs=1e-6)
    assert 0 <= seen[0] < 360
