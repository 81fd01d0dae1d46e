"""What both kinds of axis share: the goal, the sensor of the angle, and most of the status.

Knows the goal and the readings. Does not know how the motor is driven: `switched` and `positioned` do.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import Generic, TypeVar

from hw.ports import Direction
from rotator.control.axis.calibration_table import EndCalibration
from rotator.control.axis.goals import HomeGoal, JogGoal, SeekGoal, jog
from rotator.control.axis.readings import NORMAL, Reading
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import PositionedSettings, SwitchedSettings
from rotator.control.axis.trend import SeenTurning
from rotator.control.sky.angles import FULL_TURN_DEG
from rotator.control.sky.goal import AimGoal
from rotator.exchange.faults import Fault, Missing, Notice
from rotator.exchange.motor import ALL_OPEN, Motor, Tries, Trusts
from rotator.exchange.status import AxisStatus

Settings = TypeVar("Settings", bound=SwitchedSettings | PositionedSettings)


class AxisBase(ABC, Generic[Settings]):
    """The shared half of a `ControlledAxis`. `fastest_dps`: no reading moves faster; infinite: it may jump."""

    def __init__(self, settings: Settings, fastest_dps: float) -> None:
        self._settings = settings
        self._goal: AimGoal | JogGoal | HomeGoal | SeekGoal | None = None
        self._ordered: AimGoal | None = None
        """The target last ordered. A fault ends the goal, but not this: only a person or an order does."""
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration, fastest_dps)
        self._ends = EndCalibration(settings.limits, settings.missing, settings.calibration)
        self._condition = NORMAL
        """What the rotor reported with the latest reading."""
        self._seen_turning = SeenTurning()

    @property
    @abstractmethod
    def fault(self) -> Fault | None: ...

    @property
    @abstractmethod
    def confirmable(self) -> bool: ...

    @abstractmethod
    def moving(self, now_s: float) -> bool: ...

    @property
    def pressed_in_vain(self) -> bool:
        return False

    @property
    def has_relays(self) -> bool:
        return False

    @property
    def turns_when_fed(self) -> bool:
        return False

    @property
    def homeable(self) -> bool:
        return False

    @property
    def waits(self) -> bool:
        return False

    @property
    def missing(self) -> tuple[Missing, ...]:
        return (*self._ends.missing, Missing.HOMING) if self._condition.lost else self._ends.missing

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def aiming(self) -> AimGoal | None:
        goal = self._goal.then if isinstance(self._goal, HomeGoal) else self._goal
        return goal if isinstance(goal, AimGoal) else None

    @property
    def busy(self) -> bool:
        return self._goal is not None

    @property
    def jog_is_held(self) -> bool:
        return isinstance(self._goal, JogGoal) and (self._goal.held or self._goal.until_s is None)

    @property
    def homing(self) -> bool:
        return isinstance(self._goal, HomeGoal)

    def aim(self, goal: AimGoal) -> None:
        self._ordered = goal
        self._go_to(goal)

    def _go_to(self, goal: AimGoal) -> None:
        """An axis on its way to its end stop goes there first, where that way is for a target."""
        now = self._goal
        self._goal = replace(now, then=goal) if isinstance(now, HomeGoal) and now.then else goal

    def nudged(self) -> None:
        """A drive that takes an angle goes there anyway."""

    def limit_speed(self, level: int) -> None:
        """Its drive has its own speed."""

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        self._goal, self._ordered = jog(direction, seconds, now_s, commissioned=not self.missing, held=held), None

    def halt(self) -> None:
        self._goal = self._ordered = None

    def forget_path(self) -> None:
        if self.aiming:
            self._go_to(self.aiming.standing())

    def confirmed(self) -> None:
        self._sensing.begin_anew(self._sensing.calibration)

    def _sense(self, reading: Reading, now_s: float, noise_deg: float) -> Fault | None:
        """Take the latest reading. Returns the fault of the sensor that it shows, if any."""
        self._condition = reading.condition
        unbelievable = self._sensing.take(reading, now_s, noise_deg)
        self._seen_turning.note(now_s, self._sensing.angle_deg)
        return unbelievable

    def _status(
        self,
        now_s: float,
        starts: int | None,
        *,
        drive: Direction,
        noise_deg: float,
        notices: tuple[Notice, ...],
        tries: Tries,
        calibration: tuple[tuple[float, float], ...] | None = None,
        learnt: tuple[Motor, Motor] | None = None,
        trusts: Trusts = ALL_OPEN,
        waiting: bool = False,
        error_deg: float | None = None,
        fault_present: bool = False,
    ) -> AxisStatus:
        """The status of the axis. The defaults are those of a drive without relays."""
        sensing, limits, aiming = self._sensing, self._settings.limits.shown, self.aiming
        seen = now_s <= sensing.ridden_until_s
        return AxisStatus(
            min_deg=limits.min_deg,
            max_deg=limits.max_deg,
            angle_deg=self._shown_deg(sensing.angle_deg),
            seen=seen,
            raw=sensing.raw,
            source=self._settings.source,
            target_deg=self._shown_deg(aiming.target_deg if aiming else None),
            missed_deg=self._shown_deg(self._ordered.target_deg if self._ordered and not aiming else None),
            tolerance_deg=aiming.tolerance_deg if aiming else None,
            drive=drive,
            moving=self.moving(now_s),
            by_itself_dps=self._seen_turning.speed_dps(noise_deg) if seen else 0.0,
            starts=starts,
            missing=self.missing,
            lost=self._condition.lost,
            confirmable=self.confirmable,
            calibration=calibration,
            fault=self.fault,
            fault_present=fault_present,
            homeable=self.homeable,
            homing=self.homing,
            notices=notices,
            noise_deg=noise_deg,
            learnt=learnt,
            trusts=trusts,
            tries=tries,
            waiting=waiting,
            error_deg=error_deg,
            endless=self._settings.limits.endless,
        )

    def _shown_deg(self, angle_deg: float | None) -> float | None:
        return angle_deg % FULL_TURN_DEG if angle_deg is not None and self._settings.limits.endless else angle_deg
