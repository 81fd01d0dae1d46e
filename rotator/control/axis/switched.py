"""One axis under control: what it is to do, whether its sensor can be believed, what to tell its motor.

Knows its goal, its limits and its faults. Knows nothing of the sky, of the other axis, or of who gave the order.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration, between_ends
from rotator.control.axis.endurance import Endurance
from rotator.control.axis.goals import HomeGoal, JogGoal, jog, limit_reached
from rotator.control.axis.homing import Homing, HomingSettings
from rotator.control.axis.motion import Motor
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.axis.run_watch import RunWatch
from rotator.control.axis.sensing import Condition, Reading, Sensing, Window
from rotator.control.axis.switched_law import SwitchedLaw
from rotator.control.commands import Run
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path
from rotator.control.sky.pointing import AimGoal
from rotator.status import AxisStatus, Fault, LearntMotor

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
    learnt: tuple[Motor, Motor] | None = None
    """What an earlier run has learnt of the motor, clockwise or up and back: it begins with that."""
    longest_run_s: float = 0.0
    rest_s: float = 0.0
    """What the motor stands in one go, and how long it then takes to cool; zero: any."""
    master: bool = False
    """Whether an output switches the motors' supply."""
    homing: HomingSettings | None = None
    """How to find its end stop, where it counts; None: it needs not."""


