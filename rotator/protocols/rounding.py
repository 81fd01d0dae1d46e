"""From an angle to whole numbers, as the controllers that the box stands in for write it: rounded half up.

Knows numbers. Knows no protocol.
"""

from __future__ import annotations

import math


def whole(number: float) -> int:
    """Rounded half up: 0.5 becomes 1, and -0.5 becomes 0."""
    return math.floor(number + 0.5)


def bearing(azimuth_deg: float) -> int:
    """In whole degrees, 0 to 360; on a further turn of the overlap the same direction of the first turn."""
    rounded_deg = whole(azimuth_deg)
    return rounded_deg if 0 <= rounded_deg <= 360 else rounded_deg % 360
