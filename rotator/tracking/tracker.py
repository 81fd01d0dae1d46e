"""Tracks one target from pass to pass, as persons ask: has its flights planned, and orders them.

Knows the box, the planner and the sky, and gives orders as a link does. Another sender that takes the antenna ends the
tracking. A target whose file of elements is gone is tracked on with those read before. `tracked` knows what is tracked
and what comes next. Plans are computed elsewhere, because that takes long. Times are arguments.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import BOTH, Aim, Order, Release, Stop
from rotator.exchange.sources import Source
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.tracking.next_flight import NeverRises, NextFlight, Now, Wanted
from rotator.tracking.ports import TRACK, Box, Finder, Planner
from rotator.tracking.program import CannotFly, Program, demo_program
from rotator.tracking.system_clock import ASSUMED_ERROR_S
from rotator.tracking.tracked import NOTHING, Flown, Request, Tracked, ends_tracking

log = logging.getLogger(__name__)

CLOCK_UNSURE = (
    "nothing is tracked before this computer's clock is right: it has reached no time server yet. Where `date` shows "
    "the right time: rotator track --clock-is-right NAME, or step 8 of the page's Setup"
)
NO_PLAN = "there is no plan: the file has no [[sky.follow]]"


class Tracker:
    """`track`, `follow_plan`, `off` and `clock_is_right` may be called from any thread, `step` from one only.

    `clock_trusted`: whether the computer's clock counts as right without a person's word. `why_no_plan`: why there is
    no plan of many passes; empty: there is one. `rest`: as `Follower.rest`.
    """

    def __init__(
        self,
        finder: Finder,
        planner: Planner,
        box: Box,
        clock_trusted: Callable[[], bool],
        *,
        why_no_plan: Callable[[], str] = lambda: NO_PLAN,
        rest: Callable[[], str] = lambda: "",
    ) -> None:
        self._finder = finder
        self._planner = planner
        self._box = box
        self._clock_trusted = clock_trusted
        self._why_no_plan = why_no_plan
        self._rest = rest
        self.clock_told = False
        """A person has said that the clock is right."""
        self._lock = threading.Lock()
        self._tracked = Tracked()
        """Replaced whole, with the lock."""

    @property
    def following(self) -> bool:
        """Whether the tracker leaves the antenna to the plan of many passes."""
        with self._lock:
            return self._tracked.following

    @property
    def wants_new_files(self) -> bool:
        """Whether the files of elements must be read again before the next `step`."""
        return self._tracked.looks_again

    def read_new_files(self) -> None:
        """The files of elements have been read again."""
        with self._lock:
            self._tracked = self._tracked.with_new_files()

    def heard(self, source: Source, order: Order) -> None:
        """An order of any sender. After a stop nothing begins again by itself, not even a plan in work."""
        status = self._box.status()
        if source != TRACK and ends_tracking(order, status):
            with self._lock:
                self._tracked = self._tracked.stopped(source, order)
        elif isinstance(order, Release) and status.faults:
            with self._lock:
                self._tracked = self._tracked.goes_on()

    # --- from a console

    @property
    def state(self) -> str:
        """`off`, `planning`, `tracking`, or `ended: ` and the reason. `rests: `, and why the plan is not flown.

        `refused: ` and the reason: the latest request cannot be tracked, and the tracking before it goes on. While
        it is `tracking`, the status shows this flight, not the one before it.
        """
        status = self._box.status()
        with self._lock:
            text, following = self._tracked.text(status), self._tracked.following
        rest = self._rest() if text == "off" and following else ""
        return f"rests: {rest}" if rest else text

    @property
    def goes_on_with(self) -> str:
        """What a stop or another sender has ended: a person's words, or `plan`; empty: nothing."""
        with self._lock:
            words, rests = self._tracked.goes_on_with, self._tracked.following and self._tracked.of_plan
        return words or ("plan" if rests and self._rest() else "")

    def track(self, words: str) -> str:
        """Begin to track. Returns why not; empty: it tracks."""
        try:
            wanted = self._finder.find(words)
        except Unknown as fault:
            if not (self.clock_trusted() and self._finder.has_news()):
                return str(fault)
            self._begin(Request(words), follows=self._tracked.follows, looks_again=True)
            return ""
        except NotThere as fault:
            return str(fault)
        if isinstance(wanted, Aim):
            if refused := self._box.refusal(wanted):
                return refused
            self._begin(NOTHING, follows=self._tracked.follows)
            with self._lock:
                self._order(wanted)
            return ""
        if not self.clock_trusted():
            return CLOCK_UNSURE
        self._begin(Request(words), follows=self._tracked.follows)
        return ""

    def program(self, table: TimedTable) -> str:
        """Begin to track a timed table, once. Returns why not; empty: it tracks."""
        if table.utc and not self.clock_trusted():
            return CLOCK_UNSURE
        self._begin(Request(table.name, Program(table, self._box.status().at_s)), follows=self._tracked.follows)
        return ""

    def demo(self, zone: str, times: int) -> str:
        """Begin to fly the demo pass over the continent of this time zone. Returns why not; empty: it flies."""
        try:
            program = demo_program(zone, times, self._box.antenna(), self._box.status().at_s)
        except CannotFly as reason:
            return str(reason)
        self._begin(Request(program.table.name, program), follows=self._tracked.follows)
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
            self._tracked = self._tracked.requested(NOTHING, mover, follows=True)
            # With the lock: a flight of the plan that is ordered from now on comes after this stop.
            if not self._tracked.of_plan:
                self._stop()
        return ""

    def off(self) -> None:
        """End the tracking. The antenna stops if the tracker moves it."""
        self._begin(NOTHING, follows=False)
        self._stop()

    def fly_planned(self, flight: Fly) -> bool:
        """Order a flight of the plan of many passes. Returns whether that plan still has the antenna."""
        with self._lock:
            if not self._tracked.following:
                return False
            self._order(flight, of_plan=True)
            return True

    def end_planned(self) -> None:
        """End a flight of the plan of many passes. The antenna stops if the tracker moves it."""
        with self._lock:
            if self._tracked.following and self._tracked.of_plan:
                self._stop()

    def fail(self, reason: str) -> None:
        """End the tracking because of a bug of the program. The antenna stops if the tracker moves it."""
        with self._lock:
            words, asked = self._tracked.request.words, self._tracked.asked
        if words:
            self._end(asked, words, reason)
        self._stop()

    def clock_is_right(self) -> None:
        if not self.clock_told:
            log.info("a person says that this computer's clock is right: it counts as right to %g s", ASSUMED_ERROR_S)
        self.clock_told = True

    def clock_trusted(self) -> bool:
        """Whether the clock is right, as the system or a person says."""
        return self.clock_told or self._clock_trusted()

    def _begin(self, request: Request, *, follows: bool, looks_again: bool = False) -> None:
        mover = self._box.status().controlled_by
        with self._lock:
            self._tracked = self._tracked.requested(request, mover, follows=follows, looks_again=looks_again)

    def _order(self, order: Order, *, of_plan: bool = False) -> None:
        """The caller holds the lock, so no request can come between its last check and this order."""
        self._tracked = self._tracked.ordered(self._box.status().at_s, of_plan=of_plan)
        self._box.order(order)

    def _stop(self) -> None:
        """Stop the antenna if the tracker moves it or has just ordered a motion."""
        if self._tracked.moves(self._box.status()):
            self._box.order(Stop(BOTH))

    # --- from its thread

    def step(self, now: Now) -> None:
        """Do what is due now. May compute for seconds."""
        with self._lock:
            tracked = self._tracked
        if not tracked.request.words:
            return
        status = self._box.status()
        if reason := tracked.reason_to_end(status, now):
            self._end(tracked.asked, tracked.request.words, reason)
        elif tracked.plan_is_due(status, now):
            self._fly(tracked.request, tracked.asked, now)

    def _fly(self, request: Request, asked: int, now: Now) -> None:
        try:
            flight, wanted = _plan_of(request, self._finder, self._planner, self._box.antenna(), now)
        except (Unknown, NotThere, NeverRises, CannotFly, RuntimeError) as reason:
            self._refuse(asked, request, str(reason))
            return
        status = self._box.status()
        with self._lock:
            # The plan took seconds: another request, a stop or another sender may have come meanwhile.
            if asked != self._tracked.asked or self._tracked.held or status.latched:
                return
            taken = self._tracked.taken_by(status)
            if not taken:
                self._tracked = self._tracked.flies(Flown(flight, now, status.at_s, wanted))
                self._order(flight.order)
        if taken:
            self._end(asked, request.words, f"{taken} moves the antenna")

    def _refuse(self, asked: int, request: Request, reason: str) -> None:
        """The request cannot be planned. The tracking before it goes on; a flight of the request itself ends."""
        with self._lock:
            if asked != self._tracked.asked:
                return
            before = self._tracked.before
            self._tracked = self._tracked.cannot_be_planned(reason)
        if before.words:
            log.warning("%s is not tracked: %s; %s goes on", request.words, reason, before.words)
            return
        log.warning("tracking of %s has ended: %s", request.words, reason)
        if request.flown is not None and self._box.status().flown is not None:
            self._stop()

    def _end(self, asked: int, words: str, reason: str) -> None:
        with self._lock:
            if asked != self._tracked.asked:
                return
            self._tracked = self._tracked.ends(reason, left=self._tracked.request)
        log.warning("tracking of %s has ended: %s", words, reason)


def _plan_of(
    request: Request, finder: Finder, planner: Planner, antenna: Antenna | None, now: Now
) -> tuple[NextFlight, Wanted | None]:
    """The next flight, and its target; None: a table has none. `antenna` None: its angles are not known.

    Raises as `Planner.plan` and `Planner.plan_program`.
    """
    if antenna is None:
        raise NotThere("the antenna's angles are not known")
    if request.program:
        return planner.plan_program(request.program, antenna, now), None
    wanted = _wanted(request, finder)
    return planner.plan(wanted, antenna, now), wanted


def _wanted(request: Request, finder: Finder) -> Wanted:
    """While the file of the elements is gone: the target of the flight before. Raises Unknown, NotThere."""
    try:
        if isinstance(wanted := finder.find(request.words), Wanted):
            return wanted
        raise Unknown(f'"{request.words}" is no moving target any more')  # without its file: a direction
    except Unknown as reason:
        before = request.flown.wanted if request.flown else None
        if before is None:
            raise
        log.warning("%s; it is tracked on with the elements read before", reason)
        return before
