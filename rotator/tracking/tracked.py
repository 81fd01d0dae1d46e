"""What is tracked: a person's request, the flight that is flown for it, and why the latest tracking has ended.

Knows each change from one state to the next: a new request, a flight, a refusal, an end; and when a flight is lost or
over. All of it is values: no box, no thread, no planner. Times are arguments.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rotator.exchange.orders import LetGo, Order, Park, Release, SetMode, Stop, Take
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.tracking.next_flight import NextFlight, Now, Wanted
from rotator.tracking.ports import TRACK
from rotator.tracking.program import Program

TAKES_EFFECT_S = 2.0
"""Seconds from an order until the status must show it."""
JUMPED_S = 0.25
"""A change of the clock by more seconds makes a new plan."""
FRESH_S = 600.0
BEFORE_S = 120.0
"""A plan that is older than `FRESH_S` is made again `BEFORE_S` before its pass, with the newest elements."""


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight that has been ordered. `planned`: when its plan was begun; `ordered_s`: on the loop's clock.

    `wanted`: the target as the plan knew it.
    """

    flight: NextFlight
    planned: Now
    ordered_s: float
    wanted: Wanted | None = None

    def is_over(self, now: Now) -> bool:
        """Whether a new plan is due."""
        if now.utc_s >= self.flight.end_utc_s or self.clock_was_set(now):
            return True
        before_s = self.flight.begin_utc_s - BEFORE_S
        return self.planned.utc_s < before_s - FRESH_S and now.utc_s >= before_s

    def clock_was_set(self, now: Now) -> bool:
        """Whether the clock was set since the plan: then the flight has the wrong times."""
        return abs(now.apart_s - self.planned.apart_s) > JUMPED_S

    def is_shown(self, status: Status) -> bool:
        """Whether the status is later than the order of this flight."""
        if status.at_s >= self.ordered_s + TAKES_EFFECT_S:
            return True
        return status.flown is not None and status.flown.name == self.flight.order.name

    def lost(self, status: Status, now: Now) -> str:
        """Why the tracker has lost the antenna; empty: it still has it."""
        if status.at_s < self.ordered_s + TAKES_EFFECT_S or now.utc_s >= self.flight.end_utc_s - 1.0:
            return ""
        if status.latched:
            return f"{'storm park' if status.storm else 'stopped'} by {status.latched}"
        if status.controlled_by != str(TRACK):
            return f"{status.controlled_by} moves the antenna" if status.controlled_by else "the antenna was stopped"
        return "the antenna was stopped" if status.flown is None else ""


@dataclass(frozen=True, slots=True)
class Request:
    """A person's request. `program`: the table that the words stand for, if it is no target.

    `flown`: None before its first plan.
    """

    words: str
    program: Program | None = None
    flown: Flown | None = None


NOTHING = Request("")


