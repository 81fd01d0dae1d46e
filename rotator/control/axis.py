"""One axis under control: what it is to do, whether its sensor can be believed, what to tell its motor.

Knows its goal, its limits and its faults. Knows nothing of the sky, of the other axis, or of who gave the order.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.calibration import Calibration, between_ends
from rotator.control.motion import Motor
from rotator.control.mount import Range
from rotator.control.plan import Path
from rotator.control.sensing import Reading, Sensing, Window
from rotator.control.switched import Run, SwitchedLaw
from rotator.status import AxisStatus, Fault

UNCALIBRATED_JOG_S = 2.0
"""One press on an axis that nobody has commissioned yet."""
JOG_TOLERANCE_DEG = 0.5
"""Nearer than this to its limit a jog does not start."""
SETTLED_AFTER_S = 1.0
"""A motor counts as moving until it has been off this long."""


@dataclass(frozen=True, slots=True)
class AxisSettings:
    axis: Axis
    limits: Range
    tolerance_deg: float
    motor: Motor
    """What is known of the motor before it has taught us better."""
    window: Window
    calibration: Calibration | None
    missing: tuple[str, ...] = ()
    """What a person has still to do before this axis may be aimed; empty: commissioned."""
    source: str = "measured"


@dataclass(frozen=True, slots=True)
class AimGoal:
    """A target, with its path where it moves. The tolerance is the axis's own, or on the sky along a path."""

    target_deg: float
    tolerance_deg: float
    path: Path | None = None


@dataclass(frozen=True, slots=True)
class JogGoal:
    direction: Direction
    until_s: float | None


class AxisControl:
    def __init__(self, settings: AxisSettings, *, lease_s: float, period_s: float) -> None:
        self.settings = settings
        self.goal: AimGoal | JogGoal | None = None
        self.fault: Fault | None = None
        self._missing = settings.missing
        self._lease_s = lease_s
        self._period_s = period_s
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration)
        self._law = SwitchedLaw(settings.motor, lease_s=lease_s, period_s=period_s)
        self._seen_s: float | None = None
        self._driven_s: float | None = None
        self._first_end: tuple[bool, float] | None = None

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def uncalibrated(self) -> str:
        """What is missing before this axis may be aimed; empty: nothing."""
        return ", ".join(self._missing)

    @property
    def calibration(self) -> Calibration | None:
        return self._sensing.calibration

    def see(self, reading: Reading, now_s: float) -> None:
        """Take the latest reading; the same one again is no news but may have grown too old."""
        fault = self._sensing.take(reading, now_s)
        if fault is not None and self.fault is None:
            self.fault = fault
        if self._sensing.believable and reading.at_s != self._seen_s and self._sensing.angle_deg is not None:
            self._law.see(reading.at_s, self._sensing.angle_deg)
            self._seen_s = reading.at_s

    def acknowledge(self) -> None:
        """A person or a stop has taken note of the fault; it comes back at once if its cause is still there."""
        self.fault = None

    def decide(self, now_s: float) -> Run:
        """What the motor is to do from now on."""
        if self.fault is not None:
            self.goal = None
        if self.goal is None or not self._sensing.believable:
            return self._law.rest(now_s)
        match self.goal:
            case AimGoal() if self._missing or self._sensing.angle_deg is None:
                return self._law.rest(now_s)
            case AimGoal(_, tolerance_deg, Path() as path):
                return self._law.follow(now_s, path, tolerance_deg)
            case AimGoal(target_deg, tolerance_deg, _):
                return self._law.approach(now_s, target_deg, tolerance_deg)
            case JogGoal(_, until_s) if until_s is not None and now_s >= until_s:
                self.goal = None
                return self._law.rest(now_s)
            case JogGoal(direction, until_s):
                return self._jog(now_s, direction, until_s)

    def _jog(self, now_s: float, direction: Direction, until_s: float | None) -> Run:
        longest_s = now_s + self._lease_s if until_s is None else min(now_s + self._lease_s, until_s)
        if self._missing or self._sensing.angle_deg is None:
            return Run(direction, longest_s)
        limits = self.settings.limits
        run = self._law.approach(now_s, limits.max_deg if direction > 0 else limits.min_deg, JOG_TOLERANCE_DEG)
        if run.direction is not direction:
            # At the limit, or beyond it: a jog never turns back.
            self.goal = None
            return self._law.rest(now_s)
        return Run(direction, min(run.until_s, longest_s))

    def start_jog(self, direction: Direction, seconds: float | None, now_s: float) -> None:
        if direction is Direction.OFF:
            self.goal = None
            return
        if self._missing:
            seconds = UNCALIBRATED_JOG_S if seconds is None else min(seconds, UNCALIBRATED_JOG_S)
        self.goal = JogGoal(direction, None if seconds is None else now_s + seconds)

    def calibrate_end(self, *, high_end: bool) -> None:
        """The axis stands at an end of its range: take its reading. Raises ValueError where that makes no sense."""
        raw = self._sensing.raw
        if raw is None or not self._sensing.believable:
            raise ValueError("the sensor has no believable reading")
        if self.calibration is not None:
            self._sensing.calibration = self.calibration.with_end(raw, high_end=high_end)
        elif self._first_end is None or self._first_end[0] == high_end:
            self._first_end = (high_end, raw)
            return
        else:
            low_raw, high_raw = (self._first_end[1], raw) if high_end else (raw, self._first_end[1])
            limits = self.settings.limits
            self._sensing.calibration = between_ends(low_raw, limits.min_deg, high_raw, limits.max_deg)
            self._missing = tuple(item for item in self._missing if item != "calibration")
        self._law = SwitchedLaw(self.settings.motor, lease_s=self._lease_s, period_s=self._period_s)

    def status(self, now_s: float, driven: Direction) -> AxisStatus:
        """This axis as others see it; `driven` is what its relays really do."""
        self._law.driven(now_s, driven)
        if driven is not Direction.OFF:
            self._driven_s = now_s
        moving = self._driven_s is not None and now_s - self._driven_s < SETTLED_AFTER_S
        return AxisStatus(
            min_deg=self.settings.limits.min_deg,
            max_deg=self.settings.limits.max_deg,
            angle_deg=self._sensing.angle_deg,
            raw=self._sensing.raw,
            source=self.settings.source,
            target_deg=self.goal.target_deg if isinstance(self.goal, AimGoal) else None,
            drive=driven,
            moving=moving,
            uncalibrated=self.uncalibrated,
            fault=self.fault,
            calibration=self.calibration.points if self.calibration else None,
        )
