"""Flies the plan of many passes: one after the other, while no other sender has the antenna.

Knows when another sender has ordered last, and rests for a while then. A target that a person names comes before the
plan (`tracker`). What the plan holds is computed elsewhere.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Protocol

from rotator.control.rights import deed_of
from rotator.control.sky.flight_plan import Antenna
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.orders import Mode, Order, Source
from rotator.status import Status
from rotator.tracking.next_flight import Now
from rotator.tracking.next_followed import Upcoming, WantedOften
from rotator.tracking.tracker import TRACK, Box, Flown, Tracker, lost

log = logging.getLogger(__name__)

REST_S = 600.0
"""For so long after the latest order of another sender the plan is not flown on."""
AGAIN_S = 600.0
"""The plan is made anew so often: elements and clock may have changed."""


class FollowPlanner(Protocol):
    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        """Raises NotThere, Unknown; RuntimeError where the plan could not be made."""


class Follower:
    """`heard` may be called from any thread, `step` from one only. `followed`: what the configuration asks for now."""

    def __init__(
        self, tracker: Tracker, planner: FollowPlanner, box: Box, followed: Callable[[], tuple[WantedOften, ...]]
    ) -> None:
        self._tracker = tracker
        self._planner = planner
        self._box = box
        self._followed = followed
        self._rests_until_s = 0.0
        """On the loop's clock."""
        self._again_utc_s = 0.0
        """When to plan next."""
        self._flown: Flown | None = None

    def heard(self, source: Source, order: Order) -> None:
        """An order of any sender."""
        if source != TRACK and deed_of(order) is not None:
            self._rests_until_s = self._box.status().at_s + REST_S

    def step(self, now: Now) -> None:
        """Look once. It may compute for seconds."""
        status = self._box.status()
        if not self._may_fly(status, now):
            self._flown, self._again_utc_s = None, now.utc_s
            return
        if self._flown is not None:
            if reason := lost(self._flown, status, now):
                log.warning("the plan rests: %s", reason)
                self._rests_until_s = now.loop_s + REST_S
            elif now.utc_s >= self._flown.flight.end_utc_s:
                self._flown, self._again_utc_s = None, now.utc_s
            return
        if now.utc_s >= self._again_utc_s or self._again_utc_s > now.utc_s + AGAIN_S + 1.0:
            self._plan(now)

    def _may_fly(self, status: Status, now: Now) -> bool:
        return (
            self._tracker.following
            and self._tracker.clock_trusted()
            and now.loop_s >= self._rests_until_s
            and not status.latched
            and status.mode is Mode.AUTO
            and not status.faults
        )

    def _plan(self, now: Now) -> None:
        self._again_utc_s = now.utc_s + AGAIN_S
        antenna, followed = self._box.antenna(), self._followed()
        if antenna is None or not followed:
            return
        try:
            upcoming = self._planner.plan_followed(followed, antenna, now)
        except (Unknown, NotThere, RuntimeError) as reason:
            log.warning("the plan of many passes could not be made: %s", reason)
            return
        if upcoming is None:
            return
        self._again_utc_s = min(self._again_utc_s, upcoming.set_off_utc_s)
        # The plan took a while: a stop or another sender may have come since.
        status = self._box.status()
        if upcoming.flight is not None and self._may_fly(status, now):
            log.info("the plan's next pass: %s", upcoming.flight.order.name)
            self._flown = Flown(upcoming.flight, now, status.at_s)
            self._box.order(upcoming.flight.order)
