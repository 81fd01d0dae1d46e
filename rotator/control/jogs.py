"""Who jogs which axis, so that a jog without a time ends with the connection that ordered it.

Knows both axes, and the source of the last jog of each. Knows no other order.
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
        """The source of the last jog."""

    def begin(self, jog: Jog, source: Source, now_s: float) -> None:
        self._axes[jog.axis].jog(jog.direction, jog.seconds, now_s)
        self._by[jog.axis] = source

    def end(self, source: Source) -> None:
        """The connection of `source` has ended: halt what it still jogs. A jog with a time ends by itself."""
        for axis, by in self._by.items():
            if by == source and self._axes[axis].jogs_without_end:
                self._axes[axis].halt()
