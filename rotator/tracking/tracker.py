"""Tracks one target from pass to pass: a person's request, the plan that is flown, and when a new plan is due.

Knows the status of the box, and gives orders as a link does. Another sender that takes the antenna ends the tracking.
Plans are computed elsewhere, because that takes long. Times are arguments.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import BOTH, Aim, LetGo, Order, Park, Release, SetMode, Stop, Take
from rotator.exchange.sources import TRACKER, Source
from rotator.exchange.status import Status
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.tracking.next_flight import NeverRises, NextFlight, Now, Wanted
from rotator.tracking.program import CannotFly, Program
from rotator.tracking.system_clock import TOLD_S

log = logging.getLogger(__name__)

TRACK = Source(TRACKER)
TAKES_EFFECT_S = 2.0
"""Seconds from an order until the status must show it."""
JUMPED_S = 0.25
"""A change of the clock by more seconds makes a new plan."""
FRESH_S = 600.0
BEFORE_S = 120.0
"""A plan that is older than `FRESH_S` is made again `BEFORE_S` before its pass, with the newest elements."""
CLOCK_UNSURE = (
    "nothing is tracked before this computer's clock is right: it has reached no time server yet. Where `date` shows "
    "the right time: rotator track --clock-is-right NAME, or step 8 of the page's Setup"
)
NO_PLAN = "there is no plan: the file has no [[sky.follow]]"


def no_plan() -> str:
    return NO_PLAN


class Planner(Protocol):
    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises NeverRises, NotThere, Unknown; RuntimeError where the plan could not be made."""

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        """The rest of a present pass. Raises NotThere, RuntimeError."""

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        """Raises CannotFly, RuntimeError."""


class Finder(Protocol):
    def find(self, words: str) -> Wanted | Aim:
        """A target that moves, or a fixed direction. Raises Unknown, NotThere."""

    def has_news(self) -> bool:
        """Whether a file of elements is new, or has changed, and has not been read yet."""


class Box(Protocol):
    """The box, as this file sees it. No call waits."""

    def status(self) -> Status: ...

    def antenna(self) -> Antenna | None:
        """The antenna as it stands; None: its angles are not known."""

    def refusal(self, order: Order) -> str:
        """Why the rotor cannot obey this order; empty: it can."""

    def order(self, order: Order, source: Source = TRACK) -> None: ...


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight that has been ordered. `planned`: when its plan was begun; `ordered_s`: on the loop's clock."""

    flight: NextFlight
    planned: Now
    ordered_s: float


@dataclass(frozen=True, slots=True)
class Tracked:
    """A person's request. `program`: the table that the words stand for, if it is no target.

    `flown`: None before its first plan.
    """

    words: str
    program: Program | None = None
    flown: Flown | None = None


NOTHING = Tracked("")


