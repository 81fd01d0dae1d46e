"""The shift of every order that a person sets with the panel's jog switches, and that of the present pass by the page.

Knows two angles an axis, and shifts an order or the goal of a planned flight by their sum. Does not know the sender of
an order, nor where the antenna is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.ports import Axis
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, great_circle_deg
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Mount
from rotator.control.sky.route import Way
from rotator.exchange.orders import Aim

LEAP_DEG = 20.0
"""A program's next direction that is further away belongs to another target."""


class Nudges:
    """`highest_deg`: the upper end of the elevation axis."""

    def __init__(self, highest_deg: float = ZENITH_DEG) -> None:
        self._highest_deg = highest_deg
        self._lasting_deg = dict.fromkeys(Axis, 0.0)
        self.of_pass_deg: Mapping[Axis, float] = dict.fromkeys(Axis, 0.0)
        """The shift that ends with the target in force."""

    def set(self, axis: Axis, offset_deg: float, *, of_pass: bool = False) -> float:
        """Returns by how much further orders are shifted now."""
        before_deg = self._deg(axis)
        if of_pass:
            self.of_pass_deg = {**self.of_pass_deg, axis: offset_deg}
        else:
            self._lasting_deg[axis] = offset_deg
        return self._deg(axis) - before_deg

    def clear(self) -> None:
        self._lasting_deg = dict.fromkeys(Axis, 0.0)
        self.end_pass()

    def end_pass(self) -> None:
        self.of_pass_deg = dict.fromkeys(Axis, 0.0)

    def end_at_leap(self, before: Aim, asked: Aim) -> None:
        """End the shift of a pass where a program has gone on to another target."""
        match before, asked:
            case Aim(float() as az1, float() as el1), Aim(float() as az2, float() as el2):
                if great_circle_deg(az1, el1, az2, el2) > LEAP_DEG:
                    self.end_pass()

    def _deg(self, axis: Axis) -> float:
        return self._lasting_deg[axis] + self.of_pass_deg[axis]

    def applied(self, asked: Aim) -> Aim:
        """The order, shifted. An azimuth up to 360° stays on the circle; a larger one names the turn of the overlap.

        No shift of the elevation leads past the zenith where the axis ends there: azimuth would turn to the other side.
        """
        azimuth_deg, elevation_deg = asked.azimuth_deg, asked.elevation_deg
        if azimuth_deg is not None and (by_deg := self._deg(Axis.AZIMUTH)):
            names_turn = azimuth_deg > FULL_TURN_DEG
            azimuth_deg = azimuth_deg + by_deg if names_turn else (azimuth_deg + by_deg) % FULL_TURN_DEG
        if elevation_deg is not None:
            ends_deg = max(elevation_deg, ZENITH_DEG, self._highest_deg)
            elevation_deg = min(elevation_deg + self._deg(Axis.ELEVATION), ends_deg)
        return replace(asked, azimuth_deg=azimuth_deg, elevation_deg=elevation_deg)

    def flown(self, axis: Axis, goal: AimGoal, mount: Mount, way: Way) -> AimGoal:
        """The goal of a planned flight, shifted within the mount's limits. `way`: the way that it flies now."""
        across_deg, up_deg = self._deg(Axis.AZIMUTH), self._deg(Axis.ELEVATION)
        if not across_deg and not up_deg:
            return goal
        if axis is Axis.AZIMUTH:
            return goal.mapped(lambda angle_deg: mount.azimuth.nearest(angle_deg + across_deg))
        azimuth_deg = mount.azimuth.nearest(way.azimuth_deg + across_deg)
        # Over the top the elevation axis goes down where the antenna goes up.
        raised_deg = -up_deg if way.flipped else up_deg
        return goal.mapped(lambda angle_deg: mount.clear_deg(azimuth_deg, angle_deg + raised_deg))
