"""Arithmetic on angles in degrees. Knows the circle and the sphere, nothing of rotors."""

from __future__ import annotations

import math


def turn_deg(from_deg: float, to_deg: float) -> float:
    """The short way round from one azimuth to another: -180 up to 180, clockwise positive."""
    return (to_deg - from_deg + 180.0) % 360.0 - 180.0


def great_circle_deg(
    azimuth_a_deg: float, elevation_a_deg: float, azimuth_b_deg: float, elevation_b_deg: float
) -> float:
    """Angle on the sky between two pointings; elevations past 90 (over the top) mean what they say."""
    az = math.radians(azimuth_b_deg - azimuth_a_deg)
    a, b = math.radians(elevation_a_deg), math.radians(elevation_b_deg)
    # Vincenty's form: exact for small angles, where the plain arc cosine loses its digits.
    across = math.hypot(
        math.cos(b) * math.sin(az), math.cos(a) * math.sin(b) - math.sin(a) * math.cos(b) * math.cos(az)
    )
    along = math.sin(a) * math.sin(b) + math.cos(a) * math.cos(b) * math.cos(az)
    return math.degrees(math.atan2(across, along))