class Tracker:
    """`track`, `follow_plan`, `off` and `clock_is_right` may be called from any thread, `step` from one only.

    `clock_trusted`: whether the computer's clock counts as right without a person's word. `why_no_plan`: why there is
    no plan of many passes; empty: there is one.
    """

    def __init__(
        self,
        finder: Finder,
        planner: Planner,
        box: Box,
        clock_trusted: Callable[[], bool],
        why_no_plan: Callable[[], str] = no_plan,
    ) -> None:
        self._finder = finder
        self._planner = planner
        self._box = box
        self._clock_trusted = clock_trusted
        self._why_no_plan = why_no_plan
        self.clock_told = False
        """A person has said that the clock is right."""
        self._lock = threading.Lock()
        self._tracked = NOTHING
        self._before = NOTHING
        """The tracking before a request that has no plan yet. It goes on if the request cannot be planned."""
        self._refused = ""
        """Why the latest request was refused, while the tracking before it goes on."""
        self._asked = 0
        """The number of requests. A plan for an earlier request is not flown."""
        self._looks_again = False
        """Whether the name is not known and files are new: then it is searched again after they are read."""
        self._held = ""
        """Who stopped or released the antenna since the request, and how. Tracking ends then."""
        self._mover = ""
        """The source that moved the antenna at the time of the request."""
        self._ordered_s = -math.inf
        """When the tracker last ordered a motion, on the loop's clock. The status may not show it yet."""
        self._ended = ""
        """Why the latest tracking ended by itself."""
        self._follows = True
        """Whether the plan of many passes may be flown: `off` forbids it, `follow_plan` allows it again."""
        self._of_plan = False
        """Whether the latest motion that the tracker ordered is of that plan."""

    @property
    def following(self) -> bool:
        """Whether the tracker leaves the antenna to the plan of many passes."""
        with self._lock:
            return self._follows and not self._tracked.words

    @property
    def wants_new_files(self) -> bool:
        """Whether the files of elements must be read again before the next `step`."""
        return self._looks_again

    def read_new_files(self) -> None:
        """The files of elements have been read again."""
        self._looks_again = False

    def heard(self, source: Source, order: Order) -> None:
        """An order of any sender. After a stop nothing begins again by itself, not even a plan in work."""
        status = self._box.status()
        match order:
            case Release() if not (status.latched or status.faults):
                pass  # it released nothing
            case Stop() | SetMode() | LetGo() | Release() | Take(stops=True) | Park(storm=True) if source != TRACK:
                with self._lock:
                    self._held = self._held or f"{source} {_did(order)}"

    # --- from a console

    @property
    def state(self) -> str:
        """`off`, `planning`, `tracking`, or `ended: ` and the reason.

        `refused: ` and the reason: the latest request cannot be tracked, and the tracking before it goes on. Who reads
        `tracking` finds this flight in the status, not the one before it.
        """
        status = self._box.status()
        with self._lock:
            if self._tracked.words and self._refused:
                return f"refused: {self._refused}"
            if self._tracked.words:
                return "tracking" if self._tracked.flown and _is_shown(self._tracked.flown, status) else "planning"
            return f"ended: {self._ended}" if self._ended else "off"

    def track(self, words: str) -> str:
        """Begin to track. Returns why not; empty: it tracks."""
        try:
            wanted = self._finder.find(words)
        except Unknown as fault:
            if not (self.clock_trusted() and self._finder.has_news()):
                return str(fault)
            self._begin(Tracked(words), follows=self._follows, looks_again=True)
            return ""
        except NotThere as fault:
            return str(fault)
        if isinstance(wanted, Aim):
            if refused := self._box.refusal(wanted):
                return refused
            self._begin(NOTHING, follows=self._follows)
            with self._lock:
                self._order(wanted)
            return ""
        if not self.clock_trusted():
            return CLOCK_UNSURE
        self._begin(Tracked(words), follows=self._follows)
        return ""

    def program(self, table: TimedTable) -> str:
        """Begin to track a timed table, once. Returns why not; empty: it tracks."""
        if table.utc and not self.clock_trusted():
            return CLOCK_UNSURE
        self._begin(Tracked(table.name, Program(table, self._box.status().at_s)), follows=self._follows)
        return ""

    def follow_plan(self) -> str:
        """Leave the antenna to the plan of many passes. Returns why not; empty: it has it.

        A flight of the plan goes on. What else the tracker moves stops.
        """
        if reason := self._why_no_plan():
            return reason
        if not self.clock_trusted():
            return CLOCK_UNSURE
        mover = self._box.status().controlled_by
        with self._lock:
            self._request(NOTHING, mover, follows=True)
            # With the lock: a flight of the plan that is ordered from now on comes after this stop.
            if not self._of_plan:
                self._stop()
        return ""

    def off(self) -> None:
        """End the tracking. The antenna stops if the tracker moves it."""
        self._begin(NOTHING, follows=False)
        self._stop()

    def fly_planned(self, flight: Fly) -> bool:
        """Order a flight of the plan of many passes. Returns whether that plan still has the antenna."""
        with self._lock:
            if not self._follows or self._tracked.words:
                return False
            self._order(flight, of_plan=True)
            return True

    def fail(self, reason: str) -> None:
        """End the tracking because of a bug of the program. The antenna stops if the tracker moves it."""
        with self._lock:
            words, asked = self._tracked.words, self._asked
        if words:
            self._end(asked, words, reason)
        self._stop()

    def clock_is_right(self) -> None:
        if not self.clock_told:
            log.info("a person says that this computer's clock is right: it counts as right to %g s", TOLD_S)
        self.clock_told = True

    def clock_trusted(self) -> bool:
        """Whether the clock is right, as the system or a person says."""
        return self.clock_told or self._clock_trusted()

    def _begin(self, tracked: Tracked, *, follows: bool, looks_again: bool = False) -> None:
        mover = self._box.status().controlled_by
        with self._lock:
            self._request(tracked, mover, follows=follows, looks_again=looks_again)

    def _request(self, tracked: Tracked, mover: str, *, follows: bool, looks_again: bool = False) -> None:
        """The caller holds the lock."""
        if not tracked.words:
            self._before = NOTHING
        elif self._tracked.flown is not None:
            self._before = self._tracked
        self._tracked, self._ended, self._refused, self._follows = tracked, "", "", follows
        self._held, self._mover = "", mover
        self._looks_again = looks_again
        self._asked += 1

    def _order(self, order: Order, *, of_plan: bool = False) -> None:
        """The caller holds the lock, so no request can come between its last check and this order."""
        self._ordered_s, self._of_plan = self._box.status().at_s, of_plan
        self._box.order(order)

    def _stop(self) -> None:
        """Stop the antenna if the tracker moves it or has just ordered a motion."""
        status = self._box.status()
        if status.controlled_by == str(TRACK) or status.at_s < self._ordered_s + TAKES_EFFECT_S:
            self._box.order(Stop(BOTH))

    # --- from its thread

    def step(self, now: Now) -> None:
        """Do what is due now. May compute for seconds."""
        with self._lock:
            tracked, asked, held = self._tracked, self._asked, self._held
            words, flown = tracked.words, tracked.flown
        if not words:
            return
        if held:
            self._end(asked, words, held)
        elif flown is not None and (reason := lost(flown, self._box.status(), now)):
            self._end(asked, words, reason)
        elif not self._looks_again and (flown is None or _is_over(flown, now)):
            self._fly(tracked, asked, now)

    def _fly(self, tracked: Tracked, asked: int, now: Now) -> None:
        words, program = tracked.words, tracked.program
        antenna = self._box.antenna()
        if antenna is None:
            self._refuse(asked, tracked, "the antenna's angles are not known")
            return
        try:
            flight = self._planner.plan_program(program, antenna, now) if program else self._plan(words, antenna, now)
        except (Unknown, NotThere, NeverRises, CannotFly, RuntimeError) as reason:
            self._refuse(asked, tracked, str(reason))
            return
        status = self._box.status()
        with self._lock:
            # The plan took seconds: another request, a stop or another sender may have come meanwhile.
            if asked != self._asked or self._held or status.latched:
                return
            taken = status.controlled_by not in ("", str(TRACK), self._mover)
            if not taken:
                self._tracked = replace(tracked, flown=Flown(flight, now, status.at_s))
                self._before, self._mover = NOTHING, str(TRACK)
                self._order(flight.order)
        if taken:
            self._end(asked, words, f"{status.controlled_by} moves the antenna")

    def _plan(self, words: str, antenna: Antenna, now: Now) -> NextFlight:
        wanted = self._finder.find(words)
        if isinstance(wanted, Aim):  # the file of elements has gone, and the words now mean a direction
            raise Unknown(f'"{words}" is no moving target any more')
        return self._planner.plan(wanted, antenna, now)

    def _refuse(self, asked: int, tracked: Tracked, reason: str) -> None:
        """The request cannot be planned. The tracking before it goes on; a flight of the request itself ends."""
        with self._lock:
            if asked != self._asked:
                return
            before, self._before = self._before, NOTHING
            if before.words:
                self._tracked, self._refused = before, reason
        if before.words:
            log.warning("%s is not tracked: %s; %s goes on", tracked.words, reason, before.words)
            return
        self._end(asked, tracked.words, reason)
        if tracked.flown is not None and self._box.status().flown is not None:
            self._stop()

    def _end(self, asked: int, words: str, reason: str) -> None:
        with self._lock:
            if asked != self._asked:
                return
            self._tracked, self._before, self._ended = NOTHING, NOTHING, reason
        log.warning("tracking of %s has ended: %s", words, reason)


