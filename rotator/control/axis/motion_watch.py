"""Whether an axis does what its relays tell it: runs when driven, the right way, and stands when not.

Knows what the relays do, the believable readings, the motor as learnt, and the limits. Time is an argument. Decides
nothing: it hands out a fault, and whoever owns the axis stops it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.motion import Motor
from rotator.control.axis.run_watch import CUT_BY_HAND, WAYS, endless, unstoppable
from rotator.control.axis.trend import Slope, Trend
from rotator.control.sky.mount import Range
from rotator.status import Fault

LATE_S = 0.5
"""A cycle this much late while a motor runs: the guard has opened its relay meanwhile."""

SLOWEST_DPS = 0.5
"""Until an axis has shown how fast it turns, whatever its motor is said to do, it may be as slow as this."""
RELAY_S = 0.05
"""A relay and the cycle in which it closed take this long at most."""
STANDING_S = (1.4, 1.5, 4.0)
"""How long a standing pot is looked at: at least; at most until it has turned; at most where the noise asks for it."""
STANDING_SHARE, SLOW_STANDING_SHARES = 0.25, (0.5, 0.4)
WRONG_WAY_S = (0.4, 0.65, 3.0)
WRONG_WAY_SHARE = 0.5
TURNING_S = (1.0, 4.0, 4.0)
TURNING_SHARE = 0.5
STILL_FAST_S = 0.4
NOTICED_SHARE = 0.2
"""Shares of the motor's speed: less than this is standing, that much backwards is the wrong way, and so on."""
NOTICED_FOR_S = 3.0
"""A notice stays this long after its cause, so that it can be read."""
NEAR_END_DEG = 5.0
"""Standing still this near to a limit, driven towards it, is an end stop."""
CUT_IN_S = 3.0
"""What still turns so long after the supply was to be cut is beyond this box."""


def late(axis: Axis, gap_s: float, period_s: float) -> Fault:
    return Fault("control thread late", axis, f"{gap_s:.1f} s from one cycle to the next", f"{period_s + LATE_S:g} s")


