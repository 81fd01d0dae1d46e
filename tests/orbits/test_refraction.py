"""Radio refraction, against a ray followed through ITU's reference atmosphere, SOFA's radio constants, and figures."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import erfa
import pytest

from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.refraction import bent_deg, through_air
from rotator.orbits.sight import Sight
from rotator.orbits.targets import find
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.next_flight import Wanted
from tests.tables import every_row

EARTH_KM = 6370.0
"""As in ITU-R P.834."""


def air(km: float) -> float:
    """The refractive index of ITU-R P.453's reference atmosphere."""
    return 1 + 315e-6 * math.exp(-0.1361 * km)


def followed(apparent_deg: float, station_km: float) -> float:
    """How far a ray is bent on its way down to the station, where it comes in at this elevation: Snell's law."""
    kept = (EARTH_KM + station_km) * air(station_km) * math.cos(math.radians(apparent_deg))
    total, pieces, top = 0.0, 4000, math.sqrt(120.0)
    for piece in range(pieces):
        root = (piece + 0.5) * top / pieces
        km = station_km + root**2
        cos = kept / ((EARTH_KM + km) * air(km))
        slope = (air(km) - 1) * 0.1361 / air(km)
        total += slope * cos / math.sqrt(1 - cos**2) * 2 * root * top / pieces
    return math.degrees(total)


@every_row("station_km", [0.0, 0.5, 1.0, 2.0, 3.0])
@every_row("apparent_deg", [0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 6.0, 8.0, 10.0, 15.0, 30.0, 60.0, 85.0])
def test_it_is_that_of_a_ray_through_the_reference_atmosphere(apparent_deg: float, station_km: float) -> None:
    true_deg = apparent_deg - followed(apparent_deg, station_km)
    assert bent_deg(true_deg, station_km * 1000) == pytest.approx(followed(apparent_deg, station_km), abs=0.015)


@every_row("elevation_deg", [15.0, 20.0, 30.0, 45.0, 60.0, 80.0])
def test_higher_up_it_is_that_of_sofas_radio_constants(elevation_deg: float) -> None:
    """At 1013 hPa, 15 °C and 60 % humidity, for 1.5 GHz (200 mm)."""
    a, b = erfa.refco(1013.25, 15.0, 0.6, 200_000.0)
    tan = math.tan(math.radians(90.0 - elevation_deg))
    assert bent_deg(elevation_deg) == pytest.approx(math.degrees(a * tan + b * tan**3), abs=0.002)


@pytest.mark.parametrize(("elevation_deg", "published"), [(0.0, 0.579), (1.0, 0.434), (5.0, 0.1874), (-0.5, 0.681)])
def test_at_sea_level_the_recommendations_own_equation(elevation_deg: float, published: float) -> None:
    """Worked out by hand from 1 / (1.728 + 0.5411 θ + 0.03723 θ²)."""
    assert bent_deg(elevation_deg) == pytest.approx(published, abs=0.001)


def test_it_never_jumps_and_never_turns_the_sky_upside_down() -> None:
    seen = [at / 100 + bent_deg(at / 100) for at in range(-1000, 9001)]
    steps = [after - before for before, after in pairwise(seen)]
    assert min(steps) > 0.005
    assert max(steps) < 0.0101
    assert bent_deg(90.0) == pytest.approx(0.0, abs=1e-9)


def test_only_a_station_that_wants_it_gets_it() -> None:
    low = Sight(120.0, 0.0, 400_000.0)
    assert through_air(low, Site(48.0, 11.0)) == low
    assert through_air(low, Site(48.0, 11.0, refraction=True)).elevation_deg == pytest.approx(0.579, abs=0.001)


@pytest.mark.parametrize("words", ["moon", "sun", "cas a"])
def test_what_the_box_computes_rises_by_as_much(words: str) -> None:
    plain, seen = (find(words, Site(48.0, 11.0, refraction=on), Catalogue(())) for on in (False, True))
    for utc_s in range(1_780_000_000, 1_780_086_400, 7200):
        true = plain.sight(utc_s)
        assert seen.sight(utc_s) == through_air(true, Site(48.0, 11.0, refraction=True))


def test_the_sun_rises_earlier_and_sets_later() -> None:
    plain, seen = (
        next(passes(find("sun", Site(48.0, 11.0, refraction=on), Catalogue(())), 1_780_000_000, 1_780_100_000))
        for on in (False, True)
    )
    assert plain.aos_s is not None
    assert seen.aos_s is not None
    # The Sun climbs 15° × cos 48° × sin 55° an hour there in May: 0.76° is 5 to 6 minutes.
    assert 4 * 60 < plain.aos_s - seen.aos_s < 8 * 60


def test_another_station_on_the_earth_is_not_lifted() -> None:
    assert find("JO62qm", Site(48.0, 11.0, refraction=True), Catalogue(())).sight(0.0).elevation_deg == 0.0


def test_a_satellite_that_a_program_sends_is_recognised_without_air_and_one_that_the_box_tracks_is_not() -> None:
    sky = KnownSky(Site(48.0, 11.0, refraction=True), Catalogue([str(Path(__file__).with_name("elements-2025.tle"))]))
    sent = sky.satellites()[0]
    tracked = sky.find(str(sent.elements.catalogue_number))
    assert isinstance(tracked, Wanted)
    at_s = sent.elements.epoch_utc_s
    lifted = tracked.target().sight(at_s).elevation_deg - sent.sight(at_s).elevation_deg
    assert lifted == pytest.approx(bent_deg(sent.sight(at_s).elevation_deg))
