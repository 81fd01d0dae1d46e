"""The controller: orders and readings in, what the drives are to do and the status out.

Knows both axes, the mount, who may move what, and timed lists. Pure: no I/O, no clock, no thread; the same inputs give
the same outputs, so an hour at the mast is a second in a test.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from hw.ports import Axis, Direction
from rotator.control.authority import Authority
from rotator.control.axis.goals import HomeGoal
from rotator.control.axis.motion_watch import LATE_S, late
from rotator.control.axis.positioned import PositionedAxis, PositionedSettings
from rotator.control.axis.sensing import Reading
from rotator.control.axis.switched import AxisControl, AxisSettings
from rotator.control.commands import Acknowledge, Command, Errand, Place
from rotator.control.sky.mount import Mount, Unreachable
from rotator.control.sky.nudges import Nudges
from rotator.control.sky.pointing import AimGoal, Goals, Pointing
from rotator.control.sky.route import Speeds
from rotator.control.sky.timed import TimedList
from rotator.orders import (
    BOTH,
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    Home,
    Jog,
    LetGo,
    LoadTimed,
    Mode,
    Nudge,
    Order,
    Park,
    Release,
    RunTimed,
    SetMode,
    Source,
    Speed,
    Stop,
)
from rotator.status import Status


@dataclass(frozen=True, slots=True)
class Settings:
    azimuth: AxisSettings | PositionedSettings
    elevation: AxisSettings | PositionedSettings
    mount: Mount
    period_s: float = 0.05
    lease_s: float = 0.25
    """How long a drive command lives unless renewed: what a hung bus can cost at most."""
    simulated: bool = False
    park_after_s: float = 0.0
    """Park when nobody has moved the antenna for so long; 0: never."""
    mode: Mode = Mode.AUTO
    """Until a front panel says otherwise; with a mode switch whose position is not known yet, nobody moves anything."""


class Controller:
    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._axes = {
            each.axis: _controlled(each, lease_s=settings.lease_s, period_s=settings.period_s)
            for each in (settings.azimuth, settings.elevation)
        }
        self._to_home: deque[Axis] = deque()
        """Axes that wait until another has been homed."""
        self._homed_by: Source | None = None
        """Who has asked for the homing that is going on: nobody else may move anything meanwhile."""
        self._nudges = Nudges()
        self._asked: Aim | None = None
        """What was last asked for, without the nudges; None: nothing is."""
        self._authority = Authority(settings.mode)
        self._timed = TimedList()
        self._pointing = Pointing(settings.mount, settings.azimuth.tolerance_deg, settings.elevation.tolerance_deg)
        self._speed_level = 4
        self._moved_s: float | None = None
        """When somebody last moved the antenna; None: nobody has, or it is parked."""
        self._stepped_s: float | None = None
        self.troubles: list[str] = []
        """What went wrong with orders since the last look, for the log."""
        self.errands: list[Errand] = []
        """What the rotor is to do, since the last look."""

    def step(
        self, now_s: float, readings: Mapping[Axis, Reading], orders: Iterable[tuple[Source, Order]]
    ) -> dict[Axis, Command]:
        """One cycle: note the readings, take the orders, say what each drive is to do."""
        self._note_lateness(now_s)
        for axis, control in self._axes.items():
            if axis in readings:
                control.see(readings[axis], now_s)
        for source, order in orders:
            self._take(source, order, now_s)
        point = self._timed.due(now_s)
        if point is not None:
            self._point_at(Aim(*point), now_s)
        self._park_when_idle(now_s)
        self._home_next()
        self._look_ahead(now_s)
        commands: dict[Axis, Command] = {axis: control.decide(now_s) for axis, control in self._axes.items()}
        for axis, control in self._axes.items():
            if control.homed_at_deg is not None:
                self.errands.append(Place(axis, control.homed_at_deg))
                control.homed_at_deg = None
        return commands

    def status(self, now_s: float, driven: Mapping[Axis, Direction], late_s: float = 0.0) -> Status:
        """Note what the drives really do after this cycle, and tell the status."""
        source = self._authority.controlled_by
        return Status(
            at_s=now_s,
            azimuth=self._axes[Axis.AZIMUTH].status(now_s, driven[Axis.AZIMUTH]),
            elevation=self._axes[Axis.ELEVATION].status(now_s, driven[Axis.ELEVATION]),
            wanted_azimuth_deg=self._pointing.wanted.azimuth_deg,
            wanted_elevation_deg=self._pointing.wanted.elevation_deg,
            latched=self._authority.latched,
            controlled_by=str(source) if source else "",
            timed_point=self._timed.point,
            timed_points=len(self._timed.points),
            simulated=self._settings.simulated,
            speed_level=self._speed_level,
            mode=self._authority.mode,
            cycle_late_s=late_s,
        )

    def _note_lateness(self, now_s: float) -> None:
        """A motor ran, and nobody looked: the guard has opened its relay, and a person should know why."""
        gap_s = 0.0 if self._stepped_s is None else now_s - self._stepped_s
        self._stepped_s = now_s
        if gap_s > self._settings.period_s + LATE_S and any(control.driven for control in self._axes.values()):
            for axis, control in self._axes.items():
                control.fail(late(axis, gap_s, self._settings.period_s))

    def _take(self, source: Source, order: Order, now_s: float) -> None:
        match order:
            case Stop(axes, latch):
                self._stop(source, axes, latch=latch, now_s=now_s)
            case Release():
                self._authority.released()
                self._acknowledge()
            case ClearTimed():
                self._timed.clear()
            case Speed(level):
                self._speed_level = level
            case Park(storm=True):
                self._authority.take(source, "storm park")
                self._park(now_s)
            case Calibrate(axis, high_end):
                self._calibrate(axis, now_s, high_end=high_end)
            case SetMode(mode):
                self._to_home.clear()
                self._halt(BOTH)
                self._nudges.clear()
                self._authority.switch(source, mode)
            case Nudge(axis, offset_deg):
                self._nudge(axis, offset_deg, now_s)
            case Confirm(axis, angle_deg):
                self._confirm(axis, angle_deg)
            case LetGo():
                self._stop(source, BOTH, latch=True, now_s=now_s)
                self.errands.append(LetGo())
            case _ if self._homing and source != self._homed_by:
                pass
            case _ if self._authority.may_move(source, now_s):
                self._move(order, source, now_s)

    @property
    def _homing(self) -> bool:
        return bool(self._to_home) or any(isinstance(control.goal, HomeGoal) for control in self._axes.values())

    def _move(self, order: Order, source: Source, now_s: float) -> None:
        self._timed.halt()
        self._moved_s = now_s
        match order:
            case Aim():
                self._point_at(order, now_s)
            case Park():
                self._park(now_s)
            case Jog(axis, direction, seconds):
                self._forget((axis,))
                self._axes[axis].start_jog(direction, seconds, now_s)
            case Home(axis):
                self._homed_by = source
                self._to_home.append(axis)
            case LoadTimed(interval_s, points):
                self._point_at(Aim(*self._timed.load(interval_s, points)), now_s)
            case RunTimed():
                self._timed.run(now_s)

    def _nudge(self, axis: Axis, offset_deg: float, now_s: float) -> None:
        """From now on; and what is asked for already moves by as much, as long as somebody still wants it."""
        self._nudges.set(axis, offset_deg)
        if self._asked is not None and self._asked.engaged and not self._authority.latched:
            self._point_at(self._asked, now_s)

    def _home_next(self) -> None:
        """One axis after another, so that a person can watch."""
        if not self._to_home or any(isinstance(control.goal, HomeGoal) for control in self._axes.values()):
            return
        axis = self._to_home.popleft()
        self._halt(BOTH)
        try:
            self._axes[axis].start_homing()
        except ValueError as reason:
            self.troubles.append(f"{axis.value} is not homed: {reason}")

    def _confirm(self, axis: Axis, angle_deg: float) -> None:
        self._axes[axis].goal = None
        self._forget((axis,))
        self.errands.append(Place(axis, angle_deg))

    def _park(self, now_s: float) -> None:
        self._timed.halt()
        self._moved_s = None
        mount = self._settings.mount
        # A place on the rotor's own scale, not a direction: the overlap's other turn would wind the cables.
        self._forget(BOTH)
        park = Aim(mount.park_azimuth_deg, mount.park_elevation_deg)
        try:
            self._set_goals(self._pointing.aim(now_s, park, mount.park_azimuth_deg, mount.park_elevation_deg))
        except Unreachable as reason:
            self.troubles.append(f"the park position cannot be reached: {reason}")

    def _park_when_idle(self, now_s: float) -> None:
        """Long after the last order, where that is asked for; never before a first order, nor against a latch."""
        after_s = self._settings.park_after_s
        if after_s <= 0 or self._moved_s is None or self._authority.latched or self._timed.running:
            return
        if now_s - self._moved_s >= after_s:
            self._park(now_s)

    def _stop(self, source: Source, axes: tuple[Axis, ...], *, latch: bool, now_s: float) -> None:
        self._to_home.clear()
        self._halt(axes)
        if len(axes) == len(self._axes):
            self._authority.stopped(source, now_s, latch=latch)
            if not latch and not self._authority.latched:
                self._acknowledge()

    def _halt(self, axes: tuple[Axis, ...]) -> None:
        self._timed.halt()
        for axis in axes:
            self._axes[axis].goal = None
        self._forget(axes)

    def _forget(self, axes: tuple[Axis, ...]) -> None:
        """Nothing is asked of these axes any more; without both there is no path, so the other stays where it is."""
        self._asked = None
        self._pointing.forget(azimuth=Axis.AZIMUTH in axes, elevation=Axis.ELEVATION in axes)
        for control in self._axes.values():
            if isinstance(control.goal, AimGoal) and control.goal.path is not None:
                control.goal = replace(control.goal, path=None)

    def _acknowledge(self) -> None:
        if any(control.fault for control in self._axes.values()):
            # What was on its way when it failed is not taken up again.
            self._asked = None
        for axis, control in self._axes.items():
            control.acknowledge()
            self.errands.append(Acknowledge(axis))

    def _point_at(self, asked: Aim, now_s: float) -> None:
        aim = self._nudges.applied(asked)
        azimuth, elevation = self._axes[Axis.AZIMUTH], self._axes[Axis.ELEVATION]
        if not aim.engaged:
            azimuth.goal = elevation.goal = None
            self._asked = None
            self._pointing.show(aim)
            return
        if aim.azimuth_deg is None:
            if aim.elevation_deg is not None:
                self._forget((Axis.ELEVATION,))
                elevation.goal = self._pointing.raise_to(aim.elevation_deg, azimuth.angle_deg or 0.0)
                self._asked = asked
            return
        stands_deg = self._settings.mount.azimuth.min_deg if azimuth.angle_deg is None else azimuth.angle_deg
        try:
            goals = self._pointing.aim(now_s, aim, stands_deg, elevation.angle_deg or 0.0)
        except Unreachable as reason:
            self.troubles.append(str(reason))
            return
        self._asked = asked
        self._set_goals(goals)

    def _look_ahead(self, now_s: float) -> None:
        """Keep the goals up with a target that moves, on the axes that still aim at it."""
        azimuth, elevation = self._axes[Axis.AZIMUTH], self._axes[Axis.ELEVATION]
        aiming = [control.goal for control in (azimuth, elevation) if isinstance(control.goal, AimGoal)]
        if not aiming:
            return
        speeds = Speeds(azimuth.speed_dps, elevation.speed_dps)
        goals = self._pointing.look_ahead(now_s, speeds, had_path=any(goal.path is not None for goal in aiming))
        if goals is None:
            return
        for control, goal in zip((azimuth, elevation), goals, strict=True):
            if goal is not None and isinstance(control.goal, AimGoal):
                control.goal = goal

    def _set_goals(self, goals: Goals) -> None:
        azimuth_goal, elevation_goal = goals
        self._axes[Axis.AZIMUTH].goal = azimuth_goal
        if elevation_goal is not None:
            self._axes[Axis.ELEVATION].goal = elevation_goal

    def _calibrate(self, axis: Axis, now_s: float, *, high_end: bool) -> None:
        if any(control.moving(now_s) for control in self._axes.values()):
            self.troubles.append(f"{axis.value} is not calibrated while the antenna moves")
            return
        self._axes[axis].goal = None
        self._forget((axis,))
        try:
            self._axes[axis].calibrate_end(high_end=high_end)
        except ValueError as reason:
            self.troubles.append(f"{axis.value} keeps its calibration: {reason}")


def _controlled(
    settings: AxisSettings | PositionedSettings, *, lease_s: float, period_s: float
) -> AxisControl | PositionedAxis:
    match settings:
        case AxisSettings():
            return AxisControl(settings, lease_s=lease_s, period_s=period_s)
        case PositionedSettings():
            return PositionedAxis(settings, lease_s=lease_s)
