"""Hears the orders of every link. If they follow a satellite, it orders the flight of that pass.

Knows times and sources. `rotator.orbits` recognises the satellite, and how surely. Control decides whether the flight
replaces the stream, because the stream has sent further orders meanwhile.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

from rotator.exchange.flight_order import TakeTurn
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Source
from rotator.orbits.recognition import Recognised, StreamWatch
from rotator.orbits.rising import Rising
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.next_flight import NeverRises, Now, Wanted
from rotator.tracking.ports import Box, Planner

log = logging.getLogger(__name__)

MOST_WAITING = 500
"""Orders kept for the next step; in a flood the oldest are lost."""

AGAIN_S = 30.0
"""Seconds from one plan to the next for the same stream. A second plan is needed if the flight ended and the stream
goes on: a person took the antenna and gave it back."""

LED_S = 15.0
"""Seconds after the rise in which the stream stays on the chosen turn. By then its satellite is recognised, or is
another one."""
SAME_RISE_S = 60.0
"""Rises of one satellite that are less apart are one rise, computed twice."""


class StreamListener:
    """`hear` may be called from any thread and never waits; `step` and `know` from one thread only.

    `wanted`: names of the satellites that the configuration follows, the most wanted first.
    """

    def __init__(
        self,
        sky: KnownSky,
        planner: Planner,
        box: Box,
        utc: Callable[[], float],
        clock_trusted: Callable[[], bool],
        *,
        wanted: Callable[[], Sequence[str]] = tuple,
    ) -> None:
        self._sky = sky
        self._planner = planner
        self._box = box
        self._utc = utc
        self._clock_trusted = clock_trusted
        self._heard: deque[tuple[Source, Order, float]] = deque(maxlen=MOST_WAITING)
        self._wanted = wanted
        self._watch = StreamWatch(sky.satellites(), wanted())
        self._planned: Recognised | None = None
        """The satellite of the last plan, and when it was planned, on the loop's clock."""
        self._planned_s = 0.0
        self._led: dict[Source, Rising] = {}
        """By source: the rise for which the turn of azimuth was last chosen."""

    def hear(self, source: Source, order: Order) -> None:
        self._heard.append((source, order, self._utc()))

    def know(self) -> None:
        """The elements have changed."""
        self._watch.know(self._sky.satellites(), self._wanted())

    def step(self, clock: Callable[[], Now]) -> None:
        """Process the orders heard. May compute for seconds."""
        if (flown := self._box.status().flown) is not None:
            self._watch.used(flown.name)
        moved: set[Source] = set()
        while self._heard:
            source, order, utc_s = self._heard.popleft()
            self._watch.hear(source, order, utc_s)
            if isinstance(order, Aim):
                moved.add(source)
        for source in moved:
            if not self._clock_trusted():
                continue
            if (found := self._watch.followed(source)) is not None:
                self._keep_flown(found, clock())
            elif (rising := self._watch.rising(source)) is not None:
                self._choose_turn(rising, source, clock())

    def _keep_flown(self, found: Recognised, now: Now) -> None:
        """The stream goes on and moves the antenna: order the flight of its pass, unless it is already flown."""
        status = self._box.status()
        if status.recognised or status.controlled_by != str(found.source):
            return
        if found is self._planned and 0 <= now.loop_s - self._planned_s < AGAIN_S:
            return
        self._planned, self._planned_s = found, now.loop_s
        self._fly(found, now)

    def _choose_turn(self, rising: Rising, source: Source, now: Now) -> None:
        """The stream seems to wait for this rise: follow it on the turn that the whole pass needs. Once for each."""
        led, satellite = self._led.get(source), rising.satellite
        if led is not None and led.satellite.name == satellite.name and abs(led.rises_s - rising.rises_s) < SAME_RISE_S:
            return
        antenna, site = self._box.antenna(), self._sky.site
        if antenna is None or site is None or not isinstance(satellite, Satellite):
            return
        if self._box.status().controlled_by != str(source):
            return
        self._led = {kept: each for kept, each in self._led.items() if each.rises_s > now.utc_s} | {source: rising}
        try:
            flight = self._planner.plan(
                Wanted(satellite.name, site.without_air, satellite.elements), antenna, now
            ).order
        except (NeverRises, NotThere, RuntimeError) as reason:
            log.warning("%s seems to wait for the rise of %s; no plan: %s", source, satellite.name, reason)
            return
        log.info("%s seems to wait for the rise of %s: on the turn for this pass", source, satellite.name)
        flipped = antenna.mount.model.over_the_top(flight.elevation.angles_deg[0])
        until_s = rising.rises_s - now.apart_s + LED_S
        self._box.order(TakeTurn(flight.azimuth.angles_deg[0], flipped, until_s), source)

    def _fly(self, found: Recognised, now: Now) -> None:
        antenna, site = self._box.antenna(), self._sky.site
        if antenna is None or site is None or not isinstance(found.satellite, Satellite):
            return
        wanted = Wanted(found.satellite.name, site.without_air, found.satellite.elements)
        try:
            order = self._planner.plan_rest(wanted, antenna, now)
        except (NotThere, RuntimeError) as reason:
            log.warning("%s sends the directions of %s; no plan: %s", found.source, found.satellite.name, reason)
            return
        log.info("%s sends the directions of %s: the box flies its true path", found.source, found.satellite.name)
        self._box.order(replace(order, stream=found.stream), found.source)
