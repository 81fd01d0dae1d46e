"""Whether an axis stands when no relay drives it: a welded relay, or a hand on the control box's switch.

Knows the motion as observed, and which relay is suspected of being welded. Decides nothing: it returns a fault, and the
axis stops. While a relay is suspected, an order for the opposite direction meets a fault: only cutting the supply ends
such a run.
"""

from __future__ import annotations

import math

from hw.ports import Direction
from rotator.control.axis.observed_motion import RELAY_S, ObservedMotion, Relays, Window
from rotator.control.axis.run_watch import CUT_BY_HAND, unstoppable
from rotator.control.axis.trend import Slope
from rotator.faults import Fault, FaultKind, Notice

TURNING = Window(1.0, 4.0, 4.0)
TURNING_SHARE = 0.5
"""An axis faster than this share of its motor's speed is turned by its motor."""
NOTICED_SHARE = 0.2
"""An axis slower than this share stands; one between the two is noticed."""
SLOWED_SHARE = 0.8
"""An axis slower than this share of its run's speed has begun to coast: its relay has opened."""
STILL_FAST_S = 0.4
NOTICED_FOR_S = 3.0
"""A notice stays this long after its cause, so that it can be read."""
CUT_IN_S = 3.0
"""What still turns so long after the supply was to be cut is beyond this box."""


class WeldWatch:
    """`master`: an output switches the motors' supply."""

    def __init__(self, seen: ObservedMotion, *, master: bool) -> None:
        self._seen = seen
        self._master = master
        self._slowed = True
        """The axis has slowed down since its relay opened."""
        self._rested = True
        """The axis has stood since its relay opened."""
        self._suspect = Direction.OFF
        """A relay found closed when it should be open, which has not been seen to open since."""
        self._retried = False
        """The suspected relay has been closed by order since."""
        self._fast_s = math.inf
        """Since when the axis turns as fast as its motor, with no relay on."""
        self._cut_s = math.inf
        """Since when the supply is to be cut."""
        self._noticed_s: float | None = None

    def driven(self, now_s: float, direction: Direction, was: Relays) -> None:
        """The relays change to `direction`; `was`: what they did before."""
        if was.direction is not Direction.OFF:
            # A run too short to reach half its speed has nothing to slow down from.
            self._slowed = now_s - was.since_s < was.motor.lag_s * math.log(2.0)
            self._rested = False
        if direction is not Direction.OFF:
            self._retried = self._retried or direction is self._suspect
            self._cut_s = math.inf

    def acknowledge(self) -> None:
        """A person knows; the supply comes back with the next order."""
        self._cut_s = math.inf

    def forbids(self, direction: Direction) -> bool:
        """Whether closing that relay now might work against the opposite one, where that has not let go."""
        seen = self._seen
        looked = seen.trend.last_s > seen.relays.since_s
        return looked and not self._slowed and direction is Direction(-seen.relays.last)

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault that an order in this direction meets, for as long as the opposite relay may be welded."""
        if self._suspect is Direction.OFF or direction is not Direction(-self._suspect):
            return None
        way = self._seen.name(self._suspect)
        return self._closed(FaultKind.RELAY_WELDED, f"{way} found closed", f"one run {way} that ends by itself")

    @property
    def notices(self) -> tuple[Notice, ...]:
        if self._noticed_s is None or self._seen.trend.last_s > self._noticed_s + NOTICED_FOR_S:
            return ()
        if self._master and self._noticed_s - self._cut_s > CUT_IN_S:
            return (Notice(f"still turning with the master open: {CUT_BY_HAND}", "STILL TURNS"),)
        return (Notice("turning with no relay on: a hand may be on the control box's switch", "TURNS BY SELF"),)

    def judge(self, at_s: float) -> Fault | None:
        """The fault that the latest reading shows, with no relay on."""
        seen = self._seen
        motor_dps = min(motor.speed_dps for motor in seen.motors.values())
        self._note_slowing()
        limit_dps = TURNING_SHARE * motor_dps
        slope = seen.speed(at_s, TURNING, limit_dps / 6.0)
        if slope is None:
            return None
        speed_dps = abs(slope.speed_dps)
        if speed_dps < max(NOTICED_SHARE * motor_dps, 6.0 * slope.rough_dps):
            self._note_standing()
            return None
        self._noticed_s = at_s
        if speed_dps < limit_dps:
            self._fast_s = math.inf
            return None
        self._fast_s = min(self._fast_s, at_s)
        way = Direction.PLUS if slope.speed_dps > 0 else Direction.MINUS
        if self._rested and not self._still_turns(at_s, way, limit_dps):
            return None
        return self._suspected(at_s, way, slope, limit_dps)

    def _note_slowing(self) -> None:
        """A coasting axis slows down as soon as its relay opens."""
        seen = self._seen
        if self._slowed:
            return
        slope = seen.trend.slope(seen.relays.since_s + max(RELAY_S, seen.relays.motor.lag_s))
        going_dps = SLOWED_SHARE * seen.relays.motor.speed_dps
        self._slowed = slope is not None and slope.speed_dps * seen.relays.last + 2.0 * slope.rough_dps < going_dps

    def _note_standing(self) -> None:
        self._slowed = self._rested = True
        self._fast_s = math.inf
        if not self._master or self._retried:
            # Standing though it has its supply, or after another run of that relay: the contact is open.
            self._suspect = Direction.OFF

    def _still_turns(self, at_s: float, way: Direction, limit_dps: float) -> bool:
        """Whether the axis, at rest before, turns for good: a push may be over while the window still holds it."""
        latest = self._seen.trend.slope(at_s - TURNING.least_s / 2.0)
        going = latest is not None and latest.speed_dps * way >= limit_dps / 2.0
        return going and at_s - self._fast_s >= STILL_FAST_S

    def _suspected(self, at_s: float, way: Direction, slope: Slope, limit_dps: float) -> Fault:
        seen = self._seen
        self._suspect, self._retried = way, False
        self._cut_s = min(self._cut_s, at_s)
        welded = not self._rested and way is seen.relays.last
        measured = f"{abs(slope.speed_dps):.1f}°/s {seen.name(way)}" + (" after its relay opened" if welded else "")
        kind = FaultKind.RELAY_WELDED if welded else FaultKind.TURNS_BY_ITSELF
        return self._closed(kind, measured, f"{limit_dps:.2g}°/s for {TURNING.least_s:g} s")

    def _closed(self, kind: FaultKind, measured: str, limit: str) -> Fault:
        return unstoppable(kind, self._seen.axis, measured, limit, master=self._master)
