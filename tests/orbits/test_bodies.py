"""Sun, Moon, planets and radio sources, compared with skyfield."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits.celestial import BODIES, RADIO_SOURCES, Body, RadioSource
from rotator.orbits.earth import Site
from tests.orbits import skyfield_oracle
from tests.tables import every_row

PROMISED_DEG = 0.01
SITES = st.builds(Site, st.floats(-90, 90), st.floats(-180, 180), st.floats(-400, 4000))
FROM_2024_TO_2035 = st.floats(1_704_067_200, 2_082_758_400)


@pytest.mark.parametrize("name", ["sun", "moon", *skyfield_oracle.PLANETS])
@given(site=SITES, utc_s=FROM_2024_TO_2035)
def test_a_body_is_where_skyfield_sees_it(name: str, site: Site, utc_s: float) -> None:
    seen, expected = Body(name, site).sight(utc_s), skyfield_oracle.of_body(name, site, utc_s)
    assert seen.apart_deg(expected) < PROMISED_DEG
    assert seen.range_km == pytest.approx(expected.range_km, rel=1e-3)


def test_another_name_is_refused_with_the_names_there_are() -> None:
    with pytest.raises(ValueError, match=f'"vulcan" is no body of the sky; there are: {", ".join(BODIES)}'):
        Body("vulcan", Site(0, 0))


@every_row("name", RADIO_SOURCES)
def test_a_radio_source_goes_round_in_a_sidereal_day(name: str) -> None:
    source = RadioSource(name, Site(52.4, 13.1))
    assert source.sight(1.8e9).apart_deg(source.sight(1.8e9 + 86_164.0905)) < PROMISED_DEG
    assert source.sight(1.8e9).apart_deg(source.sight(1.8e9 + 43_082)) > 20


def test_cygnus_a_culminates_in_the_south_of_berlin_at_its_declination() -> None:
    """Declination 40.7° at latitude 52.4° north: 78° high, due south."""
    source = RadioSource("Cyg A", Site(52.4, 13.1))
    highest = max((source.sight(1.8e9 + 60 * minute) for minute in range(1440)), key=lambda seen: seen.elevation_deg)
    assert highest.elevation_deg == pytest.approx(90 - 52.4 + 40.8, abs=0.1)
    assert highest.azimuth_deg == pytest.approx(180, abs=1.5)
