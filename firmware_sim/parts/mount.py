"""A mount that stands askew: where the boom of the simulated rotor truly points.

Knows six errors by the names and signs of the telescope makers' papers, and turns the boom about one axis after the
other, as a mast, its rotors and the boom are built on each other. Knows no motor, and not how the box allows for it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

Vector = tuple[float, float, float]
"""To the east, to the north and up."""


@dataclass(frozen=True, slots=True)
class MountSpec:
    ia_deg: float = 0.0
    """How much the azimuth scale reads too much."""
    ie_deg: float = 0.0
    """How much the elevation scale reads too little."""
    an_deg: float = 0.0
    """The mast leans to the north."""
    aw_deg: float = 0.0
    """The mast leans to the west."""
    ca_deg: float = 0.0
    """The boom points to the left of square to the elevation axis."""
    npae_deg: float = 0.0
    """The elevation axis hangs down on its left."""

    def direction(self, azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
        """Azimuth from 0 to below 360 and elevation, with the axes at these angles."""
        east, north, up = self._boom(azimuth_deg, elevation_deg)
        return math.degrees(math.atan2(east, north)) % 360.0, math.degrees(math.atan2(up, math.hypot(east, north)))

    def _boom(self, azimuth_deg: float, elevation_deg: float) -> Vector:
        # It begins level and to the north on axes without any error; then each part turns what it carries.
        boom = _turned((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), self.ca_deg)
        boom = _turned(boom, (1.0, 0.0, 0.0), elevation_deg + self.ie_deg)
        boom = _turned(boom, (0.0, 1.0, 0.0), -self.npae_deg)
        boom = _turned(boom, (0.0, 0.0, 1.0), self.ia_deg - azimuth_deg)
        lean_deg = math.hypot(self.an_deg, self.aw_deg)
        if not lean_deg:
            return boom
        return _turned(boom, (-self.an_deg / lean_deg, -self.aw_deg / lean_deg, 0.0), lean_deg)


def _turned(vector: Vector, about: Vector, by_deg: float) -> Vector:
    """By the right-hand rule, about a line of length 1 (Rodrigues)."""
    (x, y, z), (u, v, w) = vector, about
    sin, cos = math.sin(math.radians(by_deg)), math.cos(math.radians(by_deg))
    along = (u * x + v * y + w * z) * (1.0 - cos)
    return (
        x * cos + (v * z - w * y) * sin + u * along,
        y * cos + (w * x - u * z) * sin + v * along,
        z * cos + (u * y - v * x) * sin + w * along,
    )
