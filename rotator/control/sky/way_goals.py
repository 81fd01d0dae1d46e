"""The goals of both axes on a way that has been chosen: at the place of a target that stands, or along a path.

Knows the mount, and how exactly each axis is to point. Does not know why the antenna is on that way: `pointing` chooses
it. Knows no order and no motor.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass

from rotator.control.sky.angles import direction
from rotator.control.sky.goal import EVEN, AimGoal, Goals
from rotator.control.sky.mount import Mount
from rotator.control.sky.plan import Path
from rotator.control.sky.route import Way


@dataclass(eq=False)
class WayGoals:
    """`on_sky`: the tolerance of azimuth is on the sky; False: in degrees of the axis."""

    mount: Mount
    azimuth_tolerance_deg: float
    elevation_tolerance_deg: float
    _: KW_ONLY
    on_sky: bool

    @property
    def tolerance_deg(self) -> float:
        return min(self.azimuth_tolerance_deg, self.elevation_tolerance_deg)

    def at(self, azimuth_deg: float, elevation_deg: float) -> Goals:
        """To these axis angles."""
        return (
            AimGoal(azimuth_deg, self._standing_tolerance_deg(elevation_deg)),
            AimGoal(elevation_deg, self.elevation_tolerance_deg),
        )

    def towards(self, way: Way, azimuth_deg: float, elevation_deg: float) -> Goals:
        """To a direction on this way, as an order names it: within the limits, and above the horizon."""
        axis_azimuth_deg, axis_elevation_deg = self.mount.on_the_way(
            *direction(azimuth_deg, elevation_deg), way.azimuth_deg, flipped=way.flipped
        )
        kept_deg = self.mount.azimuth.nearest(axis_azimuth_deg)
        return self.at(kept_deg, self.mount.clear_deg(kept_deg, axis_elevation_deg))

    def azimuth_alone(self, way: Way, heights_deg: Sequence[float] = ()) -> Goals:
        """The azimuth of this way; elevation keeps its goal. `heights_deg`: elevations at which the antenna may be."""
        tolerance_deg = min(map(self._standing_tolerance_deg, heights_deg), default=self.azimuth_tolerance_deg)
        return AimGoal(self.mount.azimuth.nearest(way.azimuth_deg), tolerance_deg), None

    def elevation_alone(self, azimuth_deg: float, elevation_deg: float) -> AimGoal:
        """The goal of elevation, above the horizon at this azimuth."""
        return AimGoal(self.mount.clear_deg(azimuth_deg, elevation_deg), self.elevation_tolerance_deg)

    def along(self, now_s: float, way: Way, directions: Sequence[tuple[float, float]]) -> Goals:
        """Along the directions of a moving target at `plan.OFFSETS_S` from now, on this way."""
        azimuths_deg, elevations_deg = [], []
        azimuth_deg = way.azimuth_deg
        for direction_az_deg, direction_el_deg in directions:
            azimuth_deg, elevation_deg = self.mount.on_the_way(
                direction_az_deg, direction_el_deg, azimuth_deg, flipped=way.flipped
            )
            kept_deg = self.mount.azimuth.nearest(azimuth_deg)
            azimuths_deg.append(kept_deg)
            elevations_deg.append(self.mount.clear_deg(kept_deg, elevation_deg))
        weights = [self.mount.azimuth_weight(el_deg) ** 2 for _, el_deg in directions]
        return (
            AimGoal(azimuths_deg[0], self.azimuth_tolerance_deg, Path(now_s, azimuths_deg, weights)),
            AimGoal(elevations_deg[0], self.elevation_tolerance_deg, Path(now_s, elevations_deg, EVEN)),
        )

    def _standing_tolerance_deg(self, elevation_deg: float) -> float:
        """The tolerance of azimuth on the sky: high up, a degree of azimuth moves the antenna by less than a degree."""
        if not self.on_sky:
            return self.azimuth_tolerance_deg
        return self.azimuth_tolerance_deg / self.mount.azimuth_weight(elevation_deg)
