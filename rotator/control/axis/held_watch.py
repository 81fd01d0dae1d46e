"""Whether a control box turns its axis when it has to hold: it does not hear its chip, or its own pot is broken.

Knows the axis's readings as a line, and since when its drive holds. Decides nothing: it returns a fault, and the supply
goes, where the box can switch it.
"""

from __future__ import annotations

from hw.ports import Axis
from rotator.control.axis.relay_faults import WAYS, unstoppable
from rotator.control.axis.trend import Trend
from rotator.exchange.faults import Fault, FaultKind

COASTS_S = 1.0
"""A box may turn on for this long after its last order: its relay, its coast, and the step of a stop."""
LOOKED_AT_S = 1.0
"""The speed is the mean over this time."""
HELD_TURNING_SHARE = 0.25
"""An axis that is faster than this share of its motor's speed is turned by its motor."""
TURNS_ERRORS = 4.0
TURNED_DEG = 4.0
"""An axis must also have turned this far since it had to hold. Two pots that disagree move it by less."""
ADVICE = "Check the wires of its digital pot and of the control box's own pot"
NO_RELAY = "; fit a relay in the boxes' supply (digipot.enable): without it they also turn at power-on"


def turns_by_itself(axis: Axis, measured: str, limit: str, *, master: bool) -> Fault:
    """`master`: an output switches the control boxes' supply."""
    advice = ADVICE if master else ADVICE + NO_RELAY
    return unstoppable(Fault(FaultKind.TURNS_BY_ITSELF, axis, measured, limit, advice=advice), master=master)


class HeldWatch:
    """`speed_dps`: of the motor. `master`: an output switches the supply."""

    def __init__(self, axis: Axis, speed_dps: float, *, master: bool) -> None:
        self._axis = axis
        self._limit_dps = HELD_TURNING_SHARE * speed_dps
        self._master = master
        self._held_s: float | None = None
        """Since when it has to hold; None: it is sent somewhere."""
        self._held_deg: float | None = None
        """Where the axis came to rest, or should have."""

    def see(self, now_s: float, readings: Trend, angle_deg: float | None, *, holds: bool) -> Fault | None:
        """Look at it. `angle_deg`: where it is now; `holds`: it is sent nowhere."""
        if not holds:
            self._held_s = self._held_deg = None
            return None
        self._held_s = now_s if self._held_s is None else self._held_s
        if angle_deg is None or now_s - self._held_s < COASTS_S:
            return None
        self._held_deg = angle_deg if self._held_deg is None else self._held_deg
        from_s = now_s - LOOKED_AT_S
        seen_through = max(self._held_s + COASTS_S, readings.since_s) <= from_s
        slope = readings.slope(from_s) if seen_through else None
        if slope is None or abs(slope.speed_dps) < max(self._limit_dps, TURNS_ERRORS * slope.error_dps):
            return None
        if abs(angle_deg - self._held_deg) < TURNED_DEG:
            return None
        way = WAYS[self._axis, slope.way]
        measured = f"it turns {way} at {abs(slope.speed_dps):.1f}°/s though it is to hold"
        limit = f"{self._limit_dps:.2g}°/s for {LOOKED_AT_S:g} s"
        return turns_by_itself(self._axis, measured, limit, master=self._master)
