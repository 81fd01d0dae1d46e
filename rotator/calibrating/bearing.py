"""Where north is on the rotor's scale, by a compass on the boom that was read while the antenna stood.

Knows the circle, what a compass can be trusted with, and when it is better to say nothing. Knows no chip and no file.
One place tells north with the compass's own error and that of the steel around; several places all around the circle
average the steel out, and show how much of it there is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.angles import turn_deg

LEAST_LOOKS = 30
LEAST_MAGNETOMETER = 2
"""Of 3: below it the compass has not yet been turned about enough to know its own error."""
STOOD_WITHIN_DEG = 1.0
SPREAD_DEG = 3.0
"""A compass that swings more than this while the antenna stands feels a motor, or a cable."""
COMPASS_DEG = 2.5
"""What the compass itself is off by; averaging does not take that away."""
LEVEL_WITHIN_DEG = 30.0
"""Lifted further, the boom points up more than anywhere, and a heading says less and less."""
PLACES_APART_DEG = 20.0
"""Steel that bends the needle differently by more than this from place to place is too near."""


class NorthRefused(ValueError):  # noqa: N818 - a sentence for a person, not a programming error
    """Why these readings do not tell north, and what to do."""


@dataclass(frozen=True, slots=True)
class Look:
    """One reading: the compass's heading from magnetic north, and the axis angle on the rotor's own scale."""

    heading_deg: float
    azimuth_deg: float
    magnetometer: int
    """The compass's calibration, 0 to 3."""
    tilt_deg: float = 0.0
    """How far the compass is from level."""


@dataclass(frozen=True, slots=True)
class Learnt:
    """How far the compass knows its own errors, each part 0 (not at all) to 3."""

    system: int = 0
    gyroscope: int = 0
    accelerometer: int = 0
    magnetometer: int = 0

    @property
    def complete(self) -> bool:
        return min(self.system, self.gyroscope, self.accelerometer, self.magnetometer) == 3

    def __str__(self) -> str:
        return (
            f"system {self.system}, gyroscope {self.gyroscope}, accelerometer {self.accelerometer}, "
            f"magnetometer {self.magnetometer} of 3"
        )


@dataclass(frozen=True, slots=True)
class Sighting:
    """What the compass said at one moment; with a `problem`, why it said nothing."""

    at_s: float
    heading_deg: float = math.nan
    """From magnetic north, where the compass's own forward points."""
    tilt_deg: float = 0.0
    learnt: Learnt = Learnt()
    problem: str = ""


@dataclass(frozen=True, slots=True)
class North:
    """`offset_deg` is to be added to the rotor's own scale to have true azimuths; -180 up to 180."""

    offset_deg: float
    uncertainty_deg: float


def find_north(looks: Sequence[Look], declination_deg: float, compass_offset_deg: float = 0.0) -> North:
    """North from looks at one place.

    `declination_deg` is positive to the east; give 0 where the scale is to stay magnetic. `compass_offset_deg` is where
    the boom points, clockwise, as seen from the compass's own forward. Raises NorthRefused.
    """
    if len(looks) < LEAST_LOOKS:
        raise NorthRefused(f"{len(looks)} compass readings are too few; let it take at least {LEAST_LOOKS}")
    known = min(look.magnetometer for look in looks)
    if known < LEAST_MAGNETOMETER:
        raise NorthRefused(
            f"the compass knows its own error too little ({known} of 3); turn the antenna slowly all the way round, "
            "up and down too, and try again"
        )
    azimuths = [look.azimuth_deg for look in looks]
    if max(azimuths) - min(azimuths) > STOOD_WITHIN_DEG:
        raise NorthRefused("the antenna turned while the compass was read; let it stand, and try again")
    tilt_deg = max(look.tilt_deg for look in looks)
    if tilt_deg > LEVEL_WITHIN_DEG:
        raise NorthRefused(
            f"the compass is {tilt_deg:.0f} degrees from level, {LEVEL_WITHIN_DEG:g} are allowed; lower the boom, or "
            "look at how it is mounted"
        )
    heading_deg, spread_deg = _mean_and_spread_deg([look.heading_deg for look in looks])
    if spread_deg > SPREAD_DEG:
        raise NorthRefused(
            f"the compass swings by {spread_deg:.1f} degrees while the antenna stands, {SPREAD_DEG:g} are allowed; "
            "move it away from the motors and their cables"
        )
    azimuth_deg = math.fsum(azimuths) / len(azimuths)
    offset_deg = turn_deg(azimuth_deg, heading_deg + compass_offset_deg + declination_deg)
    return North(offset_deg, math.hypot(COMPASS_DEG, spread_deg / math.sqrt(len(looks))))


def agree(places: Sequence[North]) -> North:
    """North from several places, spread evenly over the circle. Raises NorthRefused where they contradict."""
    if not places:
        raise NorthRefused("no place tells north yet; let the compass be read at one or more")
    offset_deg, spread_deg = _mean_and_spread_deg([place.offset_deg for place in places])
    apart_deg = 2.0 * max(abs(turn_deg(offset_deg, place.offset_deg)) for place in places)
    if apart_deg > PLACES_APART_DEG:
        raise NorthRefused(
            f"the compass tells a north that differs by {apart_deg:.0f} degrees from place to place; "
            "steel is too near, move it further out on the boom"
        )
    own_deg = max(place.uncertainty_deg for place in places)
    return North(turn_deg(0.0, offset_deg), math.hypot(own_deg, spread_deg / math.sqrt(len(places))))


def _mean_and_spread_deg(angles_deg: Sequence[float]) -> tuple[float, float]:
    """The circular mean, and the circular standard deviation; infinite where the angles cancel each other."""
    east = math.fsum(math.sin(math.radians(angle)) for angle in angles_deg) / len(angles_deg)
    north = math.fsum(math.cos(math.radians(angle)) for angle in angles_deg) / len(angles_deg)
    length = min(1.0, math.hypot(east, north))
    if length < 1e-9:
        return 0.0, math.inf
    return math.degrees(math.atan2(east, north)), math.degrees(math.sqrt(-2.0 * math.log(length)))
