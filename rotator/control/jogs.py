"""Who jogs which axis, so that a jog without a time ends with the connection that ordered it.

Knows both axes and the source of the last jog of each. Knows no other order.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis
from rotator.control.axis.port import ControlledAxis
from rotator.orders import Jog, Source


class Jogs:
    def __init__(self, axes: Mapping[Axis, ControlledAxis]) -> None:
        self._axes = axes
        self._by: dict[Axis, Source] = {}
        """The source of a jog that may still go on. A jog with a time ends by itself, and is not here."""

    def begin(self, jog: Jog, source: Source, now_s: float) -> None:
        self._axes[jog.axis].jog(jog.direction, jog.seconds, now_s)
        self._by.pop(jog.axis, None)
        if jog.seconds is None:
            self._by[jog.axis] = source

    def end(self, source: Source) -> None:
        """The connection of `source` has ended: halt what it still jogs."""
        for axis in [axis for axis, by in self._by.items() if by == source]:
            del self._by[axis]
            if self._axes[axis].jogging:
                self._axes[axis].halt()
