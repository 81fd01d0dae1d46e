"""Where a target in the sky is, as a station sees it at one moment; and what every target has in common.

Knows directions and how fast they change. Does not know orbits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

FULL_TURN_DEG = 360.0
RATE_OVER_S = 1.0
"""Rates are the change over this time, half before and half after."""
SHORT_S, LOOKS, MOST_OFF_S = 300.0, 24, 43_200.0
"""Seconds on its path: within the first a target only goes further away; over more, so many looks find the furthest."""
ANYWHERE_DEG = 180.0


class NotThere(Exception):  # noqa: N818 - a sentence about a target
    """The target has no place at that moment: a satellite whose elements say that it has come down. The text tells."""


@dataclass(frozen=True, slots=True)
class Sight:
    """Azimuth from 0 to below 360 from true north; elevation below zero under the horizon."""

    azimuth_deg: float
    elevation_deg: float
    range_km: float

    def apart_deg(self, other: Sight) -> float:
        """The angle between the two directions."""
        el_a, el_b = math.radians(self.elevation_deg), math.radians(other.elevation_deg)
        turn = math.radians(other.azimuth_deg - self.azimuth_deg)
        half = math.sin((el_b - el_a) / 2) ** 2 + math.cos(el_a) * math.cos(el_b) * math.sin(turn / 2) ** 2
        return math.degrees(2 * math.asin(math.sqrt(min(1.0, half))))


def turn_deg(from_deg: float, to_deg: float) -> float:
    """The difference of two azimuths, the shorter way round."""
    return (to_deg - from_deg + FULL_TURN_DEG / 2) % FULL_TURN_DEG - FULL_TURN_DEG / 2


class Target(Protocol):
    """A target has a place in the sky of a station at every moment."""

    @property
    def name(self) -> str: ...

    def sight(self, utc_s: float) -> Sight:
        """Raises NotThere."""
        ...

    def late_s(self, utc_s: float) -> float:
        """Seconds by which it may be early or late on its path, from the age of its elements."""
        ...


@dataclass(frozen=True, slots=True)
class Motion:
    """A sight, and how fast it changes."""

    sight: Sight
    azimuth_dps: float
    elevation_dps: float


def motion(target: Target, utc_s: float) -> Motion:
    """Raises NotThere."""
    before, after = target.sight(utc_s - RATE_OVER_S / 2), target.sight(utc_s + RATE_OVER_S / 2)
    turned_deg = turn_deg(before.azimuth_deg, after.azimuth_deg)
    return Motion(
        target.sight(utc_s), turned_deg / RATE_OVER_S, (after.elevation_deg - before.elevation_deg) / RATE_OVER_S
    )


def expected_error_deg(target: Target, utc_s: float, clock_s: float = 0.0) -> float:
    """The possible error of the target's computed direction: an error along its path is an error of time.

    `clock_s`: by how much the clock may be wrong. Raises NotThere.
    """
    off_s = min(math.hypot(target.late_s(utc_s), clock_s), MOST_OFF_S)
    # With old elements it may be anywhere on its orbit: half a revolution late is further away than a whole one.
    count = 1 if off_s < SHORT_S else LOOKS
    here = target.sight(utc_s)
    try:
        return max(
            here.apart_deg(target.sight(utc_s + side * off_s * look / count))
            for look in range(1, count + 1)
            for side in (-1, 1)
        )
    except NotThere:  # it may have come down
        return ANYWHERE_DEG


def beyond_beam(error_deg: float, beam_deg: float) -> str:
    """The end of a sentence that warns of this error; empty: the antenna's beam still covers it."""
    if error_deg <= beam_deg / 2:
        return ""
    return f", more than half of the beam of {beam_deg:g}°: it needs newer elements, or the right time"
