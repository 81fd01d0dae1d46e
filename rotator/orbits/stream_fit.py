"""Whether a satellite's path explains rounded orders, and by which clock of the program that sent them.

Knows that a program rounds its angles or cuts them off, that its elements and its place may differ a little from ours,
that it sends no elevation below zero, and that its clock may be wrong by some seconds. Does not know who sent the
orders, nor what other satellites there are.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.orbits.sight import FULL_TURN_DEG, Sight, Target, turn_deg

CLOCKS_S = tuple(quarter / 4 for quarter in range(-24, 23))
"""Possible leads of the program's clock over UTC: 5 s either way. It may send a direction that is a second old."""
UNSTEADY_S = 0.3
"""Seconds by which orders may come too early or too late."""
ORDERS = 8
FEW_ORDERS, FEW_S = 3, 8.0
"""Orders needed to recognise a satellite. If they come slowly, `FEW_ORDERS` in this time are enough."""
BIAS_DEG = 0.3
"""Degrees on the sky for the whole stream: error of other elements, or of another place of the station."""
LEAST_DEG = 0.02
"""Degrees: no order is taken as more exact than this."""
RISING_DEG = -0.1
"""Degrees: below this elevation of the path, an order for the horizon shows nothing about the satellite. Some programs
wait until its rise with the azimuth of the rise."""
FINEST_DEG = 0.01
SINGLE_DEG = 2e-5
"""Degrees: Hamlib's angles have single precision. It sends 110.1° as 110.099998."""


@dataclass(frozen=True, slots=True)
class Heard:
    """An order as it came: the moment in seconds since 1970, and the direction."""

    utc_s: float
    azimuth_deg: float
    elevation_deg: float

    @property
    def direction(self) -> Sight:
        return Sight(self.azimuth_deg, self.elevation_deg, math.inf)


@dataclass(frozen=True, slots=True)
class Second:
    """The direction of a satellite at the begin of a second, and its motion until the next."""

    azimuth_deg: float
    elevation_deg: float
    azimuth_dps: float
    elevation_dps: float


class SampledPath:
    """A satellite's directions, computed once for each second. Raises NotThere."""

    def __init__(self, satellite: Target) -> None:
        self.satellite = satellite
        self._seconds: dict[int, Second] = {}

    def at(self, utc_s: float) -> Second:
        """Direction and motion in the second of this time."""
        number = math.floor(utc_s)
        second, share = self._second(number), utc_s - number
        return Second(
            second.azimuth_deg + share * second.azimuth_dps,
            second.elevation_deg + share * second.elevation_dps,
            second.azimuth_dps,
            second.elevation_dps,
        )

    def sight(self, utc_s: float) -> Sight:
        """The direction as a program sends it: no elevation below zero."""
        seen = self.at(utc_s)
        return Sight(seen.azimuth_deg % FULL_TURN_DEG, max(0.0, seen.elevation_deg), math.inf)

    def forget_before(self, utc_s: float) -> None:
        self._seconds = {number: second for number, second in self._seconds.items() if number >= utc_s}

    def _second(self, number: int) -> Second:
        found = self._seconds.get(number)
        if found is None:
            following = self._seconds.get(number + 1)
            now = self.satellite.sight(number)
            soon = (
                self.satellite.sight(number + 1)
                if following is None
                else Sight(following.azimuth_deg, following.elevation_deg, math.inf)
            )
            found = self._seconds[number] = Second(
                now.azimuth_deg,
                now.elevation_deg,
                turn_deg(now.azimuth_deg, soon.azimuth_deg),
                soon.elevation_deg - now.elevation_deg,
            )
        return found


def rounding_deg(orders: Sequence[Heard]) -> float:
    """The rounding of the orders: whole degrees, tenths or hundredths."""
    angles_deg = [angle for each in orders for angle in (each.azimuth_deg, each.elevation_deg)]
    for rounding in (1.0, 0.1):
        if all(abs(angle - rounding * round(angle / rounding)) < SINGLE_DEG for angle in angles_deg):
            return rounding
    return FINEST_DEG


def are_enough(orders: Sequence[Heard]) -> bool:
    return len(orders) >= ORDERS or (
        len(orders) >= FEW_ORDERS and orders[-1].utc_s - orders[0].utc_s >= FEW_S - UNSTEADY_S
    )


