"""What a person says, and what it means."""

from __future__ import annotations

import pytest

from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.targets import Fixed, find
from tests.orbits.skyfield_oracle import TLE
from tests.tables import every_row

BERLIN = Site(52.5, 13.4)
KNOWN = Catalogue([str(TLE)])


@every_row(
    ("said", "name"),
    [
        ("sun", "Sun"),
        ("MOON", "Moon"),
        ("Mars", "Mars"),
        ("cas a", "Cas A"),
        ("Cas-A", "Cas A"),
        ("casa", "Cas A"),
        ("sgr a*", "Sgr A*"),
        ("iss", "ISS"),
        ("so50", "SO-50"),
        ("44909", "RS-44"),
        ("JN58td", "JN58td"),
    ],
)
def test_names(said: str, name: str) -> None:
    assert find(said, BERLIN, KNOWN).name == name


@pytest.mark.parametrize("said", ["180 45", "180.0 45.0", "180,0 45,0", " 180   45 "])
def test_two_numbers_are_a_direction(said: str) -> None:
    seen = find(said, BERLIN, KNOWN).sight(0.0)
    assert (seen.azimuth_deg, seen.elevation_deg) == (180.0, 45.0)


@pytest.mark.parametrize("said", ["361 0", "0 91", "nan 3", "1e9 2"])
def test_numbers_that_are_no_direction(said: str) -> None:
    with pytest.raises(Unknown, match="azimuth is from 0 to 360, elevation from -90 to 90"):
        find(said, BERLIN, KNOWN)


def test_another_station_by_its_locator_the_short_way_and_the_long() -> None:
    """Berlin to Tokyo: 42° over Siberia, 8,900 km; or the other way round the earth."""
    short, long = (find(f"PM95{path}", BERLIN, KNOWN).sight(0.0) for path in ("", " long"))
    assert short.azimuth_deg == pytest.approx(42, abs=1)
    assert short.range_km == pytest.approx(8900, abs=100)
    assert long.azimuth_deg == pytest.approx(short.azimuth_deg + 180)
    assert long.range_km + short.range_km == pytest.approx(40_030, abs=20)
    assert (short.elevation_deg, long.elevation_deg) == (0.0, 0.0)


def test_a_country_the_short_way_and_the_long() -> None:
    """From Berlin, New Zealand is nearly on the other side of the earth; a satellite of that name goes first."""
    short, long = (find(f"New Zealand{path}", BERLIN, KNOWN) for path in (" sp", " lp"))
    assert isinstance(short, Fixed)
    assert short.place == "New Zealand sp"
    assert short.where.range_km == pytest.approx(18_000, abs=500)
    assert long.sight(0.0).azimuth_deg == pytest.approx((short.where.azimuth_deg + 180) % 360)
    assert find("JA1ABC", BERLIN, KNOWN).sight(0.0).azimuth_deg == pytest.approx(44, abs=3)
    assert find("iss", BERLIN, KNOWN).name == "ISS"
    with pytest.raises(Unknown, match="may be South Korea, North Korea: name one"):
        find("korea", BERLIN, KNOWN)
    with pytest.raises(Unknown, match="perhaps Germany"):
        find("Germani", BERLIN, KNOWN)


def test_the_own_square_has_no_direction() -> None:
    with pytest.raises(Unknown, match='"JO62qm" is where the antenna stands'):
        find("JO62qm", Site(52.520833, 13.375), KNOWN)


@every_row("said", ["", "isx", "JN58td up", "45", "ZZ99"])
def test_what_is_no_target(said: str) -> None:
    with pytest.raises(Unknown):
        find(said, BERLIN, KNOWN)
