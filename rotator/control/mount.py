"""Turns a direction in the sky into axis angles: the only place that does.

Knows the range of each axis, its overlap and the park position. Knows nothing of motors, sensors or time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from rotator.control.angles import turn_deg

ZENITH_DEG = 90.0


class Unreachable(ValueError):  # noqa: N818 - an answer about a direction, not a failure
    """No axis angle within the range points there; the text says why."""


@dataclass(frozen=True, slots=True)
class Range:
    """Where an axis may be, in degrees on its own scale."""

    min_deg: float
    max_deg: float

    def nearest(self, angle_deg: float) -> float:
        return min(max(angle_deg, self.min_deg), self.max_deg)

    def holds(self, angle_deg: float) -> bool:
        return self.min_deg <= angle_deg <= self.max_deg


@dataclass(frozen=True, slots=True)
class Mount:
    azimuth: Range
    elevation: Range
    park_azimuth_deg: float = 0.0
    park_elevation_deg: float = 0.0

    def axis_angles(
        self, azimuth_deg: float, elevation_deg: float | None, near_azimuth_deg: float
    ) -> tuple[float, float | None]:
        """Axis angles for an order, on the turn of azimuth nearest to `near_azimuth_deg`. Raises Unreachable.

        Below the horizon azimuth follows and elevation rests at its minimum. Past the zenith an order is axis angles
        where the range allows, else the direction that it means.
        """
        if elevation_deg is None:
            return self._turn(azimuth_deg, near_azimuth_deg), None
        if elevation_deg > ZENITH_DEG and not self.elevation.holds(elevation_deg):
            azimuth_deg, elevation_deg = (azimuth_deg + 180.0) % 360.0, 180.0 - elevation_deg
        return self._turn(azimuth_deg, near_azimuth_deg), self.elevation.nearest(elevation_deg)

    def along(
        self, directions: Iterable[tuple[float, float]], from_azimuth_deg: float, *, flipped: bool
    ) -> tuple[list[float], list[float]]:
        """Axis angles along a path of directions, azimuth and elevation, going on from an azimuth on its own turn.

        `flipped`: the antenna flies it over the top, because whoever sends the orders flips.
        """
        azimuths_deg, elevations_deg = [], []
        azimuth_deg = from_azimuth_deg
        for towards_deg, elevation_deg in directions:
            azimuth_deg += turn_deg(azimuth_deg, towards_deg + 180.0 if flipped else towards_deg)
            azimuths_deg.append(self.azimuth.nearest(azimuth_deg))
            elevations_deg.append(self.elevation.nearest(180.0 - elevation_deg if flipped else elevation_deg))
        return azimuths_deg, elevations_deg

    def _turn(self, azimuth_deg: float, near_deg: float) -> float:
        if azimuth_deg > 360.0 and self.azimuth.holds(azimuth_deg):  # the sender names the overlap
            return azimuth_deg
        first = math.ceil((self.azimuth.min_deg - azimuth_deg) / 360.0)
        last = math.floor((self.azimuth.max_deg - azimuth_deg) / 360.0)
        turns = [azimuth_deg + 360.0 * turn for turn in range(first, last + 1)]
        if not turns:
            limits = f"{self.azimuth.min_deg:g} to {self.azimuth.max_deg:g}"
            raise Unreachable(f"azimuth {azimuth_deg:g} is outside the rotor's range of {limits} degrees")
        return min(turns, key=lambda turn_deg: abs(turn_deg - near_deg))
