"""How far an axis goes on after its relay was switched off: a coast, or a motor with current that something has held.

Knows how fast it turned, how far it has coasted before, and the readings since. Does not know what held it: a branch,
or a stop that is nearer than the sensor says.
"""

from __future__ import annotations

from rotator.control.axis.observed_motion import ObservedMotion
from rotator.control.axis.seen_run import SeenRun
from rotator.control.axis.trend import Slope

RAN_ON_S, RAN_ON_SHARE = 0.45, 0.9
"""After this time a coasting axis has gone less than this share of what a fed motor goes."""
RAN_ON_READINGS = 5
"""So many readings in a row show that it goes on at its speed."""
LATE_OPEN_S, COASTS_SHARE = 0.25, 1.5
"""A contact that is burnt opens so late, the mean of the readings included; and an axis coasts for this share at most
of what it has coasted before. Further it goes only with current."""
SUDDEN_SHARE, AROUND_S = 0.87, 0.08
"""So much of its way an axis has behind it when a motor with current would have got there: it did not slow down."""


def goes_on(seen: ObservedMotion, line: Slope, passed_s: float, gone_deg: float) -> bool:
    """Whether it has gone about as far as a motor with current goes in that time."""
    return gone_deg - 2.5 * seen.trend.noise_deg > RAN_ON_SHARE * abs(line.speed_dps) * passed_s


def went_far(seen: ObservedMotion, run: SeenRun, gone_deg: float) -> bool:
    """Whether it has gone further, since its relay was switched off, than it coasts."""
    lag_s = seen.motor.lag_s
    longest_s = max(LATE_OPEN_S + lag_s, COASTS_SHARE * lag_s)
    rough_dps = run.ended.line.rough_dps if run.ended and run.ended.line else 0.0
    return gone_deg - seen.trend.noise_deg > longest_s * (_full_dps(run) + rough_dps)


def ended_suddenly(seen: ObservedMotion, run: SeenRun, place_deg: float) -> bool:
    """Whether it went on at its full speed until something held it there: no coast ends so."""
    if (ended := run.ended) is None or ended.line is None:
        return False
    gone_deg = abs(place_deg - ended.angle_deg)
    if (place_deg - ended.angle_deg) * ended.line.speed_dps < 0.0 or not went_far(seen, run, gone_deg):
        return False
    # A motor with current would have got here by then; one that coasts is still on its way.
    then_deg = seen.trend.place_deg(ended.off_s + gone_deg / _full_dps(run), AROUND_S)
    return then_deg is None or abs(then_deg - ended.angle_deg) >= SUDDEN_SHARE * gone_deg


def _full_dps(run: SeenRun) -> float:
    """In a short run the motor was still gathering speed."""
    line = run.ended.line if run.ended else None
    return max(abs(line.speed_dps) if line else 0.0, run.motor_dps)
