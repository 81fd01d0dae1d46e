"""Orbital elements: a satellite's orbit at one time, and whether the numbers can be an orbit at all.

Knows the quantities that sgp4 needs, their units and their bounds. Does not know files, or the forms in which elements
are written: those are in `omm` and `tle`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from rotator.orbits.moments import DAY_S

LEAST_REV_PER_DAY, MOST_REV_PER_DAY = 0.01, 18.0
"""Revolutions a day. A slower satellite would be lost to the Moon; a faster one would be inside the atmosphere."""
LONGEST_NAME = 40


class NotAnOrbit(ValueError):  # noqa: N818 - a sentence about numbers
    """The text tells which quantity is wrong."""


class Notice(str):
    """A sentence about sets that are used, with something that a person should know."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Elements:
    """Mean elements in the sense of SGP4, equator and equinox of date (TEME). Raises NotAnOrbit.

    `catalogue_number` may have nine digits; the number in sgp4's own record cannot, and is not used.
    """

    name: str
    catalogue_number: int
    epoch_utc_s: float
    """Seconds since 1970."""
    mean_motion_rev_per_day: float
    eccentricity: float
    inclination_deg: float
    ascending_node_deg: float
    perigee_argument_deg: float
    mean_anomaly_deg: float
    drag_per_earth_radius: float = 0.0
    """B*."""
    mean_motion_dot: float = 0.0
    """Half of the first derivative of the mean motion, in revolutions per day squared, as TLE and OMM give it."""
    mean_motion_ddot: float = 0.0
    """A sixth of the second derivative."""

    def __post_init__(self) -> None:
        # A name may come from the network, and goes to terminals and displays.
        name = printable(self.name).strip()[:LONGEST_NAME]
        object.__setattr__(self, "name", name or str(self.catalogue_number))
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, float) and not math.isfinite(value):
                raise NotAnOrbit(f"{field.name} is {value}")
        if not LEAST_REV_PER_DAY <= self.mean_motion_rev_per_day <= MOST_REV_PER_DAY:
            raise NotAnOrbit(f"a mean motion of {self.mean_motion_rev_per_day:g} revolutions a day is no orbit")
        if not 0 <= self.eccentricity < 1:
            raise NotAnOrbit(f"an eccentricity of {self.eccentricity:g} is no closed orbit")
        if not 0 <= self.inclination_deg <= 180:
            raise NotAnOrbit(f"an inclination of {self.inclination_deg:g}° is not between 0 and 180")
        if not 0 < self.catalogue_number <= 999_999_999:
            raise NotAnOrbit(f"{self.catalogue_number} is no catalogue number of one to nine digits")

    def age_days(self, utc_s: float) -> float:
        """Days from the epoch, in either direction."""
        return abs(utc_s - self.epoch_utc_s) / DAY_S


def printable(text: str) -> str:
    """The text without the characters that a terminal would obey."""
    return "".join(filter(str.isprintable, text))
