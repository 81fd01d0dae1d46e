"""The controller: orders and readings in, what the drives are to do and the status out.

Decides who may move the antenna and where it goes; each axis decides how. Knows both axes, the mount, the authority
over orders, homing, parking and timed lists. Pure: no I/O, no clock, no thread.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from hw.ports import Axis, Direction
from rotator.control.aiming import Aiming
from rotator.control.authority import Authority
from rotator.control.axis.build import build_axis
from rotator.control.axis.motion_watch import LATE_S, late
from rotator.control.axis.sensing import Reading
from rotator.control.commands import Acknowledge, Command, Errand, Place
from rotator.control.fence import Fence
from rotator.control.homing_queue import HomingQueue
from rotator.control.jogs import Jogs
from rotator.control.pass_starts import PassStarts
from rotator.control.refused import Refused
from rotator.control.rights import deed_of
from rotator.control.senders import aims_of
from rotator.control.settings import Settings
from rotator.control.sky.mount import Unreachable
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.timed import TimedList
from rotator.faults import Notice
from rotator.orders import (
    BOTH,
    PAGE,
    TRACKER,
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    Fly,
    GiveBack,
    Home,
    Jog,
    Leave,
    LetGo,
    LoadTimed,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    Remark,
    RunTimed,
    SetMode,
    Source,
    Speed,
    Stop,
    Stream,
    Take,
)
from rotator.status import AxisStatus, Status


class Controller:
    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        axes = {
            each.axis: build_axis(each, lease_s=settings.lease_s, period_s=settings.period_s)
            for each in (settings.azimuth, settings.elevation)
        }
        self._axes = axes
        tolerances_deg = settings.azimuth.tolerance_deg, settings.elevation.tolerance_deg
        self._authority = Authority(settings.mode, max(tolerances_deg), settings.latch)
        self._aiming = Aiming(settings.mount, axes, Pointing(settings.mount, *tolerances_deg, on_sky=settings.on_sky))
        self._homing = HomingQueue(axes)
        self._fence = Fence(settings.mount, axes, period_s=settings.period_s, attended=settings.attended)
        self._timed = TimedList()
        self._jogs = Jogs(axes)
        self._starts = PassStarts()
        self._speed_level = 4
        self._remarks: dict[Axis, tuple[Notice, ...]] = dict.fromkeys(Axis, ())
        """What the panel has to say of each axis."""
        self._moved_s: float | None = None
        """When an order last moved the antenna; None: none has since the start, a park, a stop, or a person's release.
        What a stop or a fault has ended does not begin by itself: an idle antenna parks only after the next order."""
        self._stepped_s: float | None = None
        self.troubles: list[str] = []
        """Why orders were not carried out, for the log; the caller clears it."""
        self.errands: list[Errand] = []
        """What the rotor is to do once; the caller clears it."""

    def step(
        self, now_s: float, readings: Mapping[Axis, Reading], orders: Iterable[tuple[Source, Order]]
    ) -> dict[Axis, Command]:
        """One cycle: take the readings and the orders, and decide what each drive is to do."""
        self._note_lateness(now_s)
        for axis, control in self._axes.items():
            if axis in readings:
                control.see(readings[axis], now_s)
        for source, order in orders:
            self._take(source, order, now_s)
        if any(control.fault for control in self._axes.values()):
            # A list that went on when the fault is acknowledged would start a motor without an order.
            self._timed.halt()
            self._aiming.end_following()
        if (point := self._timed.due(now_s)) is not None:
            self._point_at(Aim(*point), now_s)
        self._home_next(now_s)
        self._park_when_idle(now_s)
        self._aiming.look_ahead(now_s)
        commands: dict[Axis, Command] = {}
        for axis, control in self._axes.items():
            decision = control.decide(now_s)
            commands[axis] = decision.command
            if decision.homed_deg is not None:
                self.errands.append(Place(axis, decision.homed_deg))
        return self._fence.passed(now_s, commands)

    def links_lost(self) -> None:
        """No order arrives from links and consoles, a stop neither: what they ordered ends.

        The panel has a thread of its own, and goes on. So does a storm park: a person wants the antenna down.
        """
        if self._authority.latched or self._authority.mode in (Mode.MANUAL, Mode.JOG):
            return
        self._homing.clear()
        self._halt(BOTH)

    def page_lost(self) -> None:
        """No order arrives from the page, its STOP neither: what a person on the page turns ends. All others go on."""
        by = self._authority.controlled_by
        if by is not None and by.link == PAGE and not self._authority.latched:
            self._homing.clear()
            self._halt(BOTH)

    def note_driven(self, now_s: float, driven: Mapping[Axis, Direction]) -> None:
        """After the cycle: the direction in which each axis's relays are really closed (OFF where it has none)."""
        for axis, control in self._axes.items():
            control.note_driven(now_s, driven[axis])
        self._jogs.note_driven(now_s)
        self._starts.note_driven(now_s, driven)

    def status(self, now_s: float, late_s: float = 0.0) -> Status:
        """The state of the box at this moment. `late_s`: how late the last cycle was."""
        azimuth, elevation = self._aiming.pointed(*(self._axis_status(axis, now_s) for axis in Axis))
        return Status(
            at_s=now_s,
            azimuth=azimuth,
            elevation=elevation,
            wanted_azimuth_deg=self._aiming.wanted.azimuth_deg,
            wanted_elevation_deg=self._aiming.wanted.elevation_deg,
            latched=self._authority.latched,
            storm=self._authority.storm,
            controlled_by=str(self._authority.controlled_by or ""),
            controlled_from=self._authority.controlled_by.host if self._authority.controlled_by else "",
            held_by=str(self._authority.held_by or ""),
            timed_point=self._timed.point,
            timed_points=len(self._timed.points),
            simulated=self._settings.simulated,
            speed_level=self._speed_level,
            mode=self._authority.mode,
            mode_by=self._authority.mode_by,
            mode_switch=self._settings.mode is not Mode.AUTO,
            flown=self._aiming.flown,
            notices=self._authority.ignored(now_s),
            cycle_late_s=late_s,
        )

    def _axis_status(self, axis: Axis, now_s: float) -> AxisStatus:
        more = self._remarks[axis] + self._aiming.notices(axis) + self._fence.notices(axis, now_s)
        starts = self._starts.of(axis) if self._axes[axis].has_relays else None
        return self._axes[axis].status(now_s, starts=starts, more=more)

    def _note_lateness(self, now_s: float) -> None:
        """A motor ran for longer than a cycle unwatched: the guard has opened its relay, and a person should know."""
        gap_s = 0.0 if self._stepped_s is None else now_s - self._stepped_s
        self._stepped_s = now_s
        if gap_s > self._settings.period_s + LATE_S and any(control.driven for control in self._axes.values()):
            for axis, control in self._axes.items():
                control.fail(late(axis, gap_s, self._settings.period_s))

    def _take(self, source: Source, order: Order, now_s: float) -> None:
        deed, homing = deed_of(order), self._homing.holds_back(source)
        match order:
            case Stop(axes, latch):
                self._stop(source, axes, latch=latch, now_s=now_s)
            case Release():
                self._wait_for_order()
                self._authority.released()
                self._acknowledge(now_s, by_person=True)
            case ClearTimed():
                self._timed.clear()
            case Speed(level):
                self._speed_level = level
            case Park(storm=True) | Confirm() | Calibrate() | Take() if deed and not self._authority.allows(
                source, now_s, deed, homing=homing
            ):
                pass
            case Park(storm=True):
                self._homing.clear()
                self._halt(BOTH)
                self._authority.begin_storm(source)
                self._park(now_s)
            case Calibrate(axis, high_end):
                self._calibrate(axis, now_s, high_end=high_end)
            case SetMode() | Take():
                self._hand_over(source, order)
            case GiveBack() | Jog(direction=Direction.OFF, held=True):
                self._let_go(source, order)
            case Nudge(axis, offset_deg):
                self._nudge(axis, offset_deg, now_s)
            case Confirm(axis, angle_deg):
                self._confirm(axis, angle_deg)
            case RelaysChecked(axis):
                self._relays_checked(axis)
            case LetGo():
                self._stop(source, BOTH, latch=True, now_s=now_s)
                self.errands.append(LetGo())
            case Remark(axis, text, lcd):
                self._remarks[axis] = (Notice(text, lcd),) if text else ()
            case Leave():
                # What has an end of its own goes on: a jog with a time, a standing target, a timed list.
                self._jogs.end(source)
                if self._authority.left(source, now_s):
                    self._aiming.end_stream()
            case Fly(stream=Stream()):
                self._fly_for_stream(order, source, now_s)
            case _ if deed and self._authority.may_move(source, now_s, aims_of(order), deed=deed, homing=homing):
                self._move(order, source, now_s)

    def _hand_over(self, source: Source, order: SetMode | Take) -> None:
        """A person says who moves the antenna from now on. It stops, unless that person moves it already."""
        goes_on = order == Take(stops=False) and self._authority.controlled_by in (source, Source(TRACKER))
        if not goes_on:
            self._homing.clear()
            self._halt(BOTH)
            self._moved_s = None
        match order:
            case SetMode(mode):
                self._aiming.clear_nudges()
                self._authority.switch(source, mode)
            case Take():
                self._authority.take(source, stopped=not goes_on)

    def _let_go(self, source: Source, order: GiveBack | Jog) -> None:
        """A person lets go of the antenna, or of the button of a jog."""
        match order:
            case GiveBack():
                self._authority.give_back(source)
            case Jog():
                self._jogs.end(source)

    def _move(self, order: Order, source: Source, now_s: float) -> None:
        self._starts.ordered(now_s)
        if not isinstance(order, RunTimed):
            self._timed.halt()
        if not isinstance(order, Home):
            self._homing.clear()
        match order:
            case Aim() if self._aiming.flies_on(source, order, now_s):
                pass
            case Aim() | Fly():
                self._point_at(order, now_s)
            case Park():
                self._park(now_s)
                return
            case Jog(axis):
                self._aiming.forget((axis,))
                self._jogs.begin(order, source, now_s)
            case Home(axis):
                self._home(axis, source)
            case LoadTimed(interval_s, points):
                self._point_at(Aim(*self._timed.load(interval_s, points)), now_s)
            case RunTimed():
                self._timed.run(now_s)
        if self._timed.running or any(control.busy for control in self._axes.values()):
            self._moved_s = now_s

    def _fly_for_stream(self, order: Fly, source: Source, now_s: float) -> None:
        """What a recognised stream asks for, flown as planned. It takes the antenna from no other sender: the plan took
        a while to compute, and what has happened since stays in force."""
        moves = self._authority.controlled_by == source and not self._timed.running
        if not moves or any(control.fault for control in self._axes.values()):
            return
        try:
            self._aiming.fly_for_stream(order, source, now_s)
        except Unreachable as reason:
            self.troubles.append(str(reason))

    def _point_at(self, order: Aim | Fly, now_s: float) -> None:
        try:
            if isinstance(order, Fly):
                self._aiming.fly(order, now_s)
            else:
                self._aiming.point_at(order, now_s)
        except Unreachable as reason:
            self.troubles.append(str(reason))

    def _nudge(self, axis: Axis, offset_deg: float, now_s: float) -> None:
        """From now on; the order in force moves by as much at once, unless a stop has latched."""
        self._aiming.nudge(axis, offset_deg)
        if self._authority.latched:
            return
        try:
            self._aiming.repeat(now_s)
        except Unreachable as reason:
            self.troubles.append(str(reason))

    def _home(self, axis: Axis, source: Source) -> None:
        try:
            self._homing.ask(axis, source)
        except Refused as reason:
            self.troubles.append(str(reason))

    def _home_next(self, now_s: float) -> None:
        if self._homing.due():
            self._halt(BOTH)
            self._homing.begin()
        if self._homing.active:
            # The time until an idle antenna parks begins when the last axis has been homed.
            self._moved_s = now_s

    def _confirm(self, axis: Axis, angle_deg: float) -> None:
        if not self._axes[axis].confirmable:
            self.troubles.append(f"{axis.value} measures its angle: there is nothing to confirm")
            return
        self._halt((axis,))
        self._axes[axis].confirmed()
        self.errands.append(Place(axis, angle_deg))

    def _park(self, now_s: float) -> None:
        self._timed.halt()
        self._moved_s = None
        try:
            self._aiming.park()
        except Unreachable as reason:
            self.troubles.append(f"the park position cannot be reached: {reason}")

    def _park_when_idle(self, now_s: float) -> None:
        """Long after the last order, where the configuration asks for it; never before a first order."""
        if self._aiming.flown is not None:
            self._moved_s = now_s  # it waits for its target, or follows it
        after_s = self._settings.park_after_s
        held = self._authority.latched or self._authority.mode is Mode.PARK
        if after_s <= 0 or self._moved_s is None or held or self._timed.running:
            return
        if now_s - self._moved_s >= after_s:
            self._park(now_s)

    def _wait_for_order(self) -> None:
        """A person lets the box move again."""
        if self._authority.latched or any(control.fault for control in self._axes.values()):
            self._moved_s = None

    def _stop(self, source: Source, axes: tuple[Axis, ...], *, latch: bool, now_s: float) -> None:
        self._homing.clear()
        self._moved_s = None
        self._halt(BOTH if self._authority.storm else axes)
        self._authority.stopped_axis(source, now_s)
        if len(axes) == len(self._axes):
            self._authority.stopped(source, now_s, latch=latch)
            if not latch and not self._authority.latched:
                self._acknowledge(now_s, by_person=False)

    def _halt(self, axes: tuple[Axis, ...]) -> None:
        self._timed.halt()
        self._aiming.halt(axes)

    def _acknowledge(self, now_s: float, *, by_person: bool) -> None:
        if any(control.fault for control in self._axes.values()):
            # The order that was in force when the fault came is not taken up again.
            self._aiming.drop()
        for axis, control in self._axes.items():
            if control.acknowledge(now_s, by_person=by_person):
                self.errands.append(Acknowledge(axis))

    def _calibrate(self, axis: Axis, now_s: float, *, high_end: bool) -> None:
        if any(control.moving(now_s) for control in self._axes.values()):
            self.troubles.append(f"{axis.value} is not calibrated while the antenna moves")
            return
        try:
            self._axes[axis].calibrate_end(high_end=high_end)
        except Refused as reason:
            self.troubles.append(str(reason))
        if self._axes[axis].has_relays:
            self._axes[axis].halt()
            self._aiming.forget((axis,))

    def _relays_checked(self, axis: Axis) -> None:
        try:
            self._axes[axis].checked()
        except Refused as reason:
            self.troubles.append(str(reason))
