"""Which satellite a program's orders follow, and when they leave it again.

Knows the orders of each connection, the moments at which they came, and the satellites that may be meant. A satellite
is recognised when its path, by one clock of the program, explains every order to its rounding, when the orders have
moved with it, when no other satellite explains them too, and when chance hardly would. Knows nothing of the rotor, and
reads no clock. An order costs some milliseconds, so this has no place in the control loop.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from rotator.exchange.flight_order import Fly, Stream, TakeTurn
from rotator.exchange.orders import Aim, Calibrate, ClearTimed, Leave, Order, Release, Remark, Speed
from rotator.exchange.program_clock import ProgramClock
from rotator.exchange.sources import Source
from rotator.orbits.chance import (
    LINE_CHANCE,
    MOST_LIKELY,
    RISING_LINE_CHANCE,
    Known,
    has_moved,
    has_told,
    line_chance,
    rising_line_chance,
)
from rotator.orbits.rise_chance import standing_chance
from rotator.orbits.rising import LOWEST_DEG, Rising, Soon, soon_rising, waits_for
from rotator.orbits.sight import NotThere, Sight, Target
from rotator.orbits.stream_fit import (
    CLOCKS_S,
    UNSTEADY_S,
    Heard,
    SampledPath,
    clocks_that_explain,
    rounding_deg,
    telling,
)

ORDERS = 8
FEW_ORDERS, FEW_S = 3, 8.0
"""Orders needed to recognise a satellite. If they come slowly, `FEW_ORDERS` in this time are enough."""
KEPT = 30
"""Orders for which a stream must agree with a path that it meets later, because any line crosses some path."""
AGAIN_S = 2.0
"""Seconds until the next fit if `KEPT` orders have shown no satellite."""
LONGEST_GAP_S = 20.0
"""Seconds: orders further apart are of two streams. Some programs send only when a whole degree has changed."""
THIN_S = 0.9
"""Seconds: if orders come faster, only one in this time counts."""
FASTEST_DPS = 2.0
"""Degrees a second: no satellite crosses the sky faster. Faster orders begin a new stream."""
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
                followed = listener.recognised if listener else None
                return Departed(source, followed.satellite) if followed else None

    def _forget_silent(self, utc_s: float) -> None:
        self._listeners = {
            source: each for source, each in self._listeners.items() if each.last_s > utc_s - LONGEST_GAP_S
        }


class _Listener:
    """The orders of one source."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._orders: deque[Heard] = deque(maxlen=KEPT)
        self._all_kept = True
        """Whether no order was dropped since the stream began."""
        self._near: list[SampledPath] = []
        self._known = Known(0, 0, 0)
        self._likely: Collection[str] = ()
        self._sieved_s = -math.inf
        self._next_s = -math.inf
        """Earliest time of the next fit."""
        self._followed: SampledPath | None = None
        self._clock: ProgramClock | None = None
        self._soon: list[Soon] = []
        self.recognised: Recognised | None = None
        self.rising: Rising | None = None
        """The satellite for whose rise the orders seem to wait."""

    @property
    def last_s(self) -> float:
        return self._orders[-1].utc_s if self._orders else -math.inf

    def hear(self, order: Heard, satellites: Sequence[Target], likely: Collection[str]) -> Recognised | Departed | None:
        if self._orders and self._begins_anew(order):
            self._orders.clear()
            self._all_kept = True
            self._sieved_s = self._next_s = -math.inf
        elif self._orders and order.utc_s - self.last_s < THIN_S:
            return self._departed(order)
        self._all_kept = self._all_kept and len(self._orders) < KEPT
        self._orders.append(order)
        if self.recognised is not None:
            return self._departed(order)
        self._likely = likely
        self._sieve(order, satellites)
        self.rising = self._waits_for()
        enough = _are_enough(self._orders) if self._all_kept else len(self._orders) == KEPT
        if not enough or not self._near or order.utc_s < self._next_s:
            return None
        if len(self._orders) == KEPT:
            self._next_s = order.utc_s + AGAIN_S
        return self._recognise()

    def _begins_anew(self, order: Heard) -> bool:
        last = self._orders[-1]
        gap_s = order.utc_s - last.utc_s
        if not 0 <= gap_s <= LONGEST_GAP_S:
            return True
        return order.direction.apart_deg(last.direction) > FASTEST_DPS * (gap_s + UNSTEADY_S) + 2.0

    def _sieve(self, order: Heard, satellites: Sequence[Target]) -> None:
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
            in_use = [each for each in satellites if each.name in self._likely]
            self._soon = soon_rising(order, seen, in_use) if order.elevation_deg == 0 else []
        self._near = [known.get(each) or SampledPath(each) for each in near]
        likely = sum(each.name in self._likely for each in satellites)
        self._known = Known(len(satellites), likely, len(up))
        for path in self._near:
            path.forget_before(self._orders[0].utc_s + CLOCKS_S[0] - 1)

    def _waits_for(self) -> Rising | None:
        with suppress(NotThere):
            return waits_for(self._orders, self._soon, self._known, self._likely)
        return None

    def _recognise(self) -> Recognised | None:
        orders = list(self._orders)
        rounding = rounding_deg(orders)
        fits = [(path, clocks) for path in self._near if (clocks := _clocks(path, orders, rounding))]
        if len(fits) != 1:
            return None
        path, clocks_s = fits[0]
        told = telling(path, orders)
        if not _are_enough(told):
            return None
        if not has_moved(told):
            # In whole degrees a satellite may stand for 15 s after its rise. Then only place and time identify it.
            allowed = self._known.standing_share(likely=path.satellite.name in self._likely)
            if standing_chance(path, orders, clocks_s, rounding) > allowed:
                return None
        elif not has_told(path, told, rounding) or not self._is_no_chance(path, told, clocks_s, rounding):
            return None
        self._followed, self._clock = path, ProgramClock(clocks_s, rounding)
        self.recognised = Recognised(
            self._source, path.satellite, Stream(rounding, ahead_s=(clocks_s[0], clocks_s[-1]))
        )
        return self.recognised

    def _is_no_chance(
        self, path: SampledPath, told: Sequence[Heard], clocks_s: Sequence[float], rounding: float
    ) -> bool:
        """Whether a line at random hardly fits one of all satellites: in the orders' places, or in place and time of
        their begin."""
        return (
            self._known.up * line_chance(path, told, rounding) <= LINE_CHANCE
            or self._known.all * rising_line_chance(path, told, clocks_s, rounding) <= RISING_LINE_CHANCE
        )

    def _departed(self, order: Heard) -> Departed | None:
        """Whether an order is too far from the followed path, for each possible error of the program's clock."""
        path, clock = self._followed, self._clock
        if self.recognised is None or path is None or clock is None:
            return None
        if clock.agrees(lambda clock_s: _apart_deg(path, order, clock_s)):
            path.forget_before(self._orders[0].utc_s + CLOCKS_S[0] - 1)
            return None
        departed = Departed(self._source, self.recognised.satellite)
        self._followed = self.recognised = None
        return departed


def _are_enough(orders: Sequence[Heard]) -> bool:
    return len(orders) >= ORDERS or (
        len(orders) >= FEW_ORDERS and orders[-1].utc_s - orders[0].utc_s >= FEW_S - UNSTEADY_S
    )


def _sight(satellite: Target, utc_s: float) -> Sight | None:
    """Its direction. None: it is not up, and does not rise soon."""
    try:
        sight = satellite.sight(utc_s)
    except NotThere:
        return None
    return sight if sight.elevation_deg > LOWEST_DEG else None


def _clocks(path: SampledPath, orders: Sequence[Heard], rounding: float) -> tuple[float, ...]:
    try:
        return clocks_that_explain(path, orders, rounding)
    except NotThere:
        return ()


def _apart_deg(path: SampledPath, order: Heard, clock_s: float) -> float:
    try:
        return order.direction.apart_deg(path.sight(order.utc_s + clock_s))
    except NotThere:
        return math.inf