class AxisControl:
    def __init__(self, settings: AxisSettings, *, lease_s: float, period_s: float) -> None:
        self.settings = settings
        self.goal: AimGoal | JogGoal | HomeGoal | None = None
        self.fault: Fault | None = None
        self.homed_at_deg: float | None = None
        """It has found its end stop and stands there; whoever has told the rotor sets it to None."""
        self._missing = settings.missing
        self._condition: Condition | None = None
        self._lease_s = lease_s
        self._period_s = period_s
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration)
        self._law = SwitchedLaw(settings.motor, lease_s=lease_s, period_s=period_s)
        if settings.learnt is not None:
            self._law.motion.motors.update(zip((Direction.PLUS, Direction.MINUS), settings.learnt, strict=True))
        self._watch = self._new_watch()
        self._endurance = Endurance(settings.longest_run_s, settings.rest_s)
        self._astray: Fault | None = None
        self._present: Fault | None = None
        """What is wrong at this moment, told before or not."""
        self._driven = Direction.OFF
        self._taught = dict(self._law.motion.motors)
        """What was known of the motor before its last run."""
        self._seen_s: float | None = None
        self._driven_s: float | None = None
        self._first_end: tuple[bool, float] | None = None

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def speed_dps(self) -> float:
        """How fast the motor is, as learnt: the slower direction."""
        return min(motor.speed_dps for motor in self._law.motion.motors.values())

    @property
    def uncalibrated(self) -> str:
        """What is missing before this axis may be aimed; empty: nothing."""
        lost = self._condition.lost if self._condition else ""
        return ", ".join((*self._missing, *((lost,) if lost else ())))

    @property
    def calibration(self) -> Calibration | None:
        return self._sensing.calibration

    @property
    def driven(self) -> bool:
        """Whether its relays were closed when last heard of."""
        return self._driven is not Direction.OFF

    def see(self, reading: Reading, now_s: float) -> None:
        """Take the latest reading; the same one again is no news but may have grown too old."""
        lost = self._note(reading.condition)
        unbelievable = self._sensing.take(reading, now_s)
        homing = isinstance(self.goal, HomeGoal)
        if self._sensing.believable and reading.at_s != self._seen_s and self._sensing.angle_deg is not None:
            self._law.see(reading.at_s, self._sensing.angle_deg)
            self._seen_s = reading.at_s
            seen = self._watch.see(reading.at_s, self._sensing.angle_deg, reading.condition.changes)
            self._astray = None if homing else seen
        self._present = unbelievable or self._astray
        # The rotor's own words say more than what can be seen of it from here.
        said = None if homing else reading.condition.fault
        if self.fault and self.fault.passing:
            self.fault = said or self._present
        self.fail(said or self._present or lost)

    def _note(self, condition: Condition) -> Fault | None:
        """What has become of the rotor since the last reading; a count that has just been lost is a fault, once."""
        before, self._condition = self._condition, condition
        if before is None:
            return None
        if condition.scale != before.scale:
            self._begin_anew()
        if condition.lost and not before.lost and not isinstance(self.goal, HomeGoal):
            return Fault("count lost", self.settings.axis, condition.lost)
        return None

    def fail(self, fault: Fault | None) -> None:
        """Something is wrong with this axis: it stops until that is acknowledged. The first fault is the one told, but
        one that only cutting the supply ends comes before any other."""
        if fault is None or (self.fault is not None and (self.fault.cut or not fault.cut)):
            return
        self.fault = fault
        self._law.motion.forget_run()
        self._law.motion.motors.update(self._taught)

    def acknowledge(self) -> None:
        """A person or a stop has taken note of the fault; while its cause is there it stays."""
        said = self._condition.fault if self._condition and not self._condition.latched else None
        self.fault = said or self._present
        self._watch.acknowledge()

    def decide(self, now_s: float) -> Run:
        """What the motor is to do from now on: what the goal asks for, as far as it is safe."""
        run = self._wish(now_s)
        if run.direction is Direction.OFF:
            return run
        self.fail(self._watch.accuse(run.direction))
        if self._condition and run.direction in self._condition.ends:
            self.fail(limit_reached(self.settings.axis, run.direction))
        if self.fault is not None or self._endurance.resting or self._beyond(run.direction):
            return self._law.rest(now_s)
        return Run(Direction.OFF, now_s) if self._watch.forbids(run.direction) else run

    def _beyond(self, direction: Direction) -> bool:
        """Whether the axis stands at its limit that way or past it, whatever the law takes it for."""
        if self.uncalibrated or self._sensing.angle_deg is None or isinstance(self.goal, HomeGoal):
            return False
        limits, angle_deg = self.settings.limits, self._sensing.angle_deg
        return angle_deg >= limits.max_deg if direction > 0 else angle_deg <= limits.min_deg

    def _wish(self, now_s: float) -> Run:
        if self.fault is not None:
            self.goal = None
        if self.goal is None or not self._sensing.believable:
            return self._law.rest(now_s)
        match self.goal:
            case HomeGoal(homing):
                return self._home(now_s, homing)
            case AimGoal() if self.uncalibrated or self._sensing.angle_deg is None:
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
        if self.uncalibrated or self._sensing.angle_deg is None:
            return Run(direction, longest_s)
        limits = self.settings.limits
        limit_deg = limits.max_deg if direction > 0 else limits.min_deg
        if (limit_deg - self._sensing.angle_deg) * direction <= JOG_TOLERANCE_DEG:
            self.goal = None
            return self._law.rest(now_s)
        run = self._law.approach(now_s, limit_deg, JOG_TOLERANCE_DEG)
        # A jog never turns back: what the law would do the other way is rest, from a motor still to be reversed too.
        return Run(direction, min(run.until_s, longest_s)) if run.direction is direction else self._law.rest(now_s)

    def start_jog(self, direction: Direction, seconds: float | None, now_s: float) -> None:
        self.goal = jog(direction, seconds, now_s, set_up=not self.uncalibrated)

    def start_homing(self) -> None:
        """Raises ValueError where there is nothing to be found."""
        if self.settings.homing is None:
            raise ValueError("this rotor knows where it stands; there is no end stop to be found")
        self.goal = HomeGoal(Homing(self.settings.homing))

    def _home(self, now_s: float, homing: Homing) -> Run:
        assert self._condition is not None
        direction = homing.step(now_s, self._driven, self._condition.changes)
        if homing.homed:
            self.goal, self.homed_at_deg = None, homing.home_deg
        elif homing.failure:
            self.goal = None
            self.fail(Fault("not homed", self.settings.axis, homing.failure))
        return Run(direction, now_s + self._lease_s) if direction else self._law.rest(now_s)

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
        self._begin_anew()

    def _begin_anew(self) -> None:
        """Its readings mean other places than before."""
        motors = self._law.motion.motors
        self._law = SwitchedLaw(self.settings.motor, lease_s=self._lease_s, period_s=self._period_s)
        if self.settings.homing is not None:
            self._law.motion.motors.update(motors)
        self._watch = self._new_watch()

    def moving(self, now_s: float) -> bool:
        """Driven, or off for so short a while that it may still coast."""
        return self._driven_s is not None and now_s - self._driven_s < SETTLED_AFTER_S

    def status(self, now_s: float, driven: Direction) -> AxisStatus:
        """This axis as others see it; `driven` is what its relays really do."""
        if driven is not Direction.OFF and self._driven is Direction.OFF:
            self._taught = dict(self._law.motion.motors)
        self._driven = driven
        self._law.driven(now_s, driven)
        self._watch.driven(now_s, driven)
        self._endurance.note(now_s, running=self.driven)
        if driven is not Direction.OFF:
            self._driven_s = now_s
        return AxisStatus(
            min_deg=self.settings.limits.min_deg,
            max_deg=self.settings.limits.max_deg,
            angle_deg=self._sensing.angle_deg,
            raw=self._sensing.raw,
            source=self.settings.source,
            target_deg=self.goal.target_deg if isinstance(self.goal, AimGoal) else None,
            drive=driven,
            moving=self.moving(now_s),
            uncalibrated=self.uncalibrated,
            fault=self.fault,
            homing=isinstance(self.goal, HomeGoal),
            notices=self._notices(),
            calibration=self.calibration.points if self.calibration else None,
            learnt=self._learnt(),
        )

    def _notices(self) -> tuple[str, ...]:
        blind = "blind to a broken pot wire: without end resistors it looks like an angle"
        hot = self._endurance.notice
        said = self._condition.notice if self._condition else ""
        return (
            *self._watch.notices,
            *((said,) if said else ()),
            *((hot,) if hot else ()),
            *((blind,) if self.settings.window.blind else ()),
        )

    def _new_watch(self) -> MotionWatch | RunWatch:
        settings, motors = self.settings, self._law.motion.motors
        if settings.source == "counted":
            assert settings.homing is not None
            quiet_s = settings.homing.coast_s + settings.homing.period_s
            return RunWatch(settings.axis, settings.limits, motors, quiet_s)
        return MotionWatch(settings.axis, settings.limits, motors, master=settings.master)

    def _learnt(self) -> tuple[LearntMotor, LearntMotor]:
        motors = self._law.motion.motors
        plus, minus = motors[Direction.PLUS], motors[Direction.MINUS]
        return LearntMotor(plus.speed_dps, plus.coast_deg), LearntMotor(minus.speed_dps, minus.coast_deg)