@dataclass(frozen=True, slots=True)
class Tracked:
    """One state of the tracker. Each method returns the next one."""

    request: Request = NOTHING
    before: Request = NOTHING
    """The tracking before a request that has no plan yet. It goes on if the request cannot be planned."""
    refused: str = ""
    """Why the latest request was refused, while the tracking before it goes on."""
    ended: str = ""
    """Why the latest tracking ended by itself."""
    left: Request = NOTHING
    """What was tracked when another sender ended that: a person may go on with it."""
    asked: int = 0
    """The number of requests. A plan for an earlier request is not flown."""
    looks_again: bool = False
    """Whether the name is not known and files are new: then it is searched again after they are read."""
    held: str = ""
    """Who stopped or released the antenna since the request, and how. Tracking ends then."""
    mover: str = ""
    """The source that moved the antenna at the time of the request."""
    ordered_s: float = -math.inf
    """When the tracker last ordered a motion, on the loop's clock. The status may not show it yet."""
    follows: bool = True
    """Whether the plan of many passes may be flown: `Tracker.off` forbids it, `Tracker.follow_plan` allows it again."""
    released: bool = False
    """Whether a person has let it go on after a fault, since the flight was ordered: then it is planned anew."""
    of_plan: bool = False
    """Whether the latest motion that the tracker ordered is of that plan."""

    @property
    def following(self) -> bool:
        """Whether the antenna is left to the plan of many passes."""
        return self.follows and not self.request.words

    @property
    def goes_on_with(self) -> str:
        """The words of what a stop or another sender has ended; empty: nothing, or a table, which has its own time."""
        left = self.request if self.request.words and self.held else self.left
        return "" if left.program else left.words

    def text(self, status: Status) -> str:
        """As `Tracker.state`."""
        flown = self.request.flown
        if self.request.words and self.held:
            return f"ended: {self.held}"
        if self.request.words and self.refused:
            return f"refused: {self.refused}"
        if self.request.words:
            return "tracking" if flown and flown.is_shown(status) else "planning"
        return f"ended: {self.ended}" if self.ended else "off"

    def moves(self, status: Status) -> bool:
        """Whether the tracker moves the antenna, or has just ordered a motion."""
        return status.controlled_by == str(TRACK) or status.at_s < self.ordered_s + TAKES_EFFECT_S

    def taken_by(self, status: Status) -> str:
        """The source that has begun to move the antenna since the request; empty: none."""
        return status.controlled_by if status.controlled_by not in ("", str(TRACK), self.mover) else ""

    def reason_to_end(self, status: Status, now: Now) -> str:
        """Why the tracking ends now; empty: it goes on."""
        if self.held or self.request.flown is None or self._dropped(status):
            return self.held
        return self.request.flown.lost(status, now)

    def plan_is_due(self, status: Status, now: Now) -> bool:
        flown = self.request.flown
        return not self.looks_again and (flown is None or flown.is_over(now) or self._dropped(status))

    def _dropped(self, status: Status) -> bool:
        """Whether the release after a fault has ended the flight, which the person wants to go on."""
        return self.released and status.flown is None

    # --- what changes it

    def requested(self, request: Request, mover: str, *, follows: bool, looks_again: bool = False) -> Tracked:
        """A person's new request; NOTHING: to track nothing. `mover`: the source that moves the antenna now."""
        before = self.request if self.request.flown is not None else self.before
        return replace(
            self,
            request=request,
            before=before if request.words else NOTHING,
            refused="",
            ended="",
            left=NOTHING,
            asked=self.asked + 1,
            looks_again=looks_again,
            held="",
            mover=mover,
            follows=follows,
        )

    def with_new_files(self) -> Tracked:
        """The files of elements have been read again."""
        return replace(self, looks_again=False)

    def stopped(self, source: Source, order: Order) -> Tracked:
        """Another sender has ended the tracking with this order. The first one counts."""
        return replace(self, held=self.held or f"{source} {_did(order)}")

    def goes_on(self) -> Tracked:
        """A person has let the antenna go on after a fault."""
        return replace(self, released=True)

    def ordered(self, at_s: float, *, of_plan: bool = False) -> Tracked:
        """The tracker has ordered a motion."""
        return replace(self, ordered_s=at_s, of_plan=of_plan)

    def flies(self, flown: Flown) -> Tracked:
        """The request has its plan, and the flight has been ordered."""
        request = replace(self.request, flown=flown)
        return replace(self, request=request, before=NOTHING, mover=str(TRACK), released=False)

    def cannot_be_planned(self, reason: str) -> Tracked:
        """The tracking before the request goes on. If there is none, this is the end."""
        if self.before.words:
            return replace(self, request=self.before, before=NOTHING, refused=reason)
        return self.ends(reason)

    def ends(self, reason: str, left: Request = NOTHING) -> Tracked:
        """`left`: the request, where a person may want to go on with it."""
        return replace(self, request=NOTHING, before=NOTHING, ended=reason, left=left)


def ends_tracking(order: Order, status: Status) -> bool:
    """Whether this order of another sender ends the tracking. `status`: before the order.

    A release after a fault does not: to go on is what the person says.
    """
    match order:
        case Release():
            return bool(status.latched)
        case Stop() | SetMode() | LetGo() | Take(stops=True) | Park(storm=True):
            return True
        case _:
            return False


def _did(order: Order) -> str:
    """What an order that ends tracking did, as words behind its sender."""
    match order:
        case SetMode(mode):
            return f"has set the mode {mode.name}"
        case LetGo():
            return "took the torque from the motors"
        case Release():
            return "let it go on after a stop"
        case Take():
            return "took the antenna"
        case Park():
            return "parked it"
        case _:
            return "stopped it"
