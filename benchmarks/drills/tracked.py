"""Which flights of the box's own may be in force: a target that a person tracks, `[[sky.follow]]`, a recognised stream.

Knows which orders end them by the rules of docs/safety.md and docs/tracking.md: any stop, during a flight or while its
plan is computed; another sender that takes the antenna; `track off`. The judges do not ask where a flight leads, only
whether a flight may be in force. A `resume` ends a flight only if the box has a fault, and no judge asks the box: so a
flight stays excused after a `resume`, until a stop, another target or `track off` ends it. Does not know passes.
"""

from __future__ import annotations

import math

from benchmarks.drills.goals import AxisOrders, Goal, Ranges
from benchmarks.drills.script import LINKS, PAGE, Event

TRACK, FOLLOW = "track", "follow"
RESTS_S = 600.0 - 1.0
"""The plan of many passes is not flown for this time after a stop."""
QUIET_S = 10.5
"""A link that has sent no order for this time is not silenced any more."""
TAKES_S = 1.0
"""An order this soon after `track` may have come before the tracker had the antenna."""


class Tracked:
    """`axes`: the orders in force, into which these flights are entered too. `lacking`: the axis that was never set up;
    it takes part in no flight."""

    def __init__(
        self, axes: dict[str, AxisOrders], ranges: dict[str, Ranges], *, follows: bool, lacking: str = ""
    ) -> None:
        self._axes = {name: orders for name, orders in axes.items() if name != lacking}
        self._ranges = ranges
        self._follows_at_start = self._follows = follows
        self._asked_s: float | None = None
        """When a person asked to track; None: nothing is tracked."""
        self._by_page = False
        """A person on the page asked, and no other sender has sent anything since."""
        self._before: set[str] = set()
        """The senders whose orders were in force then: they may send on until the plan is ready."""
        self._rests_until_s = -math.inf
        self._heard_s: dict[str, float] = {}
        self.recognised: set[str] = set()
        """Programs whose streams may be flown as planned, also when they go on after a stop."""

    def begin_anew(self) -> None:
        """The program starts again: only the targets of its configuration are followed."""
        self._asked_s, self._follows, self._rests_until_s = None, self._follows_at_start, -math.inf
        self._heard_s.clear()
        self.recognised.clear()

    def stopped(self, now_s: float, asked_before_s: float = math.inf) -> None:
        """A stop, a release or a turn of the mode switch: no flight that was requested before begins afterwards."""
        if self._asked_s is not None and self._asked_s < asked_before_s:
            self._asked_s = None
        self._rests_until_s = now_s + RESTS_S

    def page_lost(self, now_s: float) -> None:
        """The page hangs: what a person tracks there ends, also while its plan is computed."""
        if self._by_page and self._asked_s is not None and now_s - self._asked_s > TAKES_S:
            self._end(now_s)

    def note(self, event: Event, *, takes: bool) -> None:
        """Note one order. `takes`: nothing holds back an order of a link."""
        self._by_page = event.who == PAGE and (event.what == "track" or (self._by_page and event.what != "give-back"))
        match event.what:
            case "track" if event.text(0) == "off":
                self._end(event.at_s)
                self._follows = False
            case "track" if event.text(0) == "plan":
                self._follows = True
            case "track":
                self._asked_s = event.at_s
                self._before = {sender for orders in self._axes.values() for sender in orders.goals}
                self.keep(event.at_s)
            case "recognised" | "waits":
                self._recognise(event)
            case "give-back":
                self._rests_until_s = -math.inf  # the plan of the day has the antenna back
            case "stop-axis" | "resume" | "storm":
                self.stopped(event.at_s)
            case "aim" if takes and self._is_new(event):
                self._end(event.at_s)
                self._rests_until_s = event.at_s + RESTS_S
        if event.who in LINKS:
            self._heard_s[event.who] = event.at_s

    def keep(self, now_s: float) -> None:
        """Enter the flights that may be in force now."""
        for orders in self._axes.values():
            if self._asked_s is not None:
                orders.goals.setdefault(TRACK, Goal(said_s=now_s))
            if self._follows and now_s >= self._rests_until_s:
                orders.goals.setdefault(FOLLOW, Goal(said_s=now_s))

    def _end(self, now_s: float) -> None:
        self._asked_s = None
        for orders in self._axes.values():
            flights = [orders.goals.pop(sender, None) for sender in (TRACK, FOLLOW)]
            if any(flights):
                orders.ended_s = now_s

    def _recognise(self, event: Event) -> None:
        self.recognised.add(event.who)
        for orders in self._axes.values():
            if event.who in orders.goals:
                orders.goals[event.who] = Goal(said_s=event.at_s)

    def _is_new(self, event: Event) -> bool:
        """Whether this aim certainly takes the antenna: its link was quiet and did not move the antenna, and the aim is
        within range."""
        quiet = event.at_s - self._heard_s.get(event.who, -math.inf) > QUIET_S
        late = self._asked_s is None or event.at_s > self._asked_s + TAKES_S
        spans = self._ranges["azimuth"], self._ranges["elevation"]
        within = all(span.low_deg + 1.0 < event.number(place) < span.high_deg - 1.0 for place, span in enumerate(spans))
        return event.who in LINKS and quiet and late and within and event.who not in self._before
