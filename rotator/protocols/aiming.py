"""What the protocols that name their angles in degrees have in common: from two numbers to an order.

Knows how far a client's numbers may go, as Hamlib does. Does not know the rotor's range: that is the box's.
"""

from __future__ import annotations

import re

from rotator.orders import Aim

AZIMUTHS_DEG = (-180.0, 540.0)
ELEVATIONS_DEG = (-90.0, 180.0)

_DEGREES = re.compile(r"[+-]?[0-9]{1,3}(?:[.,][0-9]{0,9})?")


def degrees(text: str) -> float | None:
    """An angle as programs write it, with a point or a comma; None: it is none, or damaged."""
    return float(text.replace(",", ".")) if _DEGREES.fullmatch(text) else None


def aim(azimuth_deg: float | None, elevation_deg: float | None) -> Aim | None:
    """The order for these angles; an axis that is None keeps what it was doing. None: no direction has such numbers.

    A negative azimuth is a direction; only from zero on can it name a turn of the overlap.
    """
    if azimuth_deg is not None:
        if not AZIMUTHS_DEG[0] <= azimuth_deg <= AZIMUTHS_DEG[1]:
            return None
        azimuth_deg = azimuth_deg % 360 if azimuth_deg < 0 else azimuth_deg
    if elevation_deg is not None and not ELEVATIONS_DEG[0] <= elevation_deg <= ELEVATIONS_DEG[1]:
        return None
    return Aim(azimuth_deg, elevation_deg)
