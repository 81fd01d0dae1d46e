"""How often each motor has been started in this pass.

A pass begins with the first order or motor run after a pause of PAUSE_S. So the count begins as the target rises, and
can still be read after the target has set. Knows moments and relays. Knows no target.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis, Direction

PAUSE_S = 120.0


class PassStarts:
    """Call `ordered` for every order that moves, and `note_driven` after every cycle."""

    def __init__(self) -> None:
        self._counts = dict.fromkeys(Axis, 0)
        self._on = dict.fromkeys(Axis, Direction.OFF)
        self._busy_s = -math.inf
        """When the latest order came, or a motor last ran."""

    def of(self, axis: Axis) -> int:
        return self._counts[axis]

    def ordered(self, now_s: float) -> None:
        """An order to move came."""
        if now_s - self._busy_s >= PAUSE_S:
            self._counts = dict.fromkeys(Axis, 0)
        self._busy_s = now_s

    def note_driven(self, now_s: float, driven: Mapping[Axis, Direction]) -> None:
        """After the cycle: the direction in which each axis's relays are closed. A reversal is a start too."""
        for axis, direction in driven.items():
            if direction is not Direction.OFF:
                if direction is not self._on[axis]:
                    self.ordered(now_s)
                    self._counts[axis] += 1
                self._busy_s = now_s
            self._on[axis] = direction
