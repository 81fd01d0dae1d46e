"""The box that hears a program's orders, in simulated time: its listener, and what came of it.

Knows the UTC at which the rehearsal happens, and how long a plan takes on a Pi. In the running box a thread does this.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from firmware_sim.clock import SimClock
from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Order
from rotator.exchange.sources import Source
from rotator.orbits.sight import Target
from rotator.runtime.loop import ControlLoop
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import NextFlight, Now, Wanted, next_flight, rest_flight
from rotator.tracking.ports import Box
from rotator.tracking.program import Program, program_flight

COMPUTING_S = 0.6
"""Seconds from an order until the listener's thread has looked at it, and has planned."""


class PlansAtOnce:
    """`rotator.tracking.ports.Planner`. In simulated time a plan takes none; the running box has a process for it."""

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        return next_flight(wanted, antenna, now)

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        return program_flight(program, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return rest_flight(wanted, antenna, now)


@dataclass(frozen=True, slots=True)
class Named:
    """The satellite that the box has named on its displays, and when: seconds after the stream began."""

    name: str
    after_s: float


class Overhearing:
    """`utc`: the true time. `wanted`: names of the satellites that the configuration follows."""

    def __init__(
        self,
        loop: ControlLoop,
        sky: KnownSky,
        box: Box,
        clock: SimClock,
        utc: Callable[[], float],
        *,
        wanted: Sequence[str] = (),
    ) -> None:
        self._loop = loop
        self._satellites = sky.satellites()
        self._clock = clock
        self._utc = utc
        self._listener = StreamListener(sky, PlansAtOnce(), box, utc, lambda: True, wanted=lambda: wanted)
        self._due_s: deque[float] = deque()
        self._first_s: float | None = None
        self._true: Target | None = None
        self.named: Named | None = None
        """The first satellite that was named."""
        loop.overhear(self._hear)
        clock.add_alarm(lambda: self._due_s[0] if self._due_s else None, self._listen)

    def look(self) -> None:
        """After each cycle: whether the displays name a satellite."""
        name = self._loop.status.recognised
        if name and self.named is None and self._first_s is not None:
            self.named = Named(name, self._clock() - self._first_s)
            self._true = next(each for each in self._satellites if each.name == name)

    def true_direction(self, now_s: float) -> tuple[float, float] | None:
        """The true direction of the satellite that the displays have named; None: they have named none."""
        if self._true is None:
            return None
        seen = self._true.sight(self._utc() + now_s - self._clock())
        return seen.azimuth_deg, seen.elevation_deg

    def _hear(self, source: Source, order: Order) -> None:
        if self._first_s is None:
            self._first_s = self._clock()
        self._listener.hear(source, order)
        self._due_s.append(self._clock() + COMPUTING_S)

    def _listen(self, now_s: float) -> None:
        self._due_s.popleft()
        self._listener.step(lambda: Now(self._utc(), now_s))
