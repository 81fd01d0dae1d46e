"""From two angles in degrees to an order, for every protocol that sends degrees.

Knows the range of numbers that a client may send, the same as Hamlib's. Does not know the rotor's range.
"""

from __future__ import annotations

import re

from rotator.orders import Aim

AZIMUTHS_DEG = (-180.0, 540.0)
ELEVATIONS_DEG = (-90.0, 180.0)

_DEGREES = re.compile(r"[+-]?[0-9]{1,3}(?:[.,][0-9]{0,9})?")


def degrees(text: str) -> float | None:
    """An angle as programs write it, with a decimal point or comma. None: the text is not one number."""
    return float(text.replace(",", ".")) if _DEGREES.fullmatch(text) else None


def aim(azimuth_deg: float | None, elevation_deg: float | None) -> Aim | None:
    """The order for these angles; an axis that is None keeps its target. Returns None for numbers out of range.

    A negative azimuth is a direction. From zero on an azimuth can also name a turn of the overlap.
    """
    if azimuth_deg is not None:
        if not AZIMUTHS_DEG[0] <= azimuth_deg <= AZIMUTHS_DEG[1]:
            return None
        azimuth_deg = azimuth_deg % 360 if azimuth_deg < 0 else azimuth_deg
    if elevation_deg is not None and not ELEVATIONS_DEG[0] <= elevation_deg <= ELEVATIONS_DEG[1]:
        return None
    return Aim(azimuth_deg, elevation_deg)
