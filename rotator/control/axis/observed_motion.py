"""What has been seen of one axis: its readings as a line, what its relays do, and how fast it has turned for certain.

Knows facts alone. `driven_watch`, `opening_watch` and `weld_watch` judge them. Time is an argument.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.relay_faults import WAYS
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.trend import Slope, Trend
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Motor

SLOWEST_DPS = 0.5
"""Until an axis has shown how fast it turns it may be as slow as this, also if the configuration says otherwise."""
RELAY_SETTLES_S = 0.05
"""A relay and the cycle in which it closed take this long at most."""


@dataclass(frozen=True, slots=True)
class SpeedWindow:
    """For how long the readings are looked at before a speed is believed, in seconds."""

    least_s: float
    first_s: float
    """At most, until the axis has shown that it turns."""
    most_s: float
    """At most, where the noise asks for it."""


class ObservedMotion:
    """`motors` is read, never changed: what is learnt meanwhile counts from the next run on.

    `behind_s`: a reading shows a place where the axis was at most so long ago.
    """

    def __init__(self, axis: Axis, limits: Range, motors: Mapping[Direction, Motor], *, behind_s: float = 0.0) -> None:
        self.axis = axis
        self.behind_s = behind_s
        self.limits = limits
        self.motors = motors
        self.trend = Trend(behind_s)
        self.relays = RelayState()
        self.motor = motors[Direction.PLUS]
        """The motor of the present or latest run, as it was known when the run began."""
        self.shown_dps: float | None = None
        """The fastest speed seen for certain; None: the axis was not seen to turn yet."""

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        self.relays = relays
        if relays.closed:
            self.motor = self.motors[relays.direction]

    def see(self, at_s: float, angle_deg: float) -> bool:
        """A good reading. Returns whether it lies on the line of the others."""
        steady = self.relays.since_s + 3.0 * self.behind_s <= at_s  # three readings that share nothing are newer
        return self.trend.see(at_s, angle_deg, max(each.speed_dps for each in self.motors.values()), steady=steady)

    def show(self, speed_dps: float) -> None:
        """The axis turns that fast for certain."""
        self.shown_dps = max(self.shown_dps or SLOWEST_DPS, speed_dps)

    @property
    def believed_dps(self) -> float:
        """The speed of the slower direction, as its motor is known."""
        return min(each.speed_dps for each in self.motors.values())

    @property
    def reference_dps(self) -> float:
        """The speed that is expected of the axis: that of its motor as known, but not more than it has shown."""
        return min(self.motor.speed_dps, SLOWEST_DPS if self.shown_dps is None else self.shown_dps)

    def speed(self, at_s: float, window: SpeedWindow, error_dps: float) -> Slope | None:
        """The speed over a stretch long enough for `error_dps`, since the relays are as they are; None: too early."""
        shown, relays, lag_s = self.shown_dps is not None, self.relays, self.motor.lag_s
        width_s = min(max(window.least_s, self.trend.window_s(error_dps)), window.most_s if shown else window.first_s)
        turns_s = relays.begun_s + RELAY_SETTLES_S + lag_s
        rests_s = relays.since_s + RELAY_SETTLES_S + (2.0 * lag_s + 3.0 * RELAY_SETTLES_S) + self.behind_s
        from_s = max(turns_s if relays.closed else rests_s, self.trend.since_s)
        if at_s - width_s < from_s:
            return None
        # A first run without a certain speed yet is looked at whole, because there are no other readings.
        return self.trend.slope(at_s - width_s if shown or not relays.closed else from_s)

    def whole_run(self, at_s: float, least_s: float) -> Slope | None:
        """The speed since the motor of the present run was due to turn; None: that is not `least_s` ago yet."""
        from_s = max(self.relays.begun_s + RELAY_SETTLES_S + self.motor.lag_s, self.trend.since_s)
        return self.trend.slope(from_s) if at_s - from_s >= least_s else None

    def name(self, direction: Direction) -> str:
        """The direction in a person's words: clockwise, down."""
        return WAYS[self.axis, direction]
