"""How an axis goes on after its relay was switched off: it coasts, or its motor still has current.

Knows how fast the axis turned, how far it has coasted before, and the readings since. Does not know what may hold it: a
branch, or a stop that is nearer than the sensor says.
"""

from __future__ import annotations

from rotator.control.axis.observed_motion import RELAY_SETTLES_S, ObservedMotion
from rotator.control.axis.seen_run import SLOWED_SHARE, STEADY_S, EndedRun, SeenRun
from rotator.control.axis.trend import Slope

RAN_ON_S, RAN_ON_SHARE = 0.45, 0.9
"""After this time a coasting axis has gone less than this share of the way of a powered motor."""
RAN_ON_READINGS = 5
"""An axis runs on if this many readings in a row show it."""
COASTS_NOISES, COASTS_S = 5.0, 1.5
"""Two mean angles differ if they are 5 noises apart: each is the mean of three readings. No coast lasts longer."""
MEAN_OVER_S = 0.09
"""The second reading from now has no older one in its mean; somewhat less than two periods of 0.05 s."""
LATE_OPEN_S, COASTS_SHARE = 0.25, 1.5
"""A burnt contact opens late by this time at most, the mean of the readings included. A coast is at most 1.5 times the
known coast. Only a powered motor turns its axis further."""
SUDDEN_SHARE, AROUND_S = 0.87, 0.08
"""An axis that has this share of its way behind it when a powered motor would have arrived did not slow down."""


class RunOn:
    """The axis after its latest run."""

    def __init__(self, seen: ObservedMotion, run: SeenRun) -> None:
        self._seen = seen
        self._run = run
        self.begin()

    def begin(self) -> None:
        """A run begins: forget what the run before has shown."""
        self.ran_on = False
        """The axis went on at its speed after its relay was switched off."""
        self.held_up = False
        """The axis went on until something held it."""
        self._going = 0
        """How many readings in a row have shown that it runs on."""
        self._lagged_s: float | None = None
        """When it was first clearly slower than a powered motor."""
        self._lagged_deg: float | None = None
        """The distance coasted when the readings had followed it there."""

    def slows(self, at_s: float, place_deg: float, ended: EndedRun, line: Slope, *, free: bool) -> bool:
        """Whether the axis, now at `place_deg`, has been seen to slow down. `line`: how it turned when the run ended.

        `free`: a powered motor could turn on from where the axis is at most by now.
        """
        slope = self._seen.trend.slope(ended.off_s + RELAY_SETTLES_S)
        if slope is None:
            return False
        least_dps = abs(line.speed_dps) - 2.0 * line.error_dps
        slowed = slope.speed_dps * line.way + 3.0 * slope.error_dps < SLOWED_SHARE * least_dps
        passed_s = at_s - ended.off_s
        gone_deg = (place_deg - ended.angle_deg) * line.way
        still_coasts = self._still_coasts(at_s, passed_s, gone_deg, line)
        if (slowed and free and not self._went_far(ended, gone_deg)) or still_coasts:
            return True
        if passed_s >= RAN_ON_S + self._seen.behind_s and ended.lasted_s >= STEADY_S:
            self._going = self._going + 1 if self._goes_on(line, passed_s, gone_deg) else 0
            self.ran_on = self._going >= RAN_ON_READINGS
        return False

    def stands(self, place_deg: float) -> None:
        """The axis has come to rest. A coast ends slowly; an axis that something holds at full speed ends suddenly."""
        if (ended := self._run.ended) is None or ended.line is None:
            return
        gone_deg = abs(place_deg - ended.angle_deg)
        if (place_deg - ended.angle_deg) * ended.line.speed_dps < 0.0 or not self._went_far(ended, gone_deg):
            return
        # At this moment a powered motor would already have been here. A coasting axis was still on its way.
        then_s = ended.off_s + gone_deg / self.full_dps(ended) + self._seen.behind_s
        then_deg = self._seen.trend.place_deg(then_s, AROUND_S)
        if then_deg is None or abs(then_deg - ended.angle_deg) >= SUDDEN_SHARE * gone_deg:
            self.held_up = True

    def _still_coasts(self, at_s: float, passed_s: float, gone_deg: float, line: Slope) -> bool:
        """Whether the axis has fallen behind a powered motor, and still moves on: something would have held it there.

        The readings go on to that place themselves, as long as they are behind the axis. Many are compared, so each
        difference must be larger than for one reading. No coast takes long.
        """
        if passed_s > COASTS_S:
            return False
        sure_deg = COASTS_NOISES * self._seen.trend.noise_deg
        if self._lagged_s is None:
            behind_deg = abs(line.speed_dps) * passed_s - gone_deg
            if behind_deg > sure_deg + 3.0 * line.error_dps * passed_s:
                self._lagged_s = at_s
        elif self._lagged_deg is None and at_s - self._lagged_s >= self._seen.behind_s + MEAN_OVER_S:
            self._lagged_deg = gone_deg
        return self._lagged_deg is not None and gone_deg - self._lagged_deg > sure_deg

    def _goes_on(self, line: Slope, passed_s: float, gone_deg: float) -> bool:
        """Whether the axis has gone about as far as a powered motor goes in that time."""
        return gone_deg - 2.5 * self._seen.trend.noise_deg > RAN_ON_SHARE * abs(line.speed_dps) * passed_s

    def _went_far(self, ended: EndedRun, gone_deg: float) -> bool:
        """Whether the axis has gone further than it coasts, since its relay was switched off."""
        lag_s = self._seen.motor.lag_s
        longest_s = max(LATE_OPEN_S + lag_s, COASTS_SHARE * lag_s) + self._seen.behind_s
        error_dps = ended.line.error_dps if ended.line else 0.0
        return gone_deg - self._seen.trend.noise_deg > longest_s * (self.full_dps(ended) + error_dps)

    def full_dps(self, ended: EndedRun) -> float:
        """The motor's full speed, which it has not reached in a short run."""
        return max(abs(ended.line.speed_dps) if ended.line else 0.0, self._run.motor_dps)
