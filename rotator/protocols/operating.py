"""What a person's command makes the box do, and why it does not: the same for the console and for the page.

Knows orders, the states in which they have no effect, and what tracks targets. Does not know how a command came, nor
how the answer is written.
"""

from __future__ import annotations

import math
from dataclasses import replace

from hw.ports import Axis
from rotator.config.sky import NO_PLACE
from rotator.control.rights import Deed, State, deed_of, hindrance, holds, mode_words
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG
from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.orders import (
    Aim,
    GiveBack,
    Home,
    Jog,
    LetGo,
    Mode,
    Nudge,
    Order,
    RelaysChecked,
    Release,
    SetMode,
    Stop,
    Take,
)
from rotator.exchange.sources import Refusal, Source
from rotator.exchange.status import Status
from rotator.protocols.methods import PULSE_S, ClockIsRight, Demo, GoOn, PersonCommand, Pulse, Track
from rotator.protocols.session import Box, Tracking

NOTHING_LEFT = "nothing was tracked that could go on; `resume` lets the antenna move again"
SHOWN_S = 0.3
"""So long after an order the status may not show it yet."""


class Operating:
    """One person's connection. While a stop is latched, orders that move are refused with the reason."""

    def __init__(self, box: Box, tracking: Tracking | None = None, source: Source | None = None) -> None:
        """`tracking`: None where the box does not know where on the earth it stands.

        `source`: whose orders have no effect while another person holds the antenna; None: nothing holds this one off.
        """
        self._box = box
        self._tracking = tracking
        self._source = source
        self._resumed_s = -math.inf
        """When a `resume` was sent, on the clock of the status."""

    @property
    def tracks(self) -> str:
        """What goes on, as `Tracker.state` says it."""
        return self._tracking.state if self._tracking else "off"

    def refuse(self, reason: str) -> str:
        """Log it, and return it. What the box refuses is in the log already."""
        if reason:
            self._box.note_refused(Refusal(reason))
        return reason

    def do(self, command: PersonCommand) -> str:
        """Do it. Returns why not; empty: it is done, or has begun."""
        match command:
            case Track(words):
                return self.refuse(self._track(words))
            case Demo(zone, times):
                return self.refuse(self._demo(zone, times))
            case GoOn():
                return self.refuse(self._go_on())
            case ClockIsRight():
                if self._tracking is not None:
                    self._tracking.clock_is_right()
                return ""
            case Pulse(axis, direction):
                return self.refuse(self._unfit(axis)) or self._obey(Jog(axis, direction, PULSE_S))
            case _:
                return self._obey(command)

    def _unfit(self, axis: Axis) -> str:
        """Why no relay of this axis is closed for a trial; empty: nothing else moves, and this person holds it all."""
        status = self._box.status()
        if status.axis(axis).starts is None:
            return "this rotor has no relays: turn it by the buttons instead"
        if self._source is not None and status.held_by != str(self._source):
            return "take the antenna first: then no program closes a relay meanwhile"
        if status.moving:
            return "the antenna moves: wait until it stands"
        return _faulty(status)

    def _obey(self, order: Order) -> str:
        if isinstance(order, SetMode) and self._box.status().mode_switch:
            return self.refuse("the box has a mode switch of its own: turn it there")
        if reason := self.refuse(self._blocked(order) or _beyond(order, self._box.status())):
            return reason
        match order:
            case Aim() | Jog() | Home():
                pass
            case _:
                self._resumed_s = self._box.status().at_s if isinstance(order, Release) else -math.inf
        lasting = _lasting(self._box.status()) if isinstance(order, Release) else ""
        refused = self._box.order(order)
        return refused.reason if refused else lasting

    def _go_on(self) -> str:
        """A person lets it move again, and says that it shall go on with what it did before."""
        left, status = self.goes_on_with, self._box.status()
        if not left and (status.flown is None or not status.faults):
            return self._of_another() or NOTHING_LEFT
        # What a fault has not ended goes on by itself.
        return self._of_another() or self._obey(Release()) or (self._track(left) if left else "")

    @property
    def goes_on_with(self) -> str:
        """As `Tracking.goes_on_with`."""
        return self._tracking.goes_on_with if self._tracking else ""

    def _track(self, words: str) -> str:
        if self._tracking is None:
            return NO_PLACE
        if words == "off":
            if reason := self._of_another():
                return reason
            self._tracking.off()
            return ""
        if words == "plan":
            return self._leave_to_plan(self._tracking)
        return self._tracking_held() or self._tracking.track(words) or self._hold()

    def _leave_to_plan(self, tracking: Tracking) -> str:
        """The plan of many passes flies only while no sender holds the antenna: who asks for it gives it back."""
        status = self._box.status()
        holder = status.held_by if status.held_by != str(self._source) else ""
        held = f"{holder} holds the antenna: the plan is not flown before it is given back" if holder else ""
        faulty = "" if status.at_s <= self._resumed_s + SHOWN_S else _faulty(status)
        if reason := self._tracking_held() or held or faulty or tracking.follow_plan():
            return reason
        self._box.order(GiveBack())
        return ""

    def program(self, table: TimedTable) -> str:
        """Track a timed table. Returns why not; empty: it does."""
        if self._tracking is None:
            return NO_PLACE
        return self._tracking_held() or self._tracking.program(table) or self._hold()

    def _demo(self, zone: str, times: int) -> str:
        """Also for who has no right to move the antenna: so it takes a simulated one, and takes it from nobody."""
        status = self._box.status()
        if not status.simulated or self._tracking is None:
            return "the demo pass is flown on a simulated rotor alone: this one turns a real antenna"
        busy = ""
        if status.held_by not in ("", str(self._source)):
            busy = f"{status.held_by} holds the antenna"
        elif status.flown is not None or self.tracks in ("planning", "tracking"):
            busy = f"{status.flown.name if status.flown else 'another target'} is tracked already"
        elif status.program_sends:
            busy = f"{status.controlled_by} moves the antenna"
        elif status.moving:
            busy = "the antenna turns"
        if busy:
            return f"{busy}: the demo pass waits until nobody uses it"
        return self._tracking_held() or _faulty(status) or self._tracking.demo(zone, times)

    def _tracking_held(self) -> str:
        """In every mode but AUTO the box itself moves nothing, also for the person who has set it."""
        status = self._box.status()
        if status.mode is not Mode.AUTO:
            return mode_words(status.mode, status.mode_by)
        return self._held(Deed.AIM)

    def _hold(self) -> str:
        """What this person tracks is theirs, as what they move is: no stream on a link snatches it."""
        if self._source is not None and self._source.holds and self._box.status().held_by != str(self._source):
            self._box.order(Take(stops=False))
        return ""

    def _of_another(self) -> str:
        """Who else holds the antenna, where that concerns this person; empty: it does not."""
        return holds(self._box.status(), self._source).get(State.HELD, "")

    def _blocked(self, order: Order) -> str:
        """Why this order would have no effect; empty: it has one."""
        match order:
            case Stop() | Take() | Release() | RelaysChecked() | LetGo():
                pass
            case _ if reason := self._of_another():
                return reason
        deed = deed_of(order)
        return self._held(deed) if deed else ""

    def _held(self, deed: Deed) -> str:
        """What holds the antenna back from this; empty: nothing does."""
        status = self._box.status()
        # A later stop came from another person, or from a key.
        resumed = status.at_s <= self._resumed_s + SHOWN_S
        held = holds(replace(status, latched="") if resumed else status, self._source)
        state = hindrance(held, deed)
        return held[state] if state else ""


