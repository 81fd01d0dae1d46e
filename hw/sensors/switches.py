"""Switches read together by name, and the directions that limit switches block.

Knows names, and which way each limit switch blocks. Knows no GPIO line. Does not filter bounce: the caller reads often.
A switch for safety is normally closed: a broken wire then reads as pressed, or as the limit reached.
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
    """Normally closed switches at the ends of the travel. `fitted`: the names of those that are wired, of LIMITS."""

    def __init__(self, inputs: SwitchInputs, fitted: Collection[str]) -> None:
        self._inputs = inputs
        self._fitted = tuple(fitted)

    def blocked(self) -> dict[Axis, frozenset[Direction]]:
        """The directions in which each axis must stop: its switch is open, or the wire to it is broken.

        Raises HardwareError when the switches cannot be read: the caller then takes all of `guarded` for blocked.
        """
        closed = self._inputs.read()
        return self._ways([name for name in self._fitted if not closed[name]])

    def guarded(self) -> dict[Axis, frozenset[Direction]]:
        """The directions that have a switch."""
        return self._ways(self._fitted)

    @staticmethod
    def _ways(names: Collection[str]) -> dict[Axis, frozenset[Direction]]:
        ways = [LIMITS[name] for name in names]
        return {axis: frozenset(way for where, way in ways if where is axis) for axis in Axis}
