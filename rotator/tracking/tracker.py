"""Tracks one target from pass to pass: what a person asked for, the plan that is flown, and when a new one is due.

Knows the status of the box, and gives orders as a link does. Another sender that takes the antenna ends it. Plans are
computed elsewhere, for that takes long. Moments are arguments.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from rotator.control.sky.flight_plan import Antenna
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.orders import BOTH, Aim, Fly, LetGo, Order, Park, Release, SetMode, Source, Stop
from rotator.status import Status
from rotator.tracking.next_flight import NeverRises, NextFlight, Now, Wanted

log = logging.getLogger(__name__)

TRACK = Source("track")
PLAN = "plan"
"""In place of a target: the plan of many passes."""
TAKES_EFFECT_S = 2.0
"""So soon after its order the antenna is seen to be this room's."""
JUMPED_S = 0.25
"""A clock that was set by more makes a new plan."""
FRESH_S = 600.0
BEFORE_S = 120.0
"""A plan that is older than `FRESH_S` is made again so long before its pass, with the newest elements."""
CLOCK_UNSURE = (
    "nothing is tracked before this computer's clock is right: it has reached no time server yet. Where `date` shows "
    "the right time: rotator track --clock-is-right NAME"
)


class Planner(Protocol):
    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises NeverRises, NotThere, Unknown; RuntimeError where the plan could not be made."""

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        """What is left of a pass that is on. Raises NotThere, RuntimeError."""


class Finder(Protocol):
    def find(self, words: str) -> Wanted | Aim:
        """A target that moves, or a fixed direction. Raises Unknown, NotThere."""


class Box(Protocol):
    """The box, as this room sees it. No call waits."""

    def status(self) -> Status: ...

    def antenna(self) -> Antenna | None:
        """As it stands; None: its angles are not known."""

    def order(self, order: Order, source: Source = TRACK) -> None: ...


@dataclass(frozen=True, slots=True)
class Flown:
    """A flight that has been ordered. `planned`: when its plan was begun; `ordered_s`: on the loop's clock."""

    flight: NextFlight
    planned: Now
    ordered_s: float