def clocks_that_explain(path: SampledPath, orders: Sequence[Heard], rounding: float) -> tuple[float, ...]:
    """The leads of the program's clock with which this path, rounded, gives the orders, and these show enough of it.

    Raises NotThere.
    """
    either_deg = 0.0, rounding / 2
    return tuple(
        clock_s
        for clock_s in CLOCKS_S
        if are_enough(shown := showing(path, orders, clock_s))
        and explains(path, shown, clock_s, rounding=rounding, cuts_deg=either_deg)
    )


def showing(path: SampledPath, orders: Sequence[Heard], clock_s: float) -> Sequence[Heard]:
    """The orders that show something about this satellite if the program's clock leads by this. Raises NotThere."""
    return [
        each for each in orders if each.elevation_deg > 0 or path.at(each.utc_s + clock_s).elevation_deg > RISING_DEG
    ]


def explains(
    path: SampledPath,
    orders: Sequence[Heard],
    clock_s: float,
    *,
    rounding: float,
    cuts_deg: Sequence[float],
    bias_deg: float = BIAS_DEG,
) -> bool:
    """Whether this path, sent by this clock, gives the orders. `cuts_deg`: by how much orders may lie below the path,
    in both angles alike: by nothing if they are rounded, by half the rounding if they are cut off. Raises NotThere."""
    # Across: along the azimuth, on the sky. Each order allows a range for the bias; together they must leave some.
    half, least_cos = rounding / 2, 1.0
    low_across = low_up = -bias_deg - max(cuts_deg)
    high_across = high_up = bias_deg
    for order in (orders[-1], *orders[:-1]):  # first and last order show a wrong clock soonest
        seen = path.at(order.utc_s + clock_s)
        cos = math.cos(math.radians(seen.elevation_deg))
        least_cos = min(least_cos, cos)
        across = turn_deg(seen.azimuth_deg, order.azimuth_deg) * cos
        up = order.elevation_deg - max(0.0, seen.elevation_deg)
        loose_across = half * cos + LEAST_DEG + UNSTEADY_S * abs(seen.azimuth_dps) * cos
        loose_up = half + LEAST_DEG + UNSTEADY_S * abs(seen.elevation_dps)
        low_across, high_across = max(low_across, across - loose_across), min(high_across, across + loose_across)
        low_up, high_up = max(low_up, up - loose_up), min(high_up, up + loose_up)
        if low_across > high_across or low_up > high_up:
            return False
    return any(
        low_across <= bias_deg - cut * least_cos
        and high_across >= -bias_deg - cut
        and low_up <= bias_deg - cut
        and high_up >= -bias_deg - cut
        for cut in cuts_deg
    )


KEPT = 60
"""Orders for which a stream must agree with a path that it meets later, because any line crosses some path."""
LONGEST_GAP_S = 20.0
"""Seconds: orders further apart are of two streams. Some programs send only when a whole degree has changed."""
THIN_S = 0.9
"""Seconds: if orders come faster, only one in this time counts."""
FASTEST_DPS = 2.0
"""Degrees a second: no satellite crosses the sky faster. Faster orders begin a new stream."""


class HeardOrders:
    """The latest `KEPT` orders of a stream."""

    def __init__(self) -> None:
        self._orders: deque[Heard] = deque(maxlen=KEPT)
        self._all_kept = True
        """Whether no order was dropped since the stream began."""

    @property
    def all(self) -> Sequence[Heard]:
        return tuple(self._orders)

    @property
    def first_s(self) -> float:
        return self._orders[0].utc_s if self._orders else math.inf

    @property
    def last_s(self) -> float:
        return self._orders[-1].utc_s if self._orders else -math.inf

    @property
    def full(self) -> bool:
        return len(self._orders) == KEPT

    @property
    def enough(self) -> bool:
        """Whether they are enough: from the begin of the stream on, or later as many as are kept."""
        return are_enough(self._orders) if self._all_kept else self.full

    def begin_anew(self, order: Heard) -> bool:
        """Whether this order begins another stream; then the orders so far are forgotten."""
        if not self._orders or not self._is_of_another(order):
            return False
        self._orders.clear()
        self._all_kept = True
        return True

    def too_soon(self, order: Heard) -> bool:
        return order.utc_s - self.last_s < THIN_S

    def add(self, order: Heard) -> None:
        self._all_kept = self._all_kept and not self.full
        self._orders.append(order)

    def _is_of_another(self, order: Heard) -> bool:
        last = self._orders[-1]
        gap_s = order.utc_s - last.utc_s
        if not 0 <= gap_s <= LONGEST_GAP_S:
            return True
        return order.direction.apart_deg(last.direction) > FASTEST_DPS * (gap_s + UNSTEADY_S) + 2.0
