"""What counts from cycle to cycle: that the control loop is not late, and how often each motor starts in a pass.

A motor must not run for long without a control cycle. Knows when the cycles began and which relays are closed. Knows no
reading and no target.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.exchange.faults import Fault, FaultKind

CYCLE_LATE_S = 0.5
"""A cycle that is this late while a motor runs is a fault: the guard has opened its relay meanwhile."""


class Cycles:
    """Call `begin` at the beginning of every cycle, and `end` when the drives have their commands. `period_s`: from one
    cycle to the next. Both return the fault of each axis, if any.
    """

    def __init__(self, period_s: float) -> None:
        self._longest_s = period_s + CYCLE_LATE_S
        self._begun_s: float | None = None

    def begin(self, now_s: float, *, running: bool) -> tuple[Fault, ...]:
        """A cycle begins. `running`: a motor was on since the last one."""
        faults = self.end(now_s, running=running)
        self._begun_s = now_s
        return faults

    def end(self, now_s: float, *, running: bool) -> tuple[Fault, ...]:
        """The cycle has acted. `running`: a motor was on when it began."""
        gap_s = 0.0 if self._begun_s is None else now_s - self._begun_s
        if not running or gap_s <= self._longest_s:
            return ()
        measured = f"the box did nothing for {gap_s:.1f} s while a motor ran"
        return tuple(Fault(FaultKind.CONTROL_LATE, axis, measured, f"{self._longest_s:g} s") for axis in Axis)


PASS_PAUSE_S = 120.0


class PassStarts:
    """How often each motor has been started in this pass.

    A pass begins with the first order or motor run after a pause of PASS_PAUSE_S. So the count begins as the target
    rises, and can still be read after the target has set. Call `ordered` for every order that moves, and `note_driven`
    after every cycle.
    """

    def __init__(self) -> None:
        self._counts = dict.fromkeys(Axis, 0)
        self._on = dict.fromkeys(Axis, Direction.OFF)
        self._busy_s = -math.inf
        """When the latest order came, or a motor last ran."""

    def of(self, axis: Axis) -> int:
        return self._counts[axis]

    def ordered(self, now_s: float) -> None:
        """An order to move came."""
        if now_s - self._busy_s >= PASS_PAUSE_S:
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
