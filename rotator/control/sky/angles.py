"""Arithmetic on angles in degrees. Knows the circle and the sphere, nothing of rotors."""

from __future__ import annotations

import math

ZENITH_DEG = 90.0
HALF_TURN_DEG, FULL_TURN_DEG = 180.0, 360.0

Coordinates = tuple[float | None, float | None]
"""Azimuth and elevation in degrees; None: not known, or not ordered."""
Vector = tuple[float, float, float]
"""To the east, to the north and up."""


def turn_deg(from_deg: float, to_deg: float) -> float:
    """The short way round from one azimuth to another: -180 up to 180, clockwise positive."""
    return (to_deg - from_deg + 180.0) % 360.0 - 180.0


def direction(azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
    """Where the antenna points, on any turn and over the top or not, as the direction on the sky: azimuth 0 to below
    360, elevation up to 90."""
    if elevation_deg > ZENITH_DEG:
        azimuth_deg, elevation_deg = azimuth_deg + HALF_TURN_DEG, HALF_TURN_DEG - elevation_deg
    return azimuth_deg % FULL_TURN_DEG, elevation_deg


def great_circle_deg(
    azimuth_a_deg: float, elevation_a_deg: float, azimuth_b_deg: float, elevation_b_deg: float
) -> float:
    """Angle on the sky between two pointings. An elevation past 90 points over the top."""
    az = math.radians(azimuth_b_deg - azimuth_a_deg)
    a, b = math.radians(elevation_a_deg), math.radians(elevation_b_deg)
    # Vincenty's form: exact for small angles, where the plain arc cosine loses its digits.
    across = math.hypot(
        math.cos(b) * math.sin(az), math.cos(a) * math.sin(b) - math.sin(a) * math.cos(b) * math.cos(az)
    )
    along = math.sin(a) * math.sin(b) + math.cos(a) * math.cos(b) * math.cos(az)
    return math.degrees(math.atan2(across, along))


def lifted_deg(azimuth_off_deg: float, elevation_deg: float, *, over_top: bool = False) -> float:
    """The elevation that points nearest to a target at `elevation_deg`, while azimuth is this far off it.

    `over_top`: it may go past the zenith; else it stays there while azimuth is off by more than 90°.
    """
    off = math.cos(math.radians(azimuth_off_deg))
    if off <= 0.0 and not over_top:
        return ZENITH_DEG
    target = math.radians(elevation_deg)
    return math.degrees(math.atan2(math.sin(target), math.cos(target) * off))


def unit(azimuth_deg: float, elevation_deg: float) -> Vector:
    """A direction as a vector of length 1. An elevation past 90 points over the top."""
    az, el = math.radians(azimuth_deg), math.radians(elevation_deg)
    return math.cos(el) * math.sin(az), math.cos(el) * math.cos(az), math.sin(el)


def direction_of(vector: Vector) -> tuple[float, float]:
    """Azimuth from -180 to 180, and elevation."""
    east, north, up = vector
    return math.degrees(math.atan2(east, north)), math.degrees(math.atan2(up, math.hypot(east, north)))


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
