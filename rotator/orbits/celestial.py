"""The sky over the station: directions of Sun, Moon, planets and stars, and the place among the stars in a direction.

Knows the station's place; the clock is an argument. Precession, nutation and sidereal time are astronomy-engine's. Does
not know the rotor, or bytes. Angles are in degrees. Targets are seen through air if the station allows for it. `Sky`
computes without air, because programs that send places among the stars allow for the air themselves.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import astronomy

from rotator.orbits.earth import Site
from rotator.orbits.moments import DAY_S, J2000_S
from rotator.orbits.refraction import through_air
from rotator.orbits.sight import Sight

DEG_PER_H = 15.0


class Equinox(Enum):
    """The equator and equinox from which right ascension and declination are counted."""

    J2000 = "J2000"
    OF_DATE = "JNow"


@dataclass(frozen=True, slots=True)
class Star:
    """A place among the stars. It moves over the horizon as the earth turns."""

    right_ascension_deg: float
    declination_deg: float
    equinox: Equinox


BODIES = {
    body.name.casefold(): body
    for body in (
        *(astronomy.Body.Sun, astronomy.Body.Moon, astronomy.Body.Mercury, astronomy.Body.Venus, astronomy.Body.Mars),
        *(
            astronomy.Body.Jupiter,
            astronomy.Body.Saturn,
            astronomy.Body.Uranus,
            astronomy.Body.Neptune,
            astronomy.Body.Pluto,
        ),
    )
}
RADIO_SOURCES = {
    "Cas A": Star(350.850, 58.815, Equinox.J2000),
    "Cyg A": Star(299.868, 40.734, Equinox.J2000),
    "Tau A": Star(83.633, 22.0145, Equinox.J2000),
    "Vir A": Star(187.706, 12.391, Equinox.J2000),
    "Sgr A*": Star(266.417, -29.008, Equinox.J2000),
}
"""The strongest sources of radio noise, by their usual names; places from the 3C catalogue's counterparts."""


class Body:
    """Sun, Moon or a planet as a target. Raises ValueError for another name."""

    def __init__(self, name: str, site: Site) -> None:
        if name.casefold() not in BODIES:
            raise ValueError(f'"{name}" is no body of the sky; there are: {", ".join(BODIES)}')
        self._body, self._site = BODIES[name.casefold()], site
        self._observer = astronomy.Observer(site.latitude_deg, site.longitude_deg, site.altitude_m)

    @property
    def name(self) -> str:
        return str(self._body.name)

    def sight(self, utc_s: float) -> Sight:
        now = _time(utc_s)
        place = astronomy.Equator(self._body, now, self._observer, True, True)
        seen = astronomy.Horizon(now, self._observer, place.ra, place.dec, astronomy.Refraction.Airless)
        return through_air(Sight(seen.azimuth % 360.0, seen.altitude, place.dist * astronomy.KM_PER_AU), self._site)

    def late_s(self, _utc_s: float) -> float:
        """Zero: its motion is known for centuries."""
        return 0.0


class RadioSource:
    """One of `RADIO_SOURCES`. Its range is infinite."""

    def __init__(self, name: str, site: Site) -> None:
        self.name, self._site = name, site
        self._observer = astronomy.Observer(site.latitude_deg, site.longitude_deg, site.altitude_m)
        self._star = RADIO_SOURCES[name]

    def sight(self, utc_s: float) -> Sight:
        return through_air(Sight(*_direction(self._star, self._observer, _time(utc_s)), math.inf), self._site)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


class Sky:
    """The sky over `site` at the moment that `utc` gives, in seconds since 1970."""

    def __init__(self, site: Site, utc: Callable[[], float]) -> None:
        self.site = site
        self.utc = utc
        self._observer = astronomy.Observer(site.latitude_deg, site.longitude_deg, site.altitude_m)

    def direction(self, star: Star) -> tuple[float, float]:
        """Azimuth from 0 to below 360, and elevation, below zero under the horizon."""
        return _direction(star, self._observer, _time(self.utc()))

    def star(self, azimuth_deg: float, elevation_deg: float, equinox: Equinox) -> Star:
        """The place among the stars to which an antenna at this azimuth and elevation points."""
        now = _time(self.utc())
        sphere = astronomy.Spherical(elevation_deg, azimuth_deg, 1.0)
        vector = astronomy.VectorFromHorizon(sphere, now, astronomy.Refraction.Airless)
        back = astronomy.InverseRotation(_to_horizon(now, self._observer, equinox))
        place = astronomy.EquatorFromVector(astronomy.RotateVector(back, vector))
        return Star(place.ra * DEG_PER_H % 360.0, place.dec, equinox)

    def sidereal_h(self) -> float:
        """The local apparent sidereal time in hours."""
        return float((astronomy.SiderealTime(_time(self.utc())) + self.site.longitude_deg / DEG_PER_H) % 24.0)


def _direction(star: Star, observer: astronomy.Observer, now: astronomy.Time) -> tuple[float, float]:
    sphere = astronomy.Spherical(star.declination_deg, star.right_ascension_deg, 1.0)
    turned = astronomy.RotateVector(_to_horizon(now, observer, star.equinox), astronomy.VectorFromSphere(sphere, now))
    seen = astronomy.HorizonFromVector(turned, astronomy.Refraction.Airless)
    return seen.lon % 360.0, seen.lat


def _to_horizon(now: astronomy.Time, observer: astronomy.Observer, equinox: Equinox) -> astronomy.RotationMatrix:
    if equinox is Equinox.J2000:
        return astronomy.Rotation_EQJ_HOR(now, observer)
    return astronomy.Rotation_EQD_HOR(now, observer)


def _time(utc_s: float) -> astronomy.Time:
    return astronomy.Time((utc_s - J2000_S) / DAY_S)
