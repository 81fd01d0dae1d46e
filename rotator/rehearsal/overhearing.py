"""The listener to a program's orders, in simulated time: it recognises the satellite, and has its pass flown.

Knows the UTC at which the rehearsal happens, and how long a plan takes on a Pi. In the running box a thread does this.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from firmware_sim.clock import SimClock
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.orbits.recognition import Recognised, StreamWatch, rest_of_pass
from rotator.orbits.sight import Target
from rotator.orders import Order, Source
from rotator.runtime.loop import ControlLoop

COMPUTING_S = 0.6
"""From the recognition until the plan is there."""


@dataclass(frozen=True, slots=True)
class Told:
    """The satellite that the box has named on its displays, so long after the stream began."""

    name: str
    after_s: float


class Overhearing:
    """`utc`: the true time. `antenna`: the antenna as it stands now."""

    def __init__(
        self,
        loop: ControlLoop,
        watch: StreamWatch,
        clock: SimClock,
        utc: Callable[[], float],
        antenna: Callable[[], Antenna],
    ) -> None:
        self._loop = loop
        self._watch = watch
        self._clock = clock
        self._utc = utc
        self._antenna = antenna
        self._planned: tuple[float, Recognised] | None = None
        self._first_s: float | None = None
        self._true: Target | None = None
        self.told: Told | None = None
        """The first satellite that was named."""
        loop.overhear(self._hear)
        clock.add_alarm(lambda: self._planned[0] if self._planned else None, self._fly)

    def look(self) -> None:
        """After each cycle: whether the displays name a satellite."""
        name = self._loop.status.recognised
        if name and self.told is None and self._first_s is not None:
            self.told = Told(name, self._clock() - self._first_s)

    def true_direction(self, now_s: float) -> tuple[float, float] | None:
        """Where the satellite really was that was named; None: none was."""
        if self.told is None or self._true is None:
            return None
        seen = self._true.sight(self._utc() + now_s - self._clock())
        return seen.azimuth_deg, seen.elevation_deg

    def _hear(self, source: Source, order: Order) -> None:
        now_s = self._clock()
        if self._first_s is None:
            self._first_s = now_s
        match self._watch.hear(source, order, self._utc()):
            case Recognised() as recognised:
                self._planned = now_s + COMPUTING_S, recognised
                if self.told is None:
                    self._true = recognised.satellite

    def _fly(self, now_s: float) -> None:
        assert self._planned is not None
        _, recognised = self._planned
        self._planned = None
        apart_s = self._utc() - now_s
        rest = rest_of_pass(recognised.satellite, self._utc())
        path = KnownPath(tuple((utc_s - apart_s, az_deg, el_deg) for utc_s, az_deg, el_deg in rest.rows))
        plan = plan_flight(recognised.satellite.name, path, self._antenna(), now_s)
        self._loop.post(recognised.source, replace(plan.order, sets_s=rest.sets_s - apart_s, stream=recognised.stream))
