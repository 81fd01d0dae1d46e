"""One axis under control whose motor goes to an angle by itself: where it is to be now, and how fast it moves on.

The sibling of `axis`, for a drive that is told places instead of directions. Knows its goal, its limits and its faults.
Knows nothing of the sky, of the other axis, or of who gave the order; and not how the drive gets there: it only sees
whether it does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.goals import JogGoal, jog, limit_reached
from rotator.control.axis.sensing import Condition, Reading, Sensing, Window
from rotator.control.commands import HOLD, Hold, Steer
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path
from rotator.control.sky.pointing import AimGoal
from rotator.status import AxisStatus, Fault

RATE_OVER_S = 0.25
"""The target's rate is looked at over this much of its path, half of it to come."""
STRAY_DEG = 5.0
STRAY_S = 3.0
"""An axis this far from where it was told to be, and not coming nearer for so long, does not follow. One that has to
turn back first, at 20°/s² from 30°/s, takes half of that."""
COMING_DEG = 0.5
STILL_DPS = 0.05


@dataclass(frozen=True, slots=True)
class PositionedSettings:
    axis: Axis
    limits: Range
    tolerance_deg: float
    speed_dps: float
    window: Window
    calibration: Calibration | None
    missing: tuple[str, ...] = ()
    """What a person has still to do before this axis may be aimed; empty: commissioned."""
    source: str = "measured"
    near_deg: float = COMING_DEG
    """Nearer than this to where it was told to be, the drive may leave it."""
    accel_dps2: float | None = None
    """How hard it brakes; None: at once."""