class Tracker:
    """`track`, `off` and `clock_is_right` may be called from any thread, `step` from one only.

    `clock_trusted`: whether the system says that its clock is set.
    """

    def __init__(self, finder: Finder, planner: Planner, box: Box, clock_trusted: Callable[[], bool]) -> None:
        self._finder = finder
        self._planner = planner
        self._box = box
        self._clock_trusted = clock_trusted
        self._clock_told = False
        """A person has said that the clock is right."""
        self._lock = threading.Lock()
        self._words = ""
        """What a person asked for; empty: nothing is tracked."""
        self._asked = 0
        """How many requests there were: a plan for an earlier one is not flown."""
        self._flown: Flown | None = None
        self._held_by = ""
        """Who has stopped the antenna, or has let it go on after a stop or a fault, since the request."""
        self._mover = ""
        """Who moved the antenna at the request."""
        self._ended = ""
        """Why the latest tracking has ended by itself."""
        self._follows = True
        """The plan of many passes may be flown; `off` ends that, `plan` begins it again."""

    @property
    def following(self) -> bool:
        """Whether the plan of many passes has the antenna, as far as this room is concerned."""
        with self._lock:
            return self._follows and not self._words

    def heard(self, source: Source, order: Order) -> None:
        """An order of any sender. What a stop has ended does not begin by itself, also where a plan is under way."""
        match order:
            case Stop() | SetMode() | LetGo() | Release() | Park(storm=True) if source != TRACK:
                with self._lock:
                    self._held_by = str(source)

    # --- from a console

    @property
    def state(self) -> str:
        """`off`, `planning`, `tracking`, or `ended: ` and the reason."""
        with self._lock:
            if self._words:
                return "tracking" if self._flown else "planning"
            return f"ended: {self._ended}" if self._ended else "off"

    def track(self, words: str) -> str:
        """Begin to track. Returns why not; empty: it does. `plan`: what the configuration follows."""
        if words == PLAN:
            self._begin("", follows=True)
            return ""
        try:
            wanted = self._finder.find(words)
        except (Unknown, NotThere) as reason:
            return str(reason)
        if isinstance(wanted, Aim):
            self._begin("", follows=self._follows)
            self._box.order(wanted)
            return ""
        if not self.clock_trusted():
            return CLOCK_UNSURE
        self._begin(words, follows=self._follows)
        return ""

    def off(self) -> None:
        """End it. The antenna stops, where this room moves it."""
        self._begin("", follows=False)
        if self._box.status().controlled_by == str(TRACK):
            self._box.order(Stop(BOTH))

    def clock_is_right(self) -> None:
        self._clock_told = True

    def clock_trusted(self) -> bool:
        """By the system, or by a person's word."""
        return self._clock_told or self._clock_trusted()

    def _begin(self, words: str, *, follows: bool) -> None:
        mover = self._box.status().controlled_by
        with self._lock:
            self._words, self._flown, self._ended, self._follows = words, None, "", follows
            self._held_by, self._mover = "", mover
            self._asked += 1

    # --- from its thread

    def step(self, now: Now) -> None:
        """Look once. It may compute for seconds."""
        with self._lock:
            words, asked, flown, held_by = self._words, self._asked, self._flown, self._held_by
        if not words:
            return
        if held_by:
            self._end(asked, words, f"{held_by} stopped it, or let it go on")
        elif flown is not None and (reason := lost(flown, self._box.status(), now)):
            self._end(asked, words, reason)
        elif flown is None or _is_over(flown, now):
            self._fly(words, asked, now)

    def _fly(self, words: str, asked: int, now: Now) -> None:
        antenna = self._box.antenna()
        if antenna is None:
            self._end(asked, words, "the antenna's angles are not known")
            return
        try:
            wanted = self._finder.find(words)
            if isinstance(wanted, Aim):  # the words mean a direction now: a file of elements has gone
                raise Unknown(f'"{words}" is no moving target any more')
            flight = self._planner.plan(wanted, antenna, now)
        except (Unknown, NotThere, NeverRises, RuntimeError) as reason:
            self._end(asked, words, str(reason))
            return
        status = self._box.status()
        with self._lock:
            # The plan took a while: another request, a stop or another sender may have come since.
            if asked != self._asked or self._held_by or status.latched:
                return
            taken = status.controlled_by not in (str(TRACK), self._mover)
            if not taken:
                self._flown, self._mover = Flown(flight, now, status.at_s), str(TRACK)
                self._box.order(flight.order)
        if taken:
            self._end(asked, words, f"{status.controlled_by} moves the antenna")

    def _end(self, asked: int, words: str, reason: str) -> None:
        with self._lock:
            if asked != self._asked:
                return
            self._words, self._flown, self._ended = "", None, reason
        log.warning("tracking of %s has ended: %s", words, reason)


def _is_over(flown: Flown, now: Now) -> bool:
    """Whether a new plan is due."""
    if now.utc_s >= flown.flight.end_utc_s or abs(now.apart_s - flown.planned.apart_s) > JUMPED_S:
        return True
    before_s = flown.flight.begin_utc_s - BEFORE_S
    return flown.planned.utc_s < before_s - FRESH_S and now.utc_s >= before_s


def lost(flown: Flown, status: Status, now: Now) -> str:
    """Why the antenna is not this room's any more; empty: it is."""
    if status.at_s < flown.ordered_s + TAKES_EFFECT_S or now.utc_s >= flown.flight.end_utc_s - 1.0:
        return ""
    if status.latched:
        return f"stopped by {status.latched}"
    if status.controlled_by != str(TRACK):
        return f"{status.controlled_by} moves the antenna" if status.controlled_by else "the antenna was stopped"
    return "the antenna was stopped" if status.flown is None else ""
