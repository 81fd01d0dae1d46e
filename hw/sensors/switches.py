"""Switches read together by name, and the directions that limit switches block.

Knows the names, and the direction that each limit switch blocks. Does not know GPIO lines, and does not filter bounce:
the caller reads often. A safety switch is normally closed, so that a broken wire reads as pressed or as a reached
limit.
"""

from __future__ import annotations

from collections.abc import Collection

from hw.ports import Axis, Direction, SwitchInputs

LIMITS = {
    "azimuth_low": (Axis.AZIMUTH, Direction.MINUS),
    "azimuth_high": (Axis.AZIMUTH, Direction.PLUS),
    "elevation_low": (Axis.ELEVATION, Direction.MINUS),
    "elevation_high": (Axis.ELEVATION, Direction.PLUS),
}
"""The axis and the direction that each switch blocks."""


class LimitSwitches:
    """Normally closed switches at the ends of the travel. `fitted`: names of the wired switches, keys of LIMITS."""

    def __init__(self, inputs: SwitchInputs, fitted: Collection[str]) -> None:
        self._inputs = inputs
        self._fitted = tuple(fitted)

    def blocked(self) -> dict[Axis, frozenset[Direction]]:
        """The directions in which each axis must stop: its switch is open, or the wire to it is broken.

        Raises HardwareError when the switches cannot be read: the caller then takes all of `guarded` as blocked.
        """
        closed = self._inputs.read()
        return self._directions([name for name in self._fitted if not closed[name]])

    def guarded(self) -> dict[Axis, frozenset[Direction]]:
        """The directions that have a switch."""
        return self._directions(self._fitted)

    @staticmethod
    def _directions(names: Collection[str]) -> dict[Axis, frozenset[Direction]]:
        blocked = [LIMITS[name] for name in names]
        return {axis: frozenset(direction for on_axis, direction in blocked if on_axis is axis) for axis in Axis}