def _lasting(status: Status) -> str:
    """Why a release lets no faulty axis move: the causes are still there. Empty: a fault ends, or there is none."""
    lasting = [str(fault) for fault in status.faults if not fault.passing]
    return f"the cause is still there: {'; '.join(lasting)}" if lasting and not status.ends_a_fault else ""


def _faulty(status: Status) -> str:
    """What must be mended before; empty: nothing."""
    return f"first mend this, and let it go on: {status.faults[0]}" if status.faults else ""


def _beyond(order: Order, status: Status) -> str:
    """Why the rotor has no such angle, or turns no further that way; empty: neither.

    A person who names an angle is not led to another one instead. A program's order means a direction all the same: it
    sends what its satellite does.
    """
    match order:
        case Aim(float() as azimuth_deg, float() as elevation_deg):
            pass
        case Jog(name, direction) if (axis := status.axis(name)).at_end(direction):
            end_deg = axis.max_deg if direction > 0 else axis.min_deg
            return f"{name.value} stands at the end of its range, {end_deg:g}°: it turns only the other way"
        case Nudge() if status.wanted_azimuth_deg is None and status.wanted_elevation_deg is None:
            return "there is no target to nudge: track or point first"
        case _:
            return ""
    azimuth, elevation = status.azimuth, status.elevation
    if azimuth.fitted and azimuth_deg > FULL_TURN_DEG and azimuth_deg > azimuth.max_deg:
        return (
            f"azimuth {azimuth_deg:g}° names a turn beyond the range of {azimuth.min_deg:g}° to {azimuth.max_deg:g}°; "
            f"the same direction is {azimuth_deg % FULL_TURN_DEG:g}°"
        )
    below = elevation_deg < min(0.0, elevation.min_deg)
    if not elevation.fitted:
        return ""
    if below or elevation_deg > max(ZENITH_DEG, elevation.max_deg):
        return f"elevation {elevation_deg:g}° is outside the range of {elevation.min_deg:g}° to {elevation.max_deg:g}°"
    return ""
