"""Flies the plan of many passes: one after the other, while no other sender has the antenna.

Knows the last order of another sender, and pauses after it. A target that a person names comes before the plan
(`tracker`). The plan itself is computed elsewhere.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable
from typing import Protocol

from rotator.control.rights import QUIET, deed_of
from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.orders import Aim, GiveBack, Mode, Order, Release
from rotator.exchange.sources import Source
from rotator.exchange.status import Status, time_left
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.tracking.next_flight import NextFlight, Now, Upcoming, WantedOften
from rotator.tracking.ports import TRACK, Box
from rotator.tracking.tracked import Flown
from rotator.tracking.tracker import CLOCK_UNSURE, Tracker

log = logging.getLogger(__name__)

REST_S = 600.0
"""Seconds without an order of another sender, before the plan goes on."""
AGAIN_S = 600.0
"""Seconds until the plan is made again: elements and clock may have changed."""
LOOKS_S = 10.0
"""Seconds between two looks whether the elements have a target of the plan."""
FAILED_S = 60.0
"""Seconds until the next try after a plan that could not be made."""
NOT_YET_S = 5.0
"""Seconds until the next try if an angle or the elements are not known yet."""


class FollowPlanner(Protocol):
    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        """Raises NotThere, Unknown; RuntimeError where the plan could not be made."""


class Follower:
    """`heard` may be called from any thread, `step` from one only. `followed`: the targets of the configuration.

    `begun_s`: when the program began, on the loop's clock. The last sender before that is not known, so the plan pauses
    first. None: a simulated antenna, which an earlier program cannot have moved.
    """

    def __init__(
        self,
        tracker: Tracker,
        planner: FollowPlanner,
        box: Box,
        followed: Callable[[], tuple[WantedOften, ...]],
        begun_s: float | None = None,
    ) -> None:
        self._tracker = tracker
        self._planner = planner
        self._box = box
        self._followed = followed
        self._rests_until_s = 0.0 if begun_s is None else begun_s + REST_S
        """On the loop's clock."""
        self._rests_after = "after its start"
        self._follows_any = False
        self._asked_s = -math.inf
        """The last look whether there is a target, on the loop's clock."""
        self.rest = ""
        """Why no pass is flown now, if no other display tells it; empty: a pass is flown, or there is no plan."""
        self._again_utc_s = 0.0
        """When to plan next."""
        self.upcoming: tuple[str, float] | None = None
        """The next pass of the plan, and when it rises, in seconds since 1970; None: none is known."""
        self._changed = False
        self._flown: Flown | None = None
        self._lock = threading.Lock()
        """Makes "check the last sender, then order the flight" one step: no other order is heard in between."""

    def heard(self, source: Source, order: Order) -> None:
        """An order of any sender. When a person gives the antenna back, the plan goes on at once."""
        # The tracker orders an Aim only where a person asked for a direction; a flight is its own. A release after a
        # fault lets the plan go on too.
        goes_on = isinstance(order, Release) and not self._box.status().latched
        if (source != TRACK or isinstance(order, Aim)) and deed_of(order) not in QUIET and not goes_on:
            rest_s = 0.0 if isinstance(order, GiveBack) else REST_S
            with self._lock:
                self._rests_until_s = self._box.status().at_s + rest_s
                self._rests_after = f"after an order of {source if source != TRACK else 'a person'}"

    def plan_again(self) -> None:
        """From any thread: the targets or their priorities have changed. The present pass is flown to its end."""
        self._changed = True

    def step(self, now: Now) -> None:
        """Do what is due now. May compute for seconds."""
        if self._changed:
            self._changed, self._again_utc_s = False, now.utc_s
        status = self._box.status()
        self.rest = self._why_at_rest(now)
        if not self._may_fly(status, now):
            self._flown, self._again_utc_s, self.upcoming = None, now.utc_s, None
            return
        if self._flown is not None:
            if reason := self._flown.lost(status, now):
                log.warning("the plan rests: %s", reason)
                self._rests_until_s, self._rests_after = now.loop_s + REST_S, f"because {reason}"
            elif self._flown.clock_was_set(now):
                self._fly_anew(now)
            elif now.utc_s >= self._flown.flight.end_utc_s:
                self._flown, self._again_utc_s = None, now.utc_s
            return
        if now.utc_s >= self._again_utc_s or self._again_utc_s > now.utc_s + AGAIN_S + 1.0:
            self._plan(now)

    def _fly_anew(self, now: Now) -> None:
        """The clock was set: fly what the plan has for the new time. If that is nothing, the antenna stops."""
        log.warning("the clock was set: the plan of many passes is made again")
        self._flown = None
        self._plan(now)
        if self._flown is None:
            self._tracker.end_planned()

    def _why_at_rest(self, now: Now) -> str:
        """A stop, a fault or a holder of the antenna is on every display, and needs no word here."""
        left_s = self._rests_until_s - now.loop_s
        if not self._tracker.following or (left_s <= 0.0 and self._tracker.clock_trusted()):
            return ""
        if not 0.0 <= now.loop_s - self._asked_s < LOOKS_S:
            self._asked_s, self._follows_any = now.loop_s, bool(self._followed())
        if not self._follows_any:
            return ""
        if not self._tracker.clock_trusted():
            return CLOCK_UNSURE
        return f"the plan rests for {time_left(left_s)} more, {self._rests_after}"

    def _may_fly(self, status: Status, now: Now) -> bool:
        return (
            self._tracker.following
            and self._tracker.clock_trusted()
            and now.loop_s >= self._rests_until_s
            and not status.latched
            and not status.held_by
            and status.mode is Mode.AUTO
            and not status.faults
        )

    def _plan(self, now: Now) -> None:
        antenna, followed = self._box.antenna(), self._followed()
        if antenna is None or not followed:
            self._again_utc_s = now.utc_s + NOT_YET_S
            return
        self._again_utc_s = now.utc_s + AGAIN_S
        try:
            upcoming = self._planner.plan_followed(followed, antenna, now)
        except (Unknown, NotThere, RuntimeError) as reason:
            log.warning("the plan of many passes could not be made: %s", reason)
            self._again_utc_s = now.utc_s + FAILED_S
            return
        self.upcoming = (upcoming.name, upcoming.rises_utc_s) if upcoming else None
        if upcoming is None:
            return
        self._again_utc_s = min(self._again_utc_s, upcoming.set_off_utc_s)
        if upcoming.flight is not None and self._fly(upcoming.flight, now):
            log.info("the plan's next pass: %s", upcoming.flight.order.name)

    def _fly(self, flight: NextFlight, now: Now) -> bool:
        """Order the flight, unless a stop or another sender came since the plan began. Returns whether it is flown."""
        with self._lock:
            status = self._box.status()
            if not self._may_fly(status, now):
                return False
            if not self._tracker.fly_planned(flight.order):
                return False
            self._flown = Flown(flight, now, status.at_s)
            return True