class PositionedAxis:
    def __init__(self, settings: PositionedSettings, *, lease_s: float) -> None:
        self.settings = settings
        self.goal: AimGoal | JogGoal | None = None
        self.fault: Fault | None = None
        self.speed_dps = settings.speed_dps
        self.homed_at_deg: float | None = None
        """Never: it knows where it stands, or a person tells it."""
        self._missing = settings.missing
        self._condition = Condition()
        self._lease_s = lease_s
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration)
        self._present: Fault | None = None
        self._steered: Steer | None = None
        self._steered_s = 0.0
        self._astray: tuple[float, float] | None = None
        """Where it was when it was last seen to come nearer to its place, and when."""

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def uncalibrated(self) -> str:
        return ", ".join(self._missing)

    @property
    def calibration(self) -> Calibration | None:
        return self._sensing.calibration

    @property
    def driven(self) -> bool:
        """Whether it was last told to be somewhere else than where it rests."""
        return self._steered is not None and not self._arrived()

    def see(self, reading: Reading, now_s: float) -> None:
        self._condition = reading.condition
        self._present = self._sensing.take(reading, now_s)
        # The rotor's own words say more than what can be seen of it from here.
        said = reading.condition.fault
        if self.fault and self.fault.passing:
            self.fault = said or self._present
        self.fail(said or self._present or self._straying(now_s))

    def fail(self, fault: Fault | None) -> None:
        """Something is wrong with this axis: it holds until that is acknowledged. The first fault is the one told."""
        if fault is not None and self.fault is None:
            self.fault = fault

    def acknowledge(self) -> None:
        self._astray = None
        said = None if self._condition.latched else self._condition.fault
        self.fault = said or self._present

    def decide(self, now_s: float) -> Steer | Hold:
        """Where the drive is to be from now on: what the goal asks for, as far as it is safe."""
        command = self._wish(now_s)
        if isinstance(command, Steer) and (blocked := self._blocked(command)):
            self.fail(limit_reached(self.settings.axis, blocked))
            self.goal, command = None, HOLD
        self._steered, self._steered_s = (command, now_s) if isinstance(command, Steer) else (None, now_s)
        if self._steered is None:
            self._astray = None
        return command

    def start_jog(self, direction: Direction, seconds: float | None, now_s: float) -> None:
        self.goal = jog(direction, seconds, now_s, set_up=not self._missing)

    def start_homing(self) -> None:
        """Raises ValueError."""
        raise ValueError("this rotor knows where it stands; there is no end stop to be found")

    def calibrate_end(self, *, high_end: bool) -> None:
        """Its scale is the drive's own. Raises ValueError."""
        raise ValueError(f"this rotor knows its own angles; there is no {'upper' if high_end else 'lower'} end to set")

    def moving(self, _now_s: float) -> bool:
        return self.driven

    def status(self, _now_s: float, _driven: Direction) -> AxisStatus:
        limits = self.settings.limits
        return AxisStatus(
            min_deg=limits.min_deg,
            max_deg=limits.max_deg,
            angle_deg=self._sensing.angle_deg,
            raw=self._sensing.raw,
            source=self.settings.source,
            target_deg=self.goal.target_deg if isinstance(self.goal, AimGoal) else None,
            drive=self._direction(),
            moving=self.driven,
            uncalibrated=self.uncalibrated,
            fault=self.fault,
            notices=(self._condition.notice,) if self._condition.notice else (),
        )

    def _wish(self, now_s: float) -> Steer | Hold:
        if self.fault is not None:
            self.goal = None
        if self.goal is None or not self._sensing.believable or self._sensing.angle_deg is None:
            return HOLD
        until_s = now_s + self._lease_s
        match self.goal:
            case AimGoal() if self._missing:
                return HOLD
            case AimGoal(_, _, Path() as path):
                before_deg = path.angle_deg(now_s - RATE_OVER_S / 2)
                rate_dps = (path.angle_deg(now_s + RATE_OVER_S / 2) - before_deg) / RATE_OVER_S
                return self._within(path.angle_deg(now_s), rate_dps, until_s)
            case AimGoal(target_deg, _, _):
                return self._within(target_deg, 0.0, until_s)
            case JogGoal(_, jog_until_s) if jog_until_s is not None and now_s >= jog_until_s:
                self.goal = None
                return HOLD
            case JogGoal(direction, _):
                return self._jog(now_s, direction, until_s)

    def _jog(self, now_s: float, direction: Direction, until_s: float) -> Steer | Hold:
        """On from where it was told to be last, at its own speed, as far as its limit."""
        assert self._sensing.angle_deg is not None
        limits = self.settings.limits
        limit_deg = limits.max_deg if direction > 0 else limits.min_deg
        from_deg = self._sensing.angle_deg
        if self._steered is None and (limit_deg - from_deg) * direction <= self.settings.near_deg:
            self.goal = None
            return HOLD
        # From where it can just brake it is steered to its limit, on and on: to hold is to come to rest further on.
        if self._steered is not None and not self._condition.settling:
            from_deg = self._steered.angle_deg + self._steered.rate_dps * (now_s - self._steered_s)
        if (limit_deg - from_deg) * direction <= self._braking_deg:
            return Steer(limit_deg, 0.0, until_s)
        return self._within(from_deg, self.speed_dps * direction, until_s)

    @property
    def _braking_deg(self) -> float:
        """How far it takes to come to rest from its full speed."""
        accel_dps2 = self.settings.accel_dps2
        return self.speed_dps**2 / (2.0 * accel_dps2) if accel_dps2 else 0.0

    def _within(self, angle_deg: float, rate_dps: float, until_s: float) -> Steer:
        """No further than the limits; at a limit the target moves on alone."""
        kept_deg = self.settings.limits.nearest(angle_deg)
        limits = self.settings.limits
        outward = (kept_deg == limits.max_deg and rate_dps > 0) or (kept_deg == limits.min_deg and rate_dps < 0)
        return Steer(kept_deg, 0.0 if outward or kept_deg != angle_deg else rate_dps, until_s)

    def _blocked(self, command: Steer) -> Direction | None:
        """The way in which it would turn, where a limit switch lets it go no further."""
        assert self._sensing.angle_deg is not None
        ahead_deg = command.angle_deg + command.rate_dps * self._lease_s - self._sensing.angle_deg
        towards = Direction.PLUS if ahead_deg > 0 else Direction.MINUS
        return towards if towards in self._condition.ends and abs(ahead_deg) >= COMING_DEG else None

    def _arrived(self) -> bool:
        steered, angle_deg = self._steered, self._sensing.angle_deg
        if steered is None or angle_deg is None:
            return True
        return abs(steered.angle_deg - angle_deg) < self.settings.near_deg and abs(steered.rate_dps) < STILL_DPS

    def _direction(self) -> Direction:
        if self._steered is None or self._sensing.angle_deg is None or self._arrived():
            return Direction.OFF
        ahead_deg = self._steered.angle_deg - self._sensing.angle_deg
        towards = ahead_deg if abs(ahead_deg) >= self.settings.near_deg else self._steered.rate_dps
        return Direction.PLUS if towards > 0 else Direction.MINUS

    def _straying(self, now_s: float) -> Fault | None:
        """Told to be somewhere, and neither there nor coming nearer. A modelled angle always agrees with its model."""
        steered, angle_deg = self._steered, self._sensing.angle_deg
        if steered is None or angle_deg is None:
            return None
        ahead_deg = steered.angle_deg - angle_deg
        off_deg = abs(ahead_deg)
        coming = self._astray is None or (angle_deg - self._astray[0]) * math.copysign(1, ahead_deg) >= COMING_DEG
        if off_deg < STRAY_DEG or coming or self._condition.settling:
            self._astray = (angle_deg, now_s)
            return None
        assert self._astray is not None
        if now_s - self._astray[1] < STRAY_S:
            return None
        measured = f"stands at {angle_deg:.1f}°, {off_deg:.1f}° from where it was told to be"
        return Fault("axis does not follow", self.settings.axis, measured, f"{STRAY_DEG:g}° for {STRAY_S:g} s")
