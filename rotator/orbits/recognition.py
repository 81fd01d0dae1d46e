"""Which satellite a program's orders follow, and when they leave it again.

Knows the orders of each connection, the moments at which they came, and the satellites that may be meant. `explaining`
decides whether one of these explains them. Knows nothing of the rotor, and reads no clock. An order costs some
milliseconds, so this has no place in the control loop.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from rotator.exchange.flight_order import Fly, Stream, TakeTurn
from rotator.exchange.orders import S_BEFORE_P_S, Aim, Calibrate, ClearTimed, Leave, Order, Release, Remark, Speed, Stop
from rotator.exchange.program_clock import ProgramClock
from rotator.exchange.sources import Source
from rotator.orbits.chance import MOST_LIKELY, Known
from rotator.orbits.explaining import Explained, explained
from rotator.orbits.rising import LOWEST_DEG, Rising, Soon, soon_rising, waits_for
from rotator.orbits.sight import NotThere, Sight, Target
from rotator.orbits.stream_fit import CLOCKS_S, FASTEST_DPS, LONGEST_GAP_S, Heard, HeardOrders, SampledPath

AGAIN_S = 2.0
"""Seconds until the next fit if as many orders as are kept have shown no satellite."""
SIEVE_EVERY_S = 10.0
SIEVE_DEG = 2 * FASTEST_DPS * SIEVE_EVERY_S
"""Degrees: a satellite further from the order than this is left out until the next sieving."""


@dataclass(frozen=True, slots=True)
class Recognised:
    """The orders of this source follow this satellite. A flight that replaces them is posted as `source`'s own."""

    source: Source
    satellite: Target
    stream: Stream


@dataclass(frozen=True, slots=True)
class Departed:
    """The orders of this source have left this satellite."""

    source: Source
    satellite: Target


class StreamWatch:
    """Hears the orders of every source. `satellites`: those that may be meant. `likely`: names of those in use here,
    the most wanted first.
    """

    def __init__(self, satellites: Iterable[Target] = (), likely: Sequence[str] = ()) -> None:
        self._satellites = tuple(satellites)
        self._wanted = likely
        self._used: tuple[str, ...] = ()
        """Names of the satellites that were recognised or flown, the latest first."""
        self._listeners: dict[Source, _Listener] = {}
        self._stopped: dict[Source, tuple[float, _Listener]] = {}
        """Streams that their own source has stopped, and when: its next direction goes on with them if it comes at
        once."""
        self._planners: set[Source] = set()
        """Sources that plan by themselves: they name the turn of the overlap, or flip."""

    def know(self, satellites: Iterable[Target], likely: Sequence[str] = ()) -> None:
        """The elements have changed. A followed satellite keeps its old elements."""
        self._satellites = tuple(satellites)
        self._wanted = likely

    def used(self, name: str) -> None:
        """The station follows this satellite now, so its next pass is likely too."""
        self._used = tuple(dict.fromkeys((name, *self._used)))[:MOST_LIKELY]

    @property
    def _likely(self) -> Sequence[str]:
        return tuple(dict.fromkeys((*self._used, *self._wanted)))[:MOST_LIKELY]

    def followed(self, source: Source) -> Recognised | None:
        """The satellite that the orders of this source follow."""
        listener = self._listeners.get(source)
        return listener.recognised if listener else None

    def rising(self, source: Source) -> Rising | None:
        """The satellite for whose rise the orders of this source seem to wait. It is not recognised yet."""
        listener = self._listeners.get(source)
        return listener.rising if listener else None

    def hear(self, source: Source, order: Order, utc_s: float) -> Recognised | Departed | None:
        """An order came at this time, in seconds since 1970. Returns a new recognition or its end; None: no change."""
        match order:
            case Aim(azimuth_deg, elevation_deg, engaged=True, place=False) if (
                azimuth_deg is not None
                and elevation_deg is not None
                and 0 <= azimuth_deg <= 360
                and 0 <= elevation_deg <= 90
            ):
                if source in self._planners:
                    return None
                stopped_s, listener = self._stopped.pop(source, (-math.inf, None))
                if listener is not None and utc_s - stopped_s <= S_BEFORE_P_S:
                    self._listeners[source] = listener
                if source not in self._listeners:
                    self._forget_silent(utc_s)
                    self._listeners[source] = _Listener(source)
                heard = Heard(utc_s, azimuth_deg % 360.0, elevation_deg)
                news = self._listeners[source].hear(heard, self._satellites, self._likely)
                if isinstance(news, Recognised):
                    self.used(news.satellite.name)
                return news
            case Speed() | ClearTimed() | Calibrate() | Release() | Remark() | TakeTurn() | Fly(stream=Stream()):
                return None
            case _:  # it ends the stream
                if isinstance(order, Leave):
                    self._planners.discard(source)
                elif isinstance(order, Aim) and ((order.azimuth_deg or 0) > 360 or (order.elevation_deg or 0) > 90):
                    self._planners.add(source)
                listener = self._listeners.pop(source, None)
                if listener is not None and isinstance(order, Stop) and not order.latch:
                    self._stopped[source] = utc_s, listener
                followed = listener.recognised if listener else None
                return Departed(source, followed.satellite) if followed else None

    def _forget_silent(self, utc_s: float) -> None:
        self._stopped = {source: each for source, each in self._stopped.items() if each[0] > utc_s - S_BEFORE_P_S}
        self._listeners = {
            source: each for source, each in self._listeners.items() if each.last_s > utc_s - LONGEST_GAP_S
        }


