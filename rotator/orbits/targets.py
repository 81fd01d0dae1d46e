"""The targets that a person can name: a satellite, Sun or Moon, a planet, a radio source, a place, a direction.

Knows the meaning of the words. Does not know files or the rotor.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.countries import Ambiguous, countries, country
from rotator.orbits.earth import Site, direction
from rotator.orbits.locator import distance_and_bearing, from_locator, long_path_km
from rotator.orbits.names import plain
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import Sight, Target

_LOCATOR = re.compile(r"[A-R]{2}[0-9]{2}(?:[A-X]{2}(?:[0-9]{2})?)?", re.IGNORECASE)
_AZIMUTH = re.compile(r"[0-9]{1,3}([.,][0-9]*)?")
_LONG_PATH = ("long", "lp")
_SHORT_PATH = ("short", "sp")


@dataclass(frozen=True, slots=True)
class Fixed:
    """A direction that does not move."""

    name: str
    where: Sight
    place: str = ""
    """What is there on the earth, such as `Japan`; empty: it is a direction alone."""

    def sight(self, _utc_s: float) -> Sight:
        return self.where

    def late_s(self, _utc_s: float) -> float:
        return 0.0


def find(words: str, site: Site, catalogue: Catalogue) -> Target:
    """The target that these words name. Raises Unknown, NotThere.

    `sun`, `cas a`, `25544`, `so50`, `JN58td`, `JN58td long`, `Japan`, `JA1ABC`, `VK long`, `180 45`; a comma is a
    decimal point, too.
    """
    words = " ".join(words.split())
    there = fixed(words)
    if there is not None:
        return there
    from rotator.orbits.celestial import BODIES, RADIO_SOURCES, Body, RadioSource  # noqa: PLC0415 - slow to load

    plain_words = plain(words)
    if plain_words in BODIES:
        return Body(plain_words, site)
    source = next((name for name in RADIO_SOURCES if plain(name) == plain_words), None)
    if source is not None:
        return RadioSource(source, site)
    # The name of a satellite may look like a locator: SO50 is a satellite, and also a field and square.
    try:
        others = [*(name.title() for name in BODIES), *RADIO_SOURCES, *(each.name for each in countries())]
        return Satellite(catalogue.find(words, others), site)
    except Unknown:
        station = _station(words, site)
        if station is None:
            if _AZIMUTH.fullmatch(words):
                raise Unknown(f'"{words}" is an azimuth without an elevation: write both, such as {words} 30') from None
            raise
        return station


def fixed(words: str) -> Fixed | None:
    """`180 45`; None: the words are no direction. Raises Unknown for impossible numbers."""
    words = " ".join(words.split())
    there = _direction(words)
    return None if there is None else Fixed(words, there)


def _direction(words: str) -> Sight | None:
    """Azimuth and elevation. Raises Unknown for impossible numbers."""
    parts = words.replace(",", ".").split(" ")
    try:
        azimuth_deg, elevation_deg = (float(part) for part in parts)
    except ValueError:
        return None
    if not (0 <= azimuth_deg <= 360 and -90 <= elevation_deg <= 90):
        raise Unknown(f'"{words}": azimuth is from 0 to 360, elevation from -90 to 90')
    return Sight(azimuth_deg % 360.0, elevation_deg, math.inf)


def place(words: str) -> tuple[str, float, float] | None:
    """The name, latitude and longitude of a place: a locator, a country's middle. `FO29`, a satellite, looks like one.

    With or without a path, `JN58td long`. None: it is no place. Raises Unknown where several countries may be meant.
    """
    where, path = and_path(words)
    if _LOCATOR.fullmatch(where):
        longitude_deg, latitude_deg = from_locator(where)
        return f"the locator {words.upper()}", latitude_deg, longitude_deg
    try:
        found = country(where)
    except Ambiguous as reason:
        raise Unknown(str(reason)) from None
    return None if found is None else (f"{found.name} {path}".strip(), found.latitude_deg, found.longitude_deg)


def and_path(words: str) -> tuple[str, str]:
    """A place and its path; the path is empty where none is named."""
    where, _, path = " ".join(words.split()).rpartition(" ")
    return (
        (where, path) if where and path.casefold() in (*_LONG_PATH, *_SHORT_PATH) else (f"{where} {path}".strip(), "")
    )


def _station(words: str, site: Site) -> Fixed | None:
    """Another place on the earth, at the horizon."""
    there = place(words)
    if there is None:
        return None
    name, latitude_deg, longitude_deg = there
    seen = direction(site, Site(latitude_deg, longitude_deg))
    if seen is None:
        raise Unknown(f'"{words}" is where the antenna stands')
    km, _ = distance_and_bearing((site.longitude_deg, site.latitude_deg), (longitude_deg, latitude_deg))
    if and_path(words)[1].casefold() in _LONG_PATH:
        return Fixed(words, Sight((seen[0] + 180.0) % 360.0, 0.0, long_path_km(km)), name)
    return Fixed(words, Sight(seen[0], 0.0, km), name)
