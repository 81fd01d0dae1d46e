"""A satellite that is where a test wants it: its orbit as a TLE, and the direction in which a station sees it.

Knows circular orbits over a round Earth, which over some minutes is right to half a degree or so. Knows no radio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

EARTH_KM = 6371.0
DAY_MIN = 1440.0
GM_KM3_PER_S2 = 398600.4
SIDEREAL_DEG_PER_DAY = 360.98564736629
J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)


@dataclass(frozen=True, slots=True)
class Station:
    latitude_deg: float
    longitude_deg: float


@dataclass(frozen=True, slots=True)
class Satellite:
    """On its way north, it crosses `over` at `at`."""

    name: str
    over: Station
    at: datetime
    inclination_deg: float = 70.0
    period_min: float = 105.0
    catalogue_number: int = 99999

    @property
    def _rate_deg_per_min(self) -> float:
        return 360.0 / self.period_min

    @property
    def _orbit_km(self) -> float:
        return math.pow(GM_KM3_PER_S2 * (self.period_min * 60 / math.tau) ** 2, 1 / 3)

    @property
    def _from_node_deg(self) -> float:
        """How far it has come from the equator when it is at `over`."""
        sines = math.sin(math.radians(self.over.latitude_deg)) / math.sin(math.radians(self.inclination_deg))
        return math.degrees(math.asin(sines))

    @property
    def _node_deg(self) -> float:
        """Right ascension of the point where it crosses the equator."""
        east_deg = _east_of_node_deg(self._from_node_deg, self.inclination_deg)
        return (self.over.longitude_deg + _greenwich_deg(self.at) - east_deg) % 360

    def tle(self, epoch: datetime) -> tuple[str, str]:
        """The two lines, for `epoch`."""
        minutes = (epoch - self.at) / timedelta(minutes=1)
        anomaly_deg = (self._from_node_deg + self._rate_deg_per_min * minutes) % 360
        day = (epoch - datetime(epoch.year, 1, 1, tzinfo=UTC)) / timedelta(days=1) + 1
        number = f"{self.catalogue_number:05d}"
        first = f"1 {number}U 26001A   {epoch.year % 100:02d}{day:012.8f}  .00000000  00000-0  00000-0 0  999"
        second = (
            f"2 {number} {self.inclination_deg:8.4f} {self._node_deg:8.4f} 0000100   0.0000 {anomaly_deg:8.4f} "
            f"{DAY_MIN / self.period_min:11.8f}    1"
        )
        return first + _checksum(first), second + _checksum(second)

    def direction(self, station: Station, moment: datetime) -> tuple[float, float]:
        """Azimuth and elevation in degrees."""
        minutes = (moment - self.at) / timedelta(minutes=1)
        from_node_deg = self._from_node_deg + self._rate_deg_per_min * minutes
        inclination, along = math.radians(self.inclination_deg), math.radians(from_node_deg)
        latitude = math.asin(math.sin(inclination) * math.sin(along))
        right_ascension_deg = self._node_deg + _east_of_node_deg(from_node_deg, self.inclination_deg)
        east = math.radians(right_ascension_deg - _greenwich_deg(moment) - station.longitude_deg)
        here = math.radians(station.latitude_deg)
        x, y, z = math.cos(latitude) * math.sin(east), math.cos(latitude) * math.cos(east), math.sin(latitude)
        north, up = z * math.cos(here) - y * math.sin(here), z * math.sin(here) + y * math.cos(here)
        above = math.atan2(up - EARTH_KM / self._orbit_km, math.hypot(x, north))
        return math.degrees(math.atan2(x, north)) % 360, math.degrees(above)


def apart_deg(one: tuple[float, float], other: tuple[float, float]) -> float:
    """The angle in the sky between two directions (azimuth, elevation)."""
    (az_a, el_a), (az_b, el_b) = (tuple(map(math.radians, direction)) for direction in (one, other))
    haversine = math.sin((el_a - el_b) / 2) ** 2 + math.cos(el_a) * math.cos(el_b) * math.sin((az_a - az_b) / 2) ** 2
    return math.degrees(2 * math.asin(math.sqrt(min(1.0, haversine))))


def _east_of_node_deg(from_node_deg: float, inclination_deg: float) -> float:
    along, inclination = math.radians(from_node_deg), math.radians(inclination_deg)
    return math.degrees(math.atan2(math.cos(inclination) * math.sin(along), math.cos(along)))


def _greenwich_deg(moment: datetime) -> float:
    """Right ascension that stands over Greenwich."""
    return (280.46061837 + SIDEREAL_DEG_PER_DAY * ((moment - J2000) / timedelta(days=1))) % 360


def _checksum(line: str) -> str:
    return str(sum(int(sign) if sign.isdigit() else sign == "-" for sign in line) % 10)
