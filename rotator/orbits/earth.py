"""Places on and above the earth, and how a station sees them: a balloon, a satellite, another station.

Knows the ellipsoid of WGS 84, and straight lines without refraction. Does not know rotors or bytes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from rotator.orbits.sight import Sight

AXIS_M = 6_378_137.0
FLATTENING = 1 / 298.257223563
_SQUARED = FLATTENING * (2 - FLATTENING)
NEAREST_M = 1.0
"""Metres: a place nearer than this has no direction."""

Vector = tuple[float, float, float]
"""Metres from the middle of the earth: to longitude 0, to longitude 90° east, to the north pole."""


@dataclass(frozen=True, slots=True)
class Site:
    """A place on the earth: latitude north, longitude east, metres above the sea."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float = 0.0
    refraction: bool = field(default=False, kw_only=True)
    """Whether targets in the sky are seen through air, with refraction."""

    @property
    def without_air(self) -> Site:
        return replace(self, refraction=False)


class Horizon:
    """The directions around a station."""

    def __init__(self, station: Site) -> None:
        self._here = geocentric(station)
        latitude, longitude = math.radians(station.latitude_deg), math.radians(station.longitude_deg)
        self._cos_lat, self._sin_lat = math.cos(latitude), math.sin(latitude)
        self._cos_lon, self._sin_lon = math.cos(longitude), math.sin(longitude)

    def sight(self, place: Vector) -> Sight:
        """The direction of a place from the station; its own place is straight above it."""
        x, y, z = (there - here for there, here in zip(place, self._here, strict=True))
        outward = x * self._cos_lon + y * self._sin_lon
        east = y * self._cos_lon - x * self._sin_lon
        north = z * self._cos_lat - outward * self._sin_lat
        up = outward * self._cos_lat + z * self._sin_lat
        level = math.hypot(east, north)
        azimuth_deg = math.degrees(math.atan2(east, north)) % 360.0 % 360.0
        return Sight(azimuth_deg, math.degrees(math.atan2(up, level)), math.hypot(level, up) / 1000.0)


def direction(station: Site, place: Site) -> tuple[float, float] | None:
    """Azimuth from 0 to below 360 and elevation, below zero under the horizon. None: the place is the station's own."""
    seen = Horizon(station).sight(geocentric(place))
    return None if seen.range_km * 1000 < NEAREST_M else (seen.azimuth_deg, seen.elevation_deg)


def geocentric(place: Site) -> Vector:
    latitude, longitude = math.radians(place.latitude_deg), math.radians(place.longitude_deg)
    curvature_m = AXIS_M / math.sqrt(1 - _SQUARED * math.sin(latitude) ** 2)
    level_m = (curvature_m + place.altitude_m) * math.cos(latitude)
    up_m = (curvature_m * (1 - _SQUARED) + place.altitude_m) * math.sin(latitude)
    return level_m * math.cos(longitude), level_m * math.sin(longitude), up_m
