"""The axes that are to find their end stops, one after another, so that a person can watch each.

Knows which axes can be homed, which wait, and who has asked. While it is active only that source may move the antenna.
Does not know how an axis finds its stop.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from hw.ports import Axis
from rotator.control.axis.port import ControlledAxis
from rotator.exchange.sources import Source


class HomingQueue:
    """`axes`: all; those that can be homed take part."""

    def __init__(self, axes: Mapping[Axis, ControlledAxis]) -> None:
        self._axes = axes
        self._waiting: deque[Axis] = deque()
        self._asked_by: Source | None = None

    @property
    def active(self) -> bool:
        """An axis homes, or waits to."""
        return bool(self._waiting) or self._homing

    def holds_back(self, source: Source) -> bool:
        """Whether an axis homes, or waits to, for another source."""
        return self.active and source != self._asked_by

    def ask(self, axis: Axis, source: Source) -> None:
        """Raises Refused where the axis has no end stop to find."""
        if not self._axes[axis].homeable:
            self._axes[axis].home()  # it says why not
        self._asked_by = source
        self._waiting.append(axis)

    def due(self) -> bool:
        """Whether the next axis can begin now."""
        return bool(self._waiting) and not self._homing

    def begin(self) -> None:
        """The next axis goes to its end stop. Only where `due`, and with both axes at rest."""
        self._axes[self._waiting.popleft()].home()

    def clear(self) -> None:
        """Forget the axes that wait. The axis that homes now goes on until it is halted."""
        self._waiting.clear()

    @property
    def _homing(self) -> bool:
        """On its way to a target an axis finds its stop without having been asked."""
        return any(axis.homing and axis.aiming is None for axis in self._axes.values())
