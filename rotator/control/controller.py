"""The controller: orders and readings in, what the drives are to do and the status out.

Decides who may move the antenna and what each order does; each axis decides how. Knows both axes, the authority over
orders, the movements that were ordered, and the fence. Pure: no I/O, no clock, no thread.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.control.authority import Authority
from rotator.control.axis.absent import AbsentAxis
from rotator.control.axis.build import build_axis
from rotator.control.axis.readings import Reading
from rotator.control.both_axes import kept_off, with_boom
from rotator.control.commands import Acknowledge, Command, Errand, Place, Run, Turns
from rotator.control.cycles import Cycles, PassStarts
from rotator.control.fence import Fence
from rotator.control.movements import Movements
from rotator.control.refused import Refused
from rotator.control.rights import deed_of
from rotator.control.senders import aims_of
from rotator.control.settings import Settings
from rotator.control.sky.angles import FULL_TURN_DEG
from rotator.exchange.faults import Notice
from rotator.exchange.flight_order import Fly, Stream, TakeTurn
from rotator.exchange.orders import (
    BOTH,
    Calibrate,
    ClearTimed,
    Confirm,
    GiveBack,
    Jog,
    Leave,
    LetGo,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    Remark,
    SetMode,
    Speed,
    Stop,
    Take,
    Unheeded,
)
from rotator.exchange.sources import PAGE, PANEL, TRACKER, Source
from rotator.exchange.status import AxisStatus, Status


class Controller:
    """Call `step` in every cycle, and `note_driven` after the drives have obeyed. Moments are seconds on one clock."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        axes = {
            each.axis: build_axis(each, lease_s=settings.lease_s, period_s=settings.period_s)
            for each in (settings.azimuth, settings.elevation)
        }
        self._axes = axes
        self._fitted = {axis: each for axis, each in axes.items() if not isinstance(each, AbsentAxis)}
        agree_deg = max(settings.azimuth.tolerance_deg, settings.elevation.tolerance_deg)
        self._authority = Authority(settings.mode, agree_deg, settings.latch, attended=settings.attended)
        self._movements = Movements(settings, axes)
        self._fence = Fence(settings.mount, axes, period_s=settings.period_s, attended=settings.attended)
        self._starts = PassStarts()
        self._cycles = Cycles(settings.period_s)
        self._speed_level = 4
        self._remarks: dict[Axis, tuple[Notice, ...]] = dict.fromkeys(Axis, ())
        """What the panel has to say of each axis."""
        self.troubles: list[str] = []
        """Why orders were not carried out, for the log; the caller clears it."""
        self.errands: list[Errand] = []
        """What the rotor is to do once; the caller clears it."""

    def step(
        self, now_s: float, readings: Mapping[Axis, Reading], orders: Iterable[tuple[Source, Order]]
    ) -> dict[Axis, Command]:
        """One cycle: take the readings and the orders, and decide what each drive is to do."""
        for fault in self._cycles.begin(now_s, running=self._running):
            self._axes[fault.axis].fail(fault)
        for axis, control in self._fitted.items():
            if axis in readings:
                control.see(readings[axis], now_s)
        for source, order in orders:
            try:
                self._take(source, order, now_s)
            except Refused as reason:
                self.troubles.append(str(reason))
        try:
            self._movements.after_faults(storm=self._authority.storm)
            self._movements.go_on(now_s, may_park=self._authority.moves_by_itself)
        except Refused as reason:
            self.troubles.append(str(reason))
        self._movements.look_ahead(now_s)
        commands: dict[Axis, Command] = {}
        for axis, control in self._fitted.items():
            decision = control.decide(now_s)
            commands[axis] = decision.command
            if decision.homed_deg is not None:
                self.errands.append(Place(axis, decision.homed_deg))
            if decision.turns:
                self.errands.append(Turns(axis))
        commands = self._fence.passed(now_s, commands)
        for fault in kept_off(self._axes, commands):
            self._axes[fault.axis].fail(fault)
            commands[fault.axis] = Run(Direction.OFF, now_s)
        return commands

    def links_lost(self) -> None:
        """Links and consoles cannot send a stop now: what they ordered ends; so does what the broker or the tracker
        ordered. What the page or the panel ordered last goes on, for each has a thread of its own, and its STOP works.
        A storm park goes on too: a person wants the antenna down."""
        by = self._authority.controlled_by
        if not self._authority.latched and (by is None or by.link not in (PAGE, PANEL)):
            self._movements.stop(BOTH)

    def page_lost(self) -> None:
        """The page cannot send STOP now: motion that was ordered on the page ends. Other motion goes on."""
        if not self._authority.latched and self._authority.moved_by_page:
            self._movements.stop(BOTH)

    def note_driven(self, now_s: float, driven: Mapping[Axis, Direction]) -> None:
        """After the cycle: the direction in which each axis's relays are really closed (OFF where it has none)."""
        for fault in self._cycles.end(now_s, running=self._running):
            self._axes[fault.axis].fail(fault)
        for axis, control in self._fitted.items():
            control.note_driven(now_s, driven[axis])
        self._movements.note_driven(now_s)
        self._starts.note_driven(now_s, driven)

    @property
    def _running(self) -> bool:
        return any(control.driven for control in self._axes.values())

    def status(self, now_s: float, late_s: float = 0.0) -> Status:
        """The state of the box at this moment. `late_s`: how late the last cycle was."""
        axes = self._axis_status(Axis.AZIMUTH, now_s), self._axis_status(Axis.ELEVATION, now_s)
        azimuth, elevation = with_boom(self._settings.mount, *axes)
        movements, authority = self._movements, self._authority
        wanted, by = movements.wanted, authority.controlled_by
        return Status(
            at_s=now_s,
            azimuth=azimuth,
            elevation=elevation,
            wanted_azimuth_deg=wanted.azimuth_deg,
            wanted_elevation_deg=wanted.elevation_deg,
            latched=authority.latched,
            storm=authority.storm,
            controlled_by=str(by or ""),
            controlled_from=by.host if by else "",
            program_sends=authority.program_sends(now_s),
            held_by=str(authority.held_by or ""),
            timed_point=movements.timed.point,
            timed_points=len(movements.timed.points),
            simulated=self._settings.simulated,
            speed_level=self._speed_level,
            mode=authority.mode,
            mode_by=authority.mode_by,
            mode_switch=self._settings.mode is not Mode.AUTO,
            flown=movements.flown,
            nudge_azimuth_deg=movements.nudged_deg[Axis.AZIMUTH],
            nudge_elevation_deg=movements.nudged_deg[Axis.ELEVATION],
            notices=authority.ignored(now_s),
            cycle_late_s=late_s,
        )

    def _axis_status(self, axis: Axis, now_s: float) -> AxisStatus:
        more = self._remarks[axis] + self._movements.notices(axis) + self._fence.notices(axis, now_s)
        starts = self._starts.of(axis) if self._axes[axis].has_relays else None
        status, led_deg = self._axes[axis].status(now_s, starts=starts, more=more), self._movements.led_from_deg(axis)
        if led_deg is None:
            return status
        return replace(status, missed_deg=led_deg % FULL_TURN_DEG if status.endless else led_deg)

    def _take(self, source: Source, order: Order, now_s: float) -> None:
        """Raises Refused where the order cannot be carried out."""
        deed, homing = deed_of(order), self._movements.homes_for_another(source)
        match order:
            case Stop(axes, latch):
                self._stop(source, axes, latch=latch, now_s=now_s)
                self.errands.append(order)
            case LetGo():
                self._stop(source, BOTH, latch=True, now_s=now_s)
                self.errands.append(LetGo())
            case Release():
                self._authority.released()
                self._acknowledge(now_s, by_person=True)
            case SetMode(mode):
                self._movements.stop(BOTH)
                self._movements.clear_nudges()
                self._authority.switch(source, mode)
            case GiveBack():
                self._authority.give_back(source)
            case Jog(direction=Direction.OFF, held=True):
                self._movements.let_go(source)
            case Leave():
                # Not ended: a jog with a time, a fixed target, a timed list.
                self._movements.let_go(source)
                if self._authority.left(source, now_s):
                    self._movements.end_stream()
            case Unheeded(refused):
                self._authority.hear(source, now_s, aims_of(refused))
            case ClearTimed():
                self._movements.timed.clear()
            case Speed(level):
                self._speed_level = level
                for control in self._axes.values():
                    control.limit_speed(level)
            case Remark(axis, text, lcd):
                self._remarks[axis] = (Notice(text, lcd),) if text else ()
            case RelaysChecked(axis):
                self._axes[axis].checked()
            case TakeTurn():
                if self._authority.controlled_by == source:
                    self._movements.take_turn(order, now_s)
            case Nudge():
                self._movements.nudge(order, now_s, at_once=not self._authority.latched)
            case Fly(stream=Stream()):
                # Ignored if another sender moved the antenna while the plan was computed.
                if self._authority.controlled_by == source:
                    self._movements.fly_for_stream(order, source, now_s)
            case Park(storm=True) | Confirm() | Calibrate() | Take():
                if deed and self._authority.allows(source, now_s, deed, homing=homing):
                    self._take_allowed(source, order, now_s)
            case _ if deed and self._authority.may_move(source, now_s, aims_of(order), deed=deed, homing=homing):
                self._starts.ordered(now_s)
                self._movements.begin(order, source, now_s)

    def _take_allowed(self, source: Source, order: Park | Confirm | Calibrate | Take, now_s: float) -> None:
        """Carry out an allowed order that does not make its sender the one that moves the antenna. Raises Refused."""
        match order:
            case Park():
                self._movements.stop(BOTH)
                self._authority.begin_storm(source)
                self._movements.park()
            case Calibrate(axis, high_end):
                self._movements.calibrate_end(axis, now_s, high_end=high_end)
            case Confirm(axis, angle_deg):
                self._movements.confirm(axis)
                self.errands.append(Place(axis, angle_deg))
            case Take(stops):
                # What this person moves or tracks already may go on.
                goes_on = not stops and self._authority.controlled_by in (source, Source(TRACKER))
                if not goes_on:
                    self._movements.stop(BOTH)
                self._authority.take(source, stopped=not goes_on)

    def _stop(self, source: Source, axes: tuple[Axis, ...], *, latch: bool, now_s: float) -> None:
        if not latch and axes == BOTH and source == self._authority.controlled_by:
            self._movements.pause(source, now_s)
        self._movements.stop(BOTH if self._authority.storm else axes)
        self._authority.stopped_axis(source, now_s)
        if len(axes) == len(self._axes):
            self._authority.stopped(source, now_s, latch=latch)
            if not latch and not self._authority.latched:
                self._acknowledge(now_s, by_person=False)

    def _acknowledge(self, now_s: float, *, by_person: bool) -> None:
        self.errands += map(Acknowledge, self._movements.acknowledge(now_s, by_person=by_person))
