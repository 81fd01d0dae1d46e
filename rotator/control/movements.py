"""What the antenna is doing by order: it aims, jogs, homes, runs a timed list, flies a pass, parks; and what ends that.

Knows both axes, the orders that move them, and how one gives way to the next. Does not know who may give orders:
`authority` has been asked before.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from hw.ports import Axis
from rotator.control.aiming import Aiming
from rotator.control.axis.port import ControlledAxis
from rotator.control.homing_queue import HomingQueue
from rotator.control.idle_park import IdlePark
from rotator.control.jogs import Jogs
from rotator.control.refused import Refused, measures_its_angle, turns_while_calibrated
from rotator.control.settings import Settings
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.timed import TimedList
from rotator.exchange.faults import Notice
from rotator.exchange.flight_order import Fly, TakeTurn
from rotator.exchange.orders import BOTH, Aim, Home, Jog, LoadTimed, Nudge, Order, Park, RunTimed
from rotator.exchange.sources import TRACKER, Source
from rotator.exchange.status import Flown


class Movements:
    def __init__(self, settings: Settings, axes: Mapping[Axis, ControlledAxis]) -> None:
        self._axes = axes
        tolerances_deg = settings.azimuth.tolerance_deg, settings.elevation.tolerance_deg
        self._aiming = Aiming(settings.mount, axes, Pointing(settings.mount, *tolerances_deg, on_sky=settings.on_sky))
        self._homing = HomingQueue(axes)
        self._jogs = Jogs(axes)
        self._idle = IdlePark(settings.park_after_s)
        self._faulted: set[Axis] = set()
        """The axes that had a fault in the last cycle."""
        self.timed = TimedList()

    @property
    def wanted(self) -> Aim:
        """The direction last ordered, as the display shows it."""
        return self._aiming.wanted

    @property
    def flown(self) -> Flown | None:
        """The planned pass that is flown."""
        return self._aiming.flown

    def notices(self, axis: Axis) -> tuple[Notice, ...]:
        """What keeps this axis from its target."""
        return self._aiming.notices(axis)

    def led_from_deg(self, axis: Axis) -> float | None:
        """As for GoingRound."""
        return self._aiming.led_from_deg(axis)

    def homes_for_another(self, source: Source) -> bool:
        """Whether an axis homes, or waits to, for another source."""
        return self._homing.holds_back(source)

    @property
    def faulted(self) -> set[Axis]:
        """The axes that have a fault now."""
        return {axis for axis, control in self._axes.items() if control.fault}

    def begin(self, order: Order, source: Source, now_s: float) -> None:
        """Carry out an order that moves the antenna. Raises Refused."""
        if not isinstance(order, RunTimed):
            self.timed.halt()
        if not isinstance(order, Home):
            self._homing.clear()
        moved: Collection[Axis] = BOTH
        if isinstance(order, Aim):
            self._aiming.take_up(source, now_s)
            if source.is_person or source.link == TRACKER:
                self._aiming.end_pass_nudges()
        match order:
            case Aim() if self._aiming.flies_on(source, order, now_s):
                pass
            case Aim():
                self._aiming.point_at(order, now_s)
            case Fly():
                self._aiming.fly(order, now_s)
            case Park():
                self.park()
                return
            case Jog(axis):
                # The other axis goes on to its target, or stays on it. A pass needs both axes: it ends.
                self._aiming.forget((axis,))
                self._jogs.begin(order, source, now_s)
                moved = (axis,)
            case Home(axis):
                self._homing.ask(axis, source)
            case LoadTimed(interval_s, points):
                self._aiming.point_at(Aim(*self.timed.load(interval_s, points)), now_s)
            case RunTimed():
                self.timed.run(now_s)
                moved = ()
        if self.timed.running or self._homing.active or any(self._axes[axis].busy for axis in moved):
            self._idle.ordered(now_s)

    def take_turn(self, order: TakeTurn, now_s: float) -> None:
        """Follow the stream on this turn of azimuth from now on; ignored if the stream has ended."""
        if not self.timed.running and not self.faulted and self._aiming.take_turn(order, now_s):
            self._idle.ordered(now_s)

    def fly_for_stream(self, order: Fly, source: Source, now_s: float) -> None:
        """Fly a planned pass in place of a recognised stream; ignored if the stream has ended. Raises Refused."""
        if not self.timed.running and not self.faulted and self._aiming.fly_for_stream(order, source, now_s):
            self._idle.ordered(now_s)

    def park(self) -> None:
        """Go to the park position. Raises Refused."""
        self._idle.ended()
        self._aiming.park()

    def nudge(self, order: Nudge, now_s: float, *, at_once: bool) -> None:
        """Shift all orders from now on. `at_once`: the target in force too. Raises Refused."""
        self._aiming.nudge(order.axis, order.offset_deg, of_pass=order.of_pass)
        if at_once and self._aiming.repeat(now_s):
            self._axes[order.axis].nudged()
            self._idle.ordered(now_s)

    @property
    def nudged_deg(self) -> Mapping[Axis, float]:
        """By how much a person has shifted the target in force."""
        return self._aiming.nudged_deg

    def clear_nudges(self) -> None:
        self._aiming.clear_nudges()

    def calibrate_end(self, axis: Axis, now_s: float, *, high_end: bool) -> None:
        """The axis stands at an end of its range. Raises Refused."""
        if any(control.moving(now_s) for control in self._axes.values()):
            raise Refused(turns_while_calibrated(axis.value))
        self._axes[axis].calibrate_end(high_end=high_end)
        self._axes[axis].halt()
        self._aiming.forget((axis,))

    def confirm(self, axis: Axis) -> None:
        """A person has said at which angle the axis stands. Raises Refused."""
        if not self._axes[axis].confirmable:
            raise Refused(measures_its_angle(axis.value))
        self._halt((axis,))
        self._axes[axis].confirmed()

    def go_on(self, now_s: float, *, may_park: bool) -> None:
        """What begins in this cycle without a new order: the next point of a list, the next homing, the idle park.

        `may_park`: an idle antenna may park. Otherwise no idle time runs before the next order.

        Raises Refused.
        """
        if (point := self.timed.due(now_s)) is not None:
            self._idle.ordered(now_s)
            self._aiming.point_at(Aim(*point), now_s)
        if self._homing.due():
            self._halt(BOTH)
            self._homing.begin()
        if not may_park:
            self._idle.ended()
        elif self._idle.counts and self._idle.due(now_s, busy=self._busy(now_s)):
            self.park()

    def _busy(self, now_s: float) -> bool:
        """Whether the antenna turns, or will turn on by itself when a relay may close or a motor is cool."""
        if self.timed.running or self._homing.active or self._aiming.flown is not None:
            return True
        return any(
            control.moving(now_s) or control.waits or (control.busy and control.aiming is None)
            for control in self._axes.values()
        )

    def look_ahead(self, now_s: float) -> None:
        """Give each axis the goal of this moment."""
        self._aiming.look_ahead(now_s)

    def note_driven(self, now_s: float) -> None:
        """After the cycle, when each axis knows what its relays do."""
        self._jogs.note_driven(now_s)

    def let_go(self, source: Source) -> None:
        """`source` has let go of a button: its jog ends, where it has no time of its own."""
        self._jogs.end(source)

    def end_stream(self) -> None:
        """No more orders come from the sender that moves the antenna: the target stands at the last one."""
        self._aiming.end_stream()

    def after_faults(self, *, storm: bool) -> None:
        """End what a new fault ends. A pass that is flown and a storm park (`storm`) go on where one has passed by
        itself. Raises Refused."""
        before, self._faulted = self._faulted, self.faulted
        if self._faulted - before:
            self._idle.ended()
        if self._faulted:
            # End the list now. Otherwise acknowledging the fault would start a motor.
            self.timed.halt()
            self._aiming.end_following()
        if before - self._faulted:
            self._aiming.fly_anew()
            if storm:
                self.park()

    def pause(self, source: Source, now_s: float) -> None:
        """`source` is about to stop what it ordered itself: its next direction may go on with it."""
        if not self.faulted:
            self._aiming.pause(source, now_s)

    def stop(self, axes: tuple[Axis, ...]) -> None:
        """Stop these axes. No axis begins to home, and the antenna does not park, before the next order."""
        self._homing.clear()
        self._idle.ended()
        self._halt(axes)

    def acknowledge(self, now_s: float, *, by_person: bool) -> list[Axis]:
        """Faults are acknowledged, and nothing moves before the next order. Returns the axes for which it counts."""
        before = self.faulted
        self._idle.ended()
        acknowledged = [axis for axis, each in self._axes.items() if each.acknowledge(now_s, by_person=by_person)]
        if ended := before - self.faulted:
            # The order that was in force when the fault came is not taken up again. Where the cause is still there, the
            # order stays as a fault keeps it: shown, and without effect.
            self._aiming.drop(ended)
        return acknowledged

    def _halt(self, axes: tuple[Axis, ...]) -> None:
        self.timed.halt()
        self._aiming.halt(axes)
