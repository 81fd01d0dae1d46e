"""The sky over the station: where a star stands now, and which place among the stars a direction of the antenna is.

Knows the station's place, and asks the clock that it is given. Precession, nutation and sidereal time are
astronomy-engine's. Does not know the rotor, or bytes. Angles are in degrees, without refraction: at elevation 5° a star
seems 0.15° higher, at the horizon 0.5°.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import astronomy

from rotator.orbits.earth import Site

J2000_S = 946_728_000.0
"""Noon of 1 January 2000 UTC, in seconds since 1970."""
DAY_S = 86_400.0
DEG_PER_H = 15.0


class Equinox(Enum):
    """Whose equator and equinox right ascension and declination are counted from."""

    J2000 = "J2000"
    OF_DATE = "JNow"


@dataclass(frozen=True, slots=True)
class Star:
    """A place among the stars. It moves over the horizon as the earth turns."""

    right_ascension_deg: float
    declination_deg: float
    equinox: Equinox


class Sky:
    """The sky over `site` at the moment that `utc` gives, in seconds since 1970."""

    def __init__(self, site: Site, utc: Callable[[], float]) -> None:
        self.site = site
        self.utc = utc
        self._observer = astronomy.Observer(site.latitude_deg, site.longitude_deg, site.altitude_m)

    def direction(self, star: Star) -> tuple[float, float]:
        """Azimuth from 0 to below 360, and elevation, below zero under the horizon."""
        now = self._now()
        sphere = astronomy.Spherical(star.declination_deg, star.right_ascension_deg, 1.0)
        turned = astronomy.RotateVector(self._to_horizon(now, star.equinox), astronomy.VectorFromSphere(sphere, now))
        seen = astronomy.HorizonFromVector(turned, astronomy.Refraction.Airless)
        return seen.lon % 360.0, seen.lat

    def star(self, azimuth_deg: float, elevation_deg: float, equinox: Equinox) -> Star:
        """The place among the stars to which an antenna at this azimuth and elevation points."""
        now = self._now()
        sphere = astronomy.Spherical(elevation_deg, azimuth_deg, 1.0)
        vector = astronomy.VectorFromHorizon(sphere, now, astronomy.Refraction.Airless)
        back = astronomy.InverseRotation(self._to_horizon(now, equinox))
        place = astronomy.EquatorFromVector(astronomy.RotateVector(back, vector))
        return Star(place.ra * DEG_PER_H % 360.0, place.dec, equinox)

    def sidereal_h(self) -> float:
        """The local apparent sidereal time in hours."""
        return float((astronomy.SiderealTime(self._now()) + self.site.longitude_deg / DEG_PER_H) % 24.0)

    def _now(self) -> astronomy.Time:
        return astronomy.Time((self.utc() - J2000_S) / DAY_S)

    def _to_horizon(self, now: astronomy.Time, equinox: Equinox) -> astronomy.RotationMatrix:
        if equinox is Equinox.J2000:
            return astronomy.Rotation_EQJ_HOR(now, self._observer)
        return astronomy.Rotation_EQD_HOR(now, self._observer)
