"""The watch over the control loop itself: a motor must not run for long without a control cycle.

Knows when the cycles began, and their period. Knows no reading and no motor.
"""

from __future__ import annotations

from hw.ports import Axis
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
