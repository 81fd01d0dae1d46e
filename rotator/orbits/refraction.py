"""How much higher a target seems than it is, because air bends radio waves: the mean atmosphere, any frequency.

Near the horizon by Recommendation ITU-R P.834-9, equation 14; higher up by the refractivity of its reference atmosphere
(P.453). Within 0.015° of a ray that is followed through that atmosphere. The weather of a day moves the horizon itself
by some 0.2°. Light is bent less, for it hardly feels the water in the air. Knows no target and no orbit.
"""

from __future__ import annotations

import math
from dataclasses import replace

from rotator.orbits.earth import Site
from rotator.orbits.sight import Sight

REFRACTIVITY = 315e-6
"""Refractive index of the air at sea level, minus 1."""
THINS_PER_KM = 0.1361
CURVED = 9.1e-4
"""The correction for the curved layers of the air: the factor of the third power of the cotangent."""
LOW_DEG, HIGH_DEG = 5.0, 10.0
"""Below the first elevation only the equation is used; it is not valid above the second."""
HORIZON_DEG = -0.76
"""Degrees: a target this low seems to be on the horizon. Below it nothing is seen, and the lift ends."""


def bent_deg(elevation_deg: float, altitude_m: float = 0.0) -> float:
    """The degrees that the air adds to this elevation, for a station `altitude_m` above the sea."""
    low = max(elevation_deg, HORIZON_DEG)
    km = min(max(altitude_m, 0.0) / 1000.0, 3.0)
    near = 1.728 + 0.5411 * low + 0.03723 * low**2
    # P.619 writes 0.0138 in place of 0.01138: within 0.003° of it, and as near to the ray.
    near += km * (0.1815 + 0.06272 * low + 0.01138 * low**2) + km**2 * (0.01727 + 0.008288 * low)
    if low < LOW_DEG:
        return 1.0 / near
    flat = 1.0 / math.tan(math.radians(low))
    high = REFRACTIVITY * math.exp(-THINS_PER_KM * km) * (flat - CURVED * flat**3)
    return math.degrees(high) if low > HIGH_DEG else max(1.0 / near, math.degrees(high))


def through_air(sight: Sight, site: Site) -> Sight:
    """The target as the station sees it through air; unchanged if the station does not allow for its air."""
    if not site.refraction:
        return sight
    return replace(sight, elevation_deg=min(90.0, sight.elevation_deg + bent_deg(sight.elevation_deg, site.altitude_m)))
