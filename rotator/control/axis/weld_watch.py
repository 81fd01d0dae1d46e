"""Whether an axis turns though no relay drives it: a welded relay, or a hand on the control box's switch.

Knows the motion as observed, and what `opening_watch` makes of the relays. Decides nothing: it returns a fault, and the
axis stops. Speeds are compared with what the runs of this axis have shown; before the first, with what is believed.
"""

from __future__ import annotations

import math

from hw.ports import Direction
from rotator.control.axis.observed_motion import ObservedMotion, SpeedWindow
from rotator.control.axis.opening_watch import OpeningWatch
from rotator.control.axis.relay_faults import CUT_BY_HAND, accusation, unstoppable
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.relay_trust import RelayTrusts
from rotator.control.axis.trend import Slope
from rotator.exchange.faults import NOTICED_FOR_S, Fault, FaultKind, Notice
from rotator.exchange.motor import Trust

TURNING_WINDOW = SpeedWindow(1.0, 4.0, 4.0)
TURNING_SHARE = 0.5
"""An axis faster than this share of its motor's speed is turned by its motor."""
NOTICED_SHARE = 0.2
"""An axis below this share stands. Between the two shares a notice is shown."""
TURNS = Notice("turning with no relay on: wind, or a hand at the control box's switch", "TURNS BY SELF")
TURNS_ERRORS = 4.0
STILL_FAST_S = 0.4
CUT_IN_S = 3.0
"""If it still turns this long after its supply was cut, this box cannot stop it."""


class WeldWatch:
    """`master`: an output switches the motors' supply."""

    def __init__(self, seen: ObservedMotion, opening: OpeningWatch, trusts: RelayTrusts, *, master: bool) -> None:
        self._seen = seen
        self._opening = opening
        self._trusts = trusts
        self._master = master
        self._rested = True
        """The axis has stood since its relay opened."""
        self._fast_s = math.inf
        """Since when the axis turns as fast as its motor, with no relay on."""
        self._cut_s = math.inf
        """Since when the supply is to be cut."""
        self._noticed_s: float | None = None

    def note_relays(self, relays: RelayState, was: RelayState) -> None:
        """The relays have changed; `was`: before."""
        if was.closed:
            self._rested = False
        if relays.closed:
            self._cut_s = math.inf

    def acknowledge(self) -> None:
        """The fault is acknowledged: the supply comes back with the next order."""
        self._cut_s = math.inf

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction, as long as the opposite relay is suspected."""
        against = Direction(-direction)
        return accusation(self._seen.axis, against, self._trusts.of(against), self._opening.place, master=self._master)

    @property
    def notices(self) -> tuple[Notice, ...]:
        if self._noticed_s is None or self._seen.trend.last_s > self._noticed_s + NOTICED_FOR_S:
            return ()
        if self._master and self._noticed_s - self._cut_s > CUT_IN_S:
            return (Notice(f"still turning, though the motors' supply should be off: {CUT_BY_HAND}", "STILL TURNS"),)
        return (TURNS,)

    def judge(self, at_s: float) -> Fault | None:
        """The fault that the latest reading shows, with no relay on."""
        return self._turning(at_s) or self._run_on()

    def _turning(self, at_s: float) -> Fault | None:
        seen, motor_dps = self._seen, self._motor_dps
        limit_dps = (TURNING_SHARE if self._knows_speed else NOTICED_SHARE) * motor_dps
        exact = seen.speed(at_s, TURNING_WINDOW, limit_dps / 6.0)
        slope = exact or self._clearly(at_s)
        if slope is None:
            return None
        speed_dps = abs(slope.speed_dps)
        if exact and speed_dps < max(NOTICED_SHARE * motor_dps, 6.0 * slope.error_dps):
            self._rested, self._fast_s = True, math.inf
            return None
        if self._rested and speed_dps < 6.0 * slope.error_dps:
            self._fast_s = math.inf  # noise alone may look like this once in a while: it is at rest still
            return None
        self._noticed_s = at_s
        if speed_dps < limit_dps:
            self._fast_s = math.inf
            return None
        self._fast_s = min(self._fast_s, at_s)
        if self._rested and not self._still_turns(at_s, slope.way, limit_dps):
            return None
        return self._suspected(at_s, slope, limit_dps)

    def _clearly(self, at_s: float) -> Slope | None:
        """The speed of an axis that turns as its motor does; None: it is slower, or the noise leaves that open."""
        slope = self._seen.speed(at_s, TURNING_WINDOW, math.inf)
        if slope is None or abs(slope.speed_dps) - TURNS_ERRORS * slope.error_dps < TURNING_SHARE * self._motor_dps:
            return None
        return slope

    def _run_on(self) -> Fault | None:
        """The axis ran on, and stands now: at a stop, where the motor may still have current."""
        seen, opening, way = self._seen, self._opening, self._seen.relays.last
        if not opening.ran_on or way is Direction.OFF or self._trusts.of(way) is not Trust.DOUBTED:
            return None
        opening.found_closed(way)
        measured = f"it went on {seen.name(way)} after its relay was switched off, and{opening.place or ' stands'}"
        return self._closed(FaultKind.RELAY_WELDED, measured, f"{TURNING_SHARE:g} of its speed")

    @property
    def _motor_dps(self) -> float:
        believed_dps = self._seen.believed_dps
        return min(believed_dps, self._opening.measured_dps or believed_dps)

    @property
    def _knows_speed(self) -> bool:
        """Whether the motor's speed is known well enough to tell it from wind.

        A motor that was only tapped, or not driven yet, may be far slower than the configuration says.
        """
        return self._opening.measured_dps is not None or (self._rested and self._opening.looked)

    def _still_turns(self, at_s: float, way: Direction, limit_dps: float) -> bool:
        """Whether the axis, at rest before, turns for good: a push may be over while the window still holds it."""
        latest = self._seen.trend.slope(at_s - TURNING_WINDOW.least_s / 2.0)
        going = latest is not None and latest.speed_dps * way >= limit_dps / 2.0
        return going and at_s - self._fast_s >= STILL_FAST_S

    def _suspected(self, at_s: float, slope: Slope, limit_dps: float) -> Fault:
        seen, way = self._seen, slope.way
        self._opening.found_closed(way)
        self._cut_s = min(self._cut_s, at_s)
        welded = not self._rested and way is seen.relays.last
        after = " after its relay was switched off" if welded else ""
        measured = f"it turns {seen.name(way)} at {abs(slope.speed_dps):.1f}°/s{after}"
        kind = FaultKind.RELAY_WELDED if welded else FaultKind.TURNS_BY_ITSELF
        return self._closed(kind, measured, f"{limit_dps:.2g}°/s for {TURNING_WINDOW.least_s:g} s")

    def _closed(self, kind: FaultKind, measured: str, limit: str) -> Fault:
        return unstoppable(Fault(kind, self._seen.axis, measured, limit), master=self._master)
