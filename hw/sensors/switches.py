"""Switches that a person or the rotor throws, by name, and what limit switches forbid.

Knows names and which way a limit switch blocks. Knows no line and no bounce: whoever asks often enough sees through it.
Whatever must not fail unseen is normally closed: a broken wire then reads as pressed, or as the limit reached.
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
"""Which way each switch lets its axis go no further."""


class LimitSwitches:
    """Normally closed switches at the ends of the travel; `fitted` names those that there are, of LIMITS."""

    def __init__(self, inputs: SwitchInputs, fitted: Collection[str]) -> None:
        self._inputs = inputs
        self._fitted = tuple(fitted)

    def blocked(self) -> dict[Axis, frozenset[Direction]]:
        """The ways in which each axis may go no further: its switch is open, or the wire to it.

        Raises HardwareError where they cannot be read: then every way that has a switch is to be taken for blocked.
        """
        closed = self._inputs.read()
        return self._ways([name for name in self._fitted if not closed[name]])

    def guarded(self) -> dict[Axis, frozenset[Direction]]:
        """The ways that have a switch."""
        return self._ways(self._fitted)

    @staticmethod
    def _ways(names: Collection[str]) -> dict[Axis, frozenset[Direction]]:
        ways = [LIMITS[name] for name in names]
        return {axis: frozenset(way for where, way in ways if where is axis) for axis in Axis}