class _Listener:
    """The orders of one source."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._orders = HeardOrders()
        self._near: list[SampledPath] = []
        """Paths of the satellites that may come near the orders before the next sieving."""
        self._known = self._up = Known(0, 0)
        self._sieved_s = -math.inf
        self._next_s = -math.inf
        """Earliest time of the next fit."""
        self._followed: SampledPath | None = None
        self._clock: ProgramClock | None = None
        self._soon: list[Soon] = []
        """Satellites that rise soon."""
        self.recognised: Recognised | None = None
        self.rising: Rising | None = None
        """The satellite for whose rise the orders seem to wait."""

    @property
    def last_s(self) -> float:
        return self._orders.last_s

    def hear(self, order: Heard, satellites: Sequence[Target], likely: Collection[str]) -> Recognised | Departed | None:
        if self._orders.begin_anew(order):
            self._sieved_s = self._next_s = -math.inf
        elif self._orders.too_soon(order):
            return self._departed(order)
        self._orders.add(order)
        if self.recognised is not None:
            return self._departed(order)
        self._sieve(order, satellites, likely)
        orders = self._orders.all
        self.rising = self._waits_for(orders, likely)
        if not self._orders.enough or not self._near or order.utc_s < self._next_s:
            return None
        if self._orders.full:
            self._next_s = order.utc_s + AGAIN_S
        found = explained(orders, self._near, self._known, self._up, likely)
        return self._recognise(found) if found else None

    def _sieve(self, order: Heard, satellites: Sequence[Target], likely: Collection[str]) -> None:
        """Keep the satellites that may come near the orders."""
        if order.utc_s - self._sieved_s < SIEVE_EVERY_S:
            return
        self._sieved_s = order.utc_s
        known = {path.satellite: path for path in self._near}
        seen = [(each, sight) for each in satellites if (sight := _sight(each, order.utc_s)) is not None]
        # Further below the horizon it does not matter before the next sieving.
        up = [(each, sight) for each, sight in seen if sight.elevation_deg > -FASTEST_DPS]
        near = [each for each, sight in up if sight.apart_deg(order.direction) <= SIEVE_DEG]
        with suppress(NotThere):
            in_use = [each for each in satellites if each.name in likely]
            self._soon = soon_rising(order, seen, in_use) if order.elevation_deg == 0 else []
        self._near = [known.get(each) or SampledPath(each) for each in near]
        self._known = Known(len(satellites), sum(each.name in likely for each in satellites))
        self._up = Known(len(up), sum(each.name in likely for each, _ in up))
        for path in self._near:
            path.forget_before(self._orders.first_s + CLOCKS_S[0] - 1)

    def _waits_for(self, orders: Sequence[Heard], likely: Collection[str]) -> Rising | None:
        with suppress(NotThere):
            return waits_for(orders, self._soon, self._known, likely)
        return None

    def _recognise(self, found: Explained) -> Recognised:
        self._followed, self._clock = found.path, ProgramClock(found.clocks_s, found.rounding_deg)
        stream = Stream(found.rounding_deg, ahead_s=(found.clocks_s[0], found.clocks_s[-1]))
        self.recognised = Recognised(self._source, found.path.satellite, stream)
        return self.recognised

    def _departed(self, order: Heard) -> Departed | None:
        """Whether an order is too far from the followed path, for each possible error of the program's clock."""
        path, clock = self._followed, self._clock
        if self.recognised is None or path is None or clock is None:
            return None
        if clock.agrees(lambda clock_s: _apart_deg(path, order, clock_s)):
            path.forget_before(self._orders.first_s + CLOCKS_S[0] - 1)
            return None
        departed = Departed(self._source, self.recognised.satellite)
        self._followed = self.recognised = None
        return departed


def _sight(satellite: Target, utc_s: float) -> Sight | None:
    """Its direction. None: it is not up, and does not rise soon."""
    try:
        sight = satellite.sight(utc_s)
    except NotThere:
        return None
    return sight if sight.elevation_deg > LOWEST_DEG else None


def _apart_deg(path: SampledPath, order: Heard, clock_s: float) -> float:
    try:
        return order.direction.apart_deg(path.sight(order.utc_s + clock_s))
    except NotThere:
        return math.inf
