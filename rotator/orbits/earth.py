"""Where a place on or above the earth stands, as the antenna sees it: for a balloon, an aircraft, another station.

Knows the ellipsoid of WGS 84, and straight lines without refraction. Does not know rotors or bytes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

AXIS_M = 6_378_137.0
FLATTENING = 1 / 298.257223563
_SQUARED = FLATTENING * (2 - FLATTENING)
NEAREST_M = 1.0
"""A place nearer than this has no direction."""

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Site:
    """A place on the earth: latitude north, longitude east, metres above the sea."""

    latitude_deg: float
    longitude_deg: float
    altitude_m: float = 0.0


def direction(station: Site, place: Site) -> tuple[float, float] | None:
    """Azimuth from 0 to below 360 and elevation, below zero under the horizon. None: the place is the station's own."""
    east, north, up = _to_horizon(station, _difference(_geocentric(place), _geocentric(station)))
    level_m = math.hypot(east, north)
    if math.hypot(level_m, up) < NEAREST_M:
        return None
    return math.degrees(math.atan2(east, north)) % 360.0 % 360.0, math.degrees(math.atan2(up, level_m))


def _geocentric(place: Site) -> Vector:
    latitude, longitude = math.radians(place.latitude_deg), math.radians(place.longitude_deg)
    curvature_m = AXIS_M / math.sqrt(1 - _SQUARED * math.sin(latitude) ** 2)
    level_m = (curvature_m + place.altitude_m) * math.cos(latitude)
    up_m = (curvature_m * (1 - _SQUARED) + place.altitude_m) * math.sin(latitude)
    return level_m * math.cos(longitude), level_m * math.sin(longitude), up_m


def _difference(there: Vector, here: Vector) -> Vector:
    return there[0] - here[0], there[1] - here[1], there[2] - here[2]


def _to_horizon(station: Site, way: Vector) -> Vector:
    """East, north, up."""
    latitude, longitude = math.radians(station.latitude_deg), math.radians(station.longitude_deg)
    outward = way[0] * math.cos(longitude) + way[1] * math.sin(longitude)
    east = -way[0] * math.sin(longitude) + way[1] * math.cos(longitude)
    north = -outward * math.sin(latitude) + way[2] * math.cos(latitude)
    return east, north, outward * math.cos(latitude) + way[2] * math.sin(latitude)