def _did(order: Order) -> str:
    """What an order that ends tracking did, as words behind its sender."""
    match order:
        case SetMode(mode):
            return f"has set the mode {mode.name}"
        case LetGo():
            return "took the torque from the motors"
        case Release():
            return "let it go on after a stop or a fault"
        case Take():
            return "took the antenna"
        case Park():
            return "parked it"
        case _:
            return "stopped it"


def _is_shown(flown: Flown, status: Status) -> bool:
    """Whether the status is later than the order of this flight."""
    if status.at_s >= flown.ordered_s + TAKES_EFFECT_S:
        return True
    return status.flown is not None and status.flown.name == flown.flight.order.name


def _is_over(flown: Flown, now: Now) -> bool:
    """Whether a new plan is due."""
    if now.utc_s >= flown.flight.end_utc_s or abs(now.apart_s - flown.planned.apart_s) > JUMPED_S:
        return True
    before_s = flown.flight.begin_utc_s - BEFORE_S
    return flown.planned.utc_s < before_s - FRESH_S and now.utc_s >= before_s


def lost(flown: Flown, status: Status, now: Now) -> str:
    """Why the tracker has lost the antenna; empty: it still has it."""
    if status.at_s < flown.ordered_s + TAKES_EFFECT_S or now.utc_s >= flown.flight.end_utc_s - 1.0:
        return ""
    if status.latched:
        return f"{'storm park' if status.storm else 'stopped'} by {status.latched}"
    if status.controlled_by != str(TRACK):
        return f"{status.controlled_by} moves the antenna" if status.controlled_by else "the antenna was stopped"
    return "the antenna was stopped" if status.flown is None else ""