class MotionWatch:
    """One axis. Tell it every believable reading (`see`) and every change of the relays (`driven`), in order of time.

    `motors` is looked at, never changed: what is learnt meanwhile counts from the next run on.
    """

    def __init__(self, axis: Axis, limits: Range, motors: Mapping[Direction, Motor], *, master: bool) -> None:
        self._axis = axis
        self._limits = limits
        self._motors = motors
        self._master = master
        self._trend = Trend()
        self._motor = motors[Direction.PLUS]
        self._direction = Direction.OFF
        self._last = Direction.OFF
        self._since_s = -math.inf
        """When the relays last changed."""
        self._shown_dps: float | None = None
        """The fastest that the axis has been seen to turn for certain."""
        self._slowed = True
        self._rested = True
        self._suspect = Direction.OFF
        """A relay found closed when it should be open, which has not been seen to open since."""
        self._retried = False
        self._fast_s = math.inf
        self._cut_s = math.inf
        self._noticed_s: float | None = None

    def driven(self, now_s: float, direction: Direction) -> None:
        """What the relays do from now on."""
        if direction is self._direction:
            return
        if self._direction is not Direction.OFF:
            self._last = self._direction
            # A run too short to get to half speed has nothing to slow down from.
            self._slowed = now_s - self._since_s < self._motor.lag_s * math.log(2.0)
            self._rested = False
        if direction is not Direction.OFF:
            self._motor = self._motors[direction]
            self._retried = self._retried or direction is self._suspect
            self._cut_s = math.inf
        self._direction, self._since_s = direction, now_s

    def see(self, at_s: float, angle_deg: float, _changes: int = 0) -> Fault | None:
        """A believable reading. Returns the fault it amounts to, if it does."""
        taken = self._trend.see(at_s, angle_deg, max(motor.speed_dps for motor in self._motors.values()))
        if self._direction is Direction.OFF:
            return self._undriven(at_s) if taken else None
        return (taken and (self._wrong_way(at_s) or self._standing(at_s, angle_deg))) or self._endless(at_s)

    def forbids(self, direction: Direction) -> bool:
        """Whether closing that relay now might work against the opposite one, if its contact has not let go."""
        looked = self._trend.last_s > self._since_s
        return looked and not self._slowed and direction is Direction(-self._last)

    def acknowledge(self) -> None:
        """A person knows; the supply comes back with the next order."""
        self._cut_s = math.inf

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault that an order in this direction meets, for as long as the opposite relay may be welded."""
        if self._suspect is Direction.OFF or direction is not Direction(-self._suspect):
            return None
        way = self._way(self._suspect)
        return self._closed("relay welded", f"{way} found closed", f"one run {way} that ends by itself")

    @property
    def notices(self) -> tuple[str, ...]:
        if self._noticed_s is None or self._trend.last_s > self._noticed_s + NOTICED_FOR_S:
            return ()
        if self._master and self._noticed_s - self._cut_s > CUT_IN_S:
            return (f"still turning with the master open: {CUT_BY_HAND}",)
        return ("turning with no relay on: a hand may be on the control box's switch",)

    def _reference_dps(self) -> float:
        """What the axis must live up to: what is known of its motor, but no more than it has shown."""
        return min(self._motor.speed_dps, SLOWEST_DPS if self._shown_dps is None else self._shown_dps)

    def _window(self, at_s: float, bounds_s: tuple[float, float, float], rough_dps: float) -> Slope | None:
        """The speed over a stretch long enough for the noise, once the relays have been as they are for so long."""
        least_s, first_s, most_s = bounds_s
        shown = self._shown_dps is not None
        width_s = min(max(least_s, self._trend.window_s(rough_dps)), most_s if shown else first_s)
        ready_s = self._since_s + RELAY_S
        ready_s += self._motor.lag_s if self._direction else 2.0 * self._motor.lag_s + 3.0 * RELAY_S
        from_s = max(ready_s, self._trend.since_s)
        if at_s - width_s < from_s:
            return None
        # A first run that has not convinced yet is looked at whole: that is all there is to go by.
        return self._trend.slope(at_s - width_s if shown or not self._direction else from_s)

    def _wrong_way(self, at_s: float) -> Fault | None:
        reference_dps = self._reference_dps()
        slope = self._window(at_s, WRONG_WAY_S, reference_dps / 5.0)
        limit_dps = WRONG_WAY_SHARE * reference_dps
        if slope is None or slope.speed_dps * self._direction > -max(limit_dps, 3.0 * slope.rough_dps):
            return None
        measured = f"driven {self._way(self._direction)}, it reads {slope.speed_dps:+.1f}°/s"
        return Fault("pot moves the wrong way", self._axis, measured, f"{limit_dps:.2g}°/s backwards")

    def _standing(self, at_s: float, angle_deg: float) -> Fault | None:
        reference_dps = self._reference_dps()
        slow_dps = SLOW_STANDING_SHARES[self._shown_dps is not None] * reference_dps
        limit_dps = max(STANDING_SHARE * reference_dps, min(STANDING_SHARE, slow_dps))
        slope = self._window(at_s, STANDING_S, limit_dps / 4.5)
        if slope is None:
            return None
        speed_dps = slope.speed_dps * self._direction
        if speed_dps >= limit_dps:
            certain_dps = speed_dps - 2.0 * slope.rough_dps
            if certain_dps > limit_dps:
                self._shown_dps = max(self._shown_dps or SLOWEST_DPS, certain_dps)
            return None
        way = self._way(self._direction)
        end_deg = self._limits.max_deg if self._direction > 0 else self._limits.min_deg
        if (end_deg - angle_deg) * self._direction <= NEAR_END_DEG:
            measured = f"stands at {angle_deg:.1f}°, driven {way}"
            return Fault("end stop reached", self._axis, measured, f"{end_deg:g}° without touching the stop")
        measured = f"driven {way}, it reads {slope.speed_dps + 0.0:.2f}°/s at {angle_deg:.1f}°"
        return Fault("motor runs and pot stands still", self._axis, measured, f"{limit_dps:.2g}°/s within 2 s")

    def _endless(self, at_s: float) -> Fault | None:
        return endless(self._axis, self._direction, at_s - self._since_s, self._limits, self._reference_dps())

    def _undriven(self, at_s: float) -> Fault | None:
        motor_dps = min(motor.speed_dps for motor in self._motors.values())
        if not self._slowed:
            # What it does right after the relay opened; coasting, it slows down at once.
            slope = self._trend.slope(self._since_s + max(RELAY_S, self._motor.lag_s))
            going_dps = self._motor.speed_dps
            if slope and slope.speed_dps * self._last + 2.0 * slope.rough_dps < 0.8 * going_dps:
                self._slowed = True
        limit_dps = TURNING_SHARE * motor_dps
        slope = self._window(at_s, TURNING_S, limit_dps / 6.0)
        if slope is None:
            return None
        speed_dps = abs(slope.speed_dps)
        if speed_dps < max(NOTICED_SHARE * motor_dps, 6.0 * slope.rough_dps):
            self._slowed = self._rested = True
            self._fast_s = math.inf
            if not self._master or self._retried:
                # Standing though it has its supply, or after another run of that relay: the contact is open.
                self._suspect = Direction.OFF
            return None
        self._noticed_s = at_s
        if speed_dps < limit_dps:
            self._fast_s = math.inf
            return None
        self._fast_s = min(self._fast_s, at_s)
        way = Direction.PLUS if slope.speed_dps > 0 else Direction.MINUS
        if self._rested:
            # The window reaches back to where it stood; it may have been a push that is over.
            latest = self._trend.slope(at_s - TURNING_S[0] / 2.0)
            if at_s - self._fast_s < STILL_FAST_S or latest is None or latest.speed_dps * way < limit_dps / 2.0:
                return None
        self._suspect, self._retried = way, False
        self._cut_s = min(self._cut_s, at_s)
        welded = not self._rested and way is self._last
        measured = f"{speed_dps:.1f}°/s {self._way(way)}" + (" after its relay opened" if welded else "")
        name = "relay welded" if welded else "turning with no relay on"
        return self._closed(name, measured, f"{limit_dps:.2g}°/s for {TURNING_S[0]:g} s")

    def _closed(self, name: str, measured: str, limit: str) -> Fault:
        return unstoppable(name, self._axis, measured, limit, master=self._master)

    def _way(self, direction: Direction) -> str:
        return WAYS[self._axis, direction]
