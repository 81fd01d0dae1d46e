"""The shift of every order that a person sets with the panel's jog switches.

Knows one angle an axis, and shifts an order or the goal of a planned flight by it. Does not know the sender of an
order, nor where the antenna is.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Mount
from rotator.control.sky.route import Way
from rotator.exchange.orders import Aim


class Nudges:
    """`highest_deg`: the upper end of the elevation axis."""

    def __init__(self, highest_deg: float = ZENITH_DEG) -> None:
        self._highest_deg = highest_deg
        self._deg = dict.fromkeys(Axis, 0.0)

    def set(self, axis: Axis, offset_deg: float) -> float:
        """Returns by how much further orders are shifted now."""
        before_deg, self._deg[axis] = self._deg[axis], offset_deg
        return offset_deg - before_deg

    def clear(self) -> None:
        self._deg = dict.fromkeys(Axis, 0.0)

    def applied(self, asked: Aim) -> Aim:
        """The order, shifted. An azimuth up to 360° stays on the circle; a larger one names the turn of the overlap.

        No shift of the elevation leads past the zenith where the axis ends there: azimuth would turn to the other side.
        """
        azimuth_deg, elevation_deg = asked.azimuth_deg, asked.elevation_deg
        if azimuth_deg is not None and (by_deg := self._deg[Axis.AZIMUTH]):
            names_turn = azimuth_deg > FULL_TURN_DEG
            azimuth_deg = azimuth_deg + by_deg if names_turn else (azimuth_deg + by_deg) % FULL_TURN_DEG
        if elevation_deg is not None:
            ends_deg = max(elevation_deg, ZENITH_DEG, self._highest_deg)
            elevation_deg = min(elevation_deg + self._deg[Axis.ELEVATION], ends_deg)
        return replace(asked, azimuth_deg=azimuth_deg, elevation_deg=elevation_deg)

    def flown(self, axis: Axis, goal: AimGoal, mount: Mount, way: Way) -> AimGoal:
        """The goal of a planned flight, shifted within the mount's limits. `way`: the way that it flies now."""
        across_deg, up_deg = self._deg[Axis.AZIMUTH], self._deg[Axis.ELEVATION]
        if not across_deg and not up_deg:
            return goal
        if axis is Axis.AZIMUTH:
            return goal.mapped(lambda angle_deg: mount.azimuth.nearest(angle_deg + across_deg))
        azimuth_deg = mount.azimuth.nearest(way.azimuth_deg + across_deg)
        # Over the top the elevation axis goes down where the antenna goes up.
        raised_deg = -up_deg if way.flipped else up_deg
        return goal.mapped(lambda angle_deg: mount.clear_deg(azimuth_deg, angle_deg + raised_deg))
