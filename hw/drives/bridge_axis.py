"""One axis of an H-bridge drive: how fast its motor should turn now, and what its encoder says against it.

Knows where the axis was sent, where its encoder has it, and how hard the motor may speed up and brake. A motor that is
driven and does not turn, or turns the wrong way, and one that turns while it is off, is stopped here at once. Knows no
line, no thread and no clock: moments are arguments, in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from hw.ports import Direction

STEP_S = 0.02
"""The loop runs 50 times a second while a motor is fed."""
LATE_S = 0.1
"""After a longer pause the loop did not run: the motor gets no more speed for it."""
GAIN_PER_S, INTEGRAL_PER_S2 = 4.0, 2.0
"""For a degree behind, so many degrees a second more; and so many for a degree behind for a second: friction."""
WOUND_SHARE = 0.3
"""What the integral adds is at most this share of the full speed."""
NEAR_DEG = 0.25
"""The integral counts only this near to the place: on the way it would only cause overshoot."""
BRAKES_SHARE = 0.7
"""It plans to brake at this share of what it may, so that the gain has the rest."""
STANDS_DPS = 0.02
"""A target slower than this, as Sun and Moon, is followed in steps: no motor turns so slowly, it only hums."""
QUIET_DEG, QUIET_COUNTS = 1.0, 10.0
"""A motor that should have turned this far, and more than so many counts, and has not moved by two, does not turn."""
WRONG_DEG, WRONG_COUNTS, WRONG_AFTER_S = 0.5, 6.0, 0.3
"""A motor that has gone this far, and so many counts, against the drive turns the wrong way. So long after a change of
direction it may still coast."""
TURNING_DEG, TURNING_COUNTS, TURNING_S, COASTS_S = 1.0, 6.0, 2.0, 1.0
"""A motor that is off for so long should stand. If it goes that far within two seconds, it turns by itself."""


class Amiss(Enum):
    """What the encoder says against the drive."""

    QUIET = "does not turn"
    WRONG_WAY = "turns the wrong way"
    TURNING = "turns while it is off"
    LOST = "its count is lost"
    HOMING = "its end was not found"


@dataclass(frozen=True, slots=True)
class Course:
    """A line in time: `angle_deg` at `since_s`, moving on at `rate_dps`, until `until_s`."""

    angle_deg: float
    rate_dps: float
    since_s: float
    until_s: float


@dataclass(frozen=True, slots=True)
class BridgeSpec:
    """`speed_dps`: at full duty. `min_duty`: at less the motor does not turn. `count_deg`: one count of its encoder."""

    speed_dps: float
    accel_dps2: float
    min_duty: float
    count_deg: float


class BridgeAxis:
    """Call `step` in each round of the loop for the speed, and `watch` after the bridge was fed."""

    def __init__(self, spec: BridgeSpec) -> None:
        self.spec = spec
        self.course: Course | None = None
        """Where it was sent; None: it brakes and stands."""
        self.amiss: tuple[Amiss, str] | None = None
        """What stopped it, with what was seen; None: nothing, or it was acknowledged."""
        self._speed_dps = 0.0
        self._wound_dps = 0.0
        self._stepped_s = -math.inf
        self._resting = False
        """It stands at its place, within the dead band."""
        self._fed = Direction.OFF
        self._from_s = self._from_deg = 0.0
        """Since when it is fed this way, or off; and how far it got that way, or where it came to rest."""
        self._due_deg = 0.0
        """How far it should have turned since it was last seen to."""
        self._seen_deg = 0.0
        """Where it was last seen to turn."""

    @property
    def moving(self) -> bool:
        return self.course is not None or self._speed_dps != 0.0

    def stop(self) -> None:
        """At once, without braking."""
        self.course, self._speed_dps, self._wound_dps = None, 0.0, 0.0

    def step(self, now_s: float, angle_deg: float) -> float:
        """Degrees a second, along the axis's scale; 0: the motor is to be off."""
        if self.course is not None and self.course.until_s <= now_s:
            self.course = None
        past_s = min(now_s - self._stepped_s, LATE_S)
        self._stepped_s = now_s
        if self.amiss:
            self.stop()
            return 0.0
        wanted_dps = self._wanted_dps(now_s, angle_deg, past_s)
        most_dps = self.spec.accel_dps2 * past_s
        self._speed_dps += min(max(wanted_dps - self._speed_dps, -most_dps), most_dps)
        return self._speed_dps

    def duty(self, speed_dps: float) -> float:
        """The duty for that speed: above the least at which the motor turns."""
        share = min(abs(speed_dps) / self.spec.speed_dps, 1.0)
        return self.spec.min_duty + (1.0 - self.spec.min_duty) * share

    def _wanted_dps(self, now_s: float, angle_deg: float, past_s: float) -> float:
        course, spec = self.course, self.spec
        if course is None:
            self._wound_dps = 0.0
            return 0.0
        off_deg = course.angle_deg + course.rate_dps * (now_s - course.since_s) - angle_deg
        # A count's width is no error; once there, it starts again only when it is clearly outside.
        band_deg = spec.count_deg * (1.5 if self._resting else 0.75)
        self._resting = abs(course.rate_dps) < STANDS_DPS and abs(off_deg) <= band_deg
        if self._resting:
            self._wound_dps = 0.0
            return 0.0
        if abs(off_deg) < NEAR_DEG:
            most_dps = WOUND_SHARE * spec.speed_dps
            wound_dps = self._wound_dps + INTEGRAL_PER_S2 * off_deg * past_s
            self._wound_dps = min(max(wound_dps, -most_dps), most_dps)
        brakes_dps = math.sqrt(2.0 * BRAKES_SHARE * spec.accel_dps2 * abs(off_deg))
        towards_dps = math.copysign(min(GAIN_PER_S * abs(off_deg), brakes_dps), off_deg)
        wanted_dps = course.rate_dps + towards_dps + self._wound_dps
        return min(max(wanted_dps, -spec.speed_dps), spec.speed_dps)

    # --- what the encoder says

    def watch(self, now_s: float, turned_deg: float, fed: Direction, past_s: float) -> None:
        """`turned_deg`: how far it has turned since the start. `fed`: how the bridge feeds the motor now. `past_s`:
        since the last call."""
        if fed is not self._fed:
            self._fed, self._due_deg = fed, 0.0
            self._from_s, self._from_deg, self._seen_deg = now_s, turned_deg, turned_deg
            return
        count_deg, since_s = self.spec.count_deg, now_s - self._from_s
        if fed is Direction.OFF:
            if since_s < COASTS_S:
                self._from_deg = turned_deg
            elif since_s > COASTS_S + TURNING_S:
                self._from_s, self._from_deg = now_s - COASTS_S, turned_deg
            elif abs(turned_deg - self._from_deg) > max(TURNING_DEG, TURNING_COUNTS * count_deg):
                self.amiss = Amiss.TURNING, f"it turned by {turned_deg - self._from_deg:+.1f}° while its bridge is off"
            return
        if abs(turned_deg - self._seen_deg) > 1.5 * count_deg:
            self._seen_deg, self._due_deg = turned_deg, 0.0
        self._due_deg += abs(self._speed_dps) * min(past_s, LATE_S)
        if since_s < WRONG_AFTER_S or (turned_deg - self._from_deg) * fed > 0:
            self._from_deg = turned_deg
        elif (self._from_deg - turned_deg) * fed > max(WRONG_DEG, WRONG_COUNTS * count_deg):
            gone_deg = turned_deg - self._from_deg
            self.amiss = Amiss.WRONG_WAY, f"its encoder went {gone_deg:+.1f}°, its motor was driven the other way"
        if self._due_deg > max(QUIET_DEG, QUIET_COUNTS * count_deg):
            self.amiss = Amiss.QUIET, f"its motor was to turn by {self._due_deg:.1f}°, its encoder did not count"
