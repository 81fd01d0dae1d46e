"""Where north is on the rotor's scale, from readings of a compass on the boom while the antenna stands.

Knows the circle, and which compass readings can be trusted. Does not know the chip or files. One place gives north with
the error of the compass and of the steel around it. The mean over several places all around the circle removes most of
the error of the steel, and their spread shows how large it is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from hw.ports import CompassCalibration
from rotator.control.sky.angles import FULL_TURN_DEG, turn_deg

UNCALIBRATED = CompassCalibration()
LEAST_SAMPLES = 30
LEAST_MAGNETOMETER = 2
"""Of 3. Below it the compass has not been turned enough to know its own error."""
STOOD_WITHIN_DEG = 1.0
SPREAD_DEG = 3.0
"""A compass that swings more than this while the antenna stands is disturbed by a motor or a cable."""
COMPASS_DEG = 2.5
"""The error of the compass itself. A mean does not reduce it."""
LEVEL_WITHIN_DEG = 30.0
"""With the boom raised further, a heading becomes inaccurate."""
PLACES_APART_DEG = 20.0
"""If north differs by more than this from place to place, steel is too near."""
BEYOND = 3.0
"""The true angle may be this many uncertainties away from the angle found."""


class NorthUncertain(ValueError):  # noqa: N818 - a sentence for the operator; the program has not failed
    """Why these readings do not give north, and what to do."""


@dataclass(frozen=True, slots=True)
class HeadingSample:
    """One reading: the compass's heading from magnetic north, and the axis angle on the rotor's own scale."""

    heading_deg: float
    azimuth_deg: float
    magnetometer: int
    """The calibration of the compass's magnetometer, 0 to 3."""
    tilt_deg: float = 0.0
    """The angle between the compass and level."""


@dataclass(frozen=True, slots=True)
class CompassReading:
    """What the compass reported at one moment. `problem`: why it reported no heading; empty: it did."""

    at_s: float
    heading_deg: float = math.nan
    """Where the compass's own forward direction points, from magnetic north."""
    tilt_deg: float = 0.0
    calibration: CompassCalibration = UNCALIBRATED
    problem: str = ""


@dataclass(frozen=True, slots=True)
class North:
    """Add `offset_deg` (-180 up to 180) to the rotor's own scale to get true azimuths."""

    offset_deg: float
    uncertainty_deg: float


def find_north(samples: Sequence[HeadingSample], declination_deg: float, compass_offset_deg: float = 0.0) -> North:
    """North from samples at one place. Raises NorthUncertain.

    `declination_deg` is positive to the east; 0 where the scale is to stay magnetic. `compass_offset_deg` is where the
    boom points, clockwise, as seen from the compass's own forward direction.
    """
    if len(samples) < LEAST_SAMPLES:
        raise NorthUncertain(f"{len(samples)} compass readings are too few; let it take at least {LEAST_SAMPLES}")
    magnetometer = min(sample.magnetometer for sample in samples)
    if magnetometer < LEAST_MAGNETOMETER:
        raise NorthUncertain(
            f"the compass knows its own error too little ({magnetometer} of 3); turn the antenna slowly all the way "
            "round, up and down too, and try again"
        )
    azimuths = [sample.azimuth_deg for sample in samples]
    if max(azimuths) - min(azimuths) > STOOD_WITHIN_DEG:
        raise NorthUncertain("the antenna turned while the compass was read; let it stand, and try again")
    tilt_deg = max(sample.tilt_deg for sample in samples)
    if tilt_deg > LEVEL_WITHIN_DEG:
        raise NorthUncertain(
            f"the compass is {tilt_deg:.0f} degrees from level, {LEVEL_WITHIN_DEG:g} are allowed; lower the boom, or "
            "look at how it is mounted"
        )
    heading_deg, spread_deg = _mean_and_spread_deg([sample.heading_deg for sample in samples])
    if spread_deg > SPREAD_DEG:
        raise NorthUncertain(
            f"the compass swings by {spread_deg:.1f} degrees while the antenna stands, {SPREAD_DEG:g} are allowed; "
            "move it away from the motors and their cables"
        )
    azimuth_deg = math.fsum(azimuths) / len(azimuths)
    offset_deg = turn_deg(azimuth_deg, heading_deg + compass_offset_deg + declination_deg)
    return North(offset_deg, math.hypot(COMPASS_DEG, spread_deg / math.sqrt(len(samples))))


def agree(places: Sequence[North]) -> North:
    """North from several places, spread evenly over the circle. Raises NorthUncertain where they contradict."""
    if not places:
        raise NorthUncertain("no place gives north yet; let the compass be read at one or more")
    offset_deg, spread_deg = _mean_and_spread_deg([place.offset_deg for place in places])
    apart_deg = 2.0 * max(abs(turn_deg(offset_deg, place.offset_deg)) for place in places)
    if apart_deg > PLACES_APART_DEG:
        raise NorthUncertain(
            f"by this compass north differs by {apart_deg:.0f} degrees from place to place; "
            "steel is too near, move it further out on the boom"
        )
    own_deg = max(place.uncertainty_deg for place in places)
    return North(turn_deg(0.0, offset_deg), math.hypot(own_deg, spread_deg / math.sqrt(len(places))))


def possible_angles_deg(
    bearing: North, offset_deg: float, least_deg: float, most_deg: float
) -> tuple[float, list[float]]:
    """The angles on the rotor's own scale at which a boom with this bearing can stand.

    `bearing` comes from `find_north` with samples at azimuth 0; `offset_deg` is the known offset of the rotor's scale.
    Returns the lowest angle by the compass alone, and all that lie within `least_deg` to `most_deg` and their play:
    none where the compass contradicts the range, two or more in an overlap or near an end.
    """
    # Near an end the compass cannot tell that end from the place one turn further.
    play_deg = BEYOND * bearing.uncertainty_deg
    first_deg = least_deg - play_deg
    first_deg += (bearing.offset_deg - offset_deg - first_deg) % FULL_TURN_DEG
    angles_deg = (first_deg + FULL_TURN_DEG * turns for turns in range(3))
    return first_deg, [angle_deg for angle_deg in angles_deg if angle_deg <= most_deg + play_deg]


def _mean_and_spread_deg(angles_deg: Sequence[float]) -> tuple[float, float]:
    """The circular mean, and the circular standard deviation; infinite where the angles cancel each other."""
    east = math.fsum(math.sin(math.radians(angle)) for angle in angles_deg) / len(angles_deg)
    north = math.fsum(math.cos(math.radians(angle)) for angle in angles_deg) / len(angles_deg)
    length = min(1.0, math.hypot(east, north))
    if length < 1e-9:
        return 0.0, math.inf
    return math.degrees(math.atan2(east, north)), math.degrees(math.sqrt(-2.0 * math.log(length)))
