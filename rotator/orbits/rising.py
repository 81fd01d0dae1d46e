"""The one satellite for whose rise a program's orders wait at the horizon, before they show enough to recognise it.

Knows that such a program sends elevation 0, and the present azimuth of the satellite below the horizon or the azimuth
of its rise. Knows the orders and the possible satellites. The result is a guess that is nearly always right: good
enough to choose a turn of azimuth, not good enough to fly the satellite's path in place of the orders.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from rotator.orbits.chance import RISE_EVERY_S, Known, has_moved
from rotator.orbits.sight import FULL_TURN_DEG, Sight, Target, turn_deg
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, UNSTEADY_S, Heard, SampledPath, rounding_deg

LONGEST_WAIT_S, LONGEST_WAIT_IN_USE_S = 180.0, 1200.0
"""A satellite that rises later is not looked for. Those in use are few, and are looked for earlier: some programs send
one order long before the rise, and then nothing until it."""
LOWEST_DEG = -15.0
"""Elevation below which no satellite near the earth is `LONGEST_WAIT_S` before its rise."""
SWINGS_DEG = 60.0
"""Low in the sky the azimuth of a satellite changes by less than this in `LONGEST_WAIT_S`."""
LEAST_ORDERS, LEAST_S, WHOLE_DEG = 3, 2.0, 1.0
"""One order, or one that is repeated at once, may be a person's. One order in tenths or hundredths is of a program."""
TURN_CHANCE = 2e-3
"""The allowed chance, over all satellites, that orders at the horizon fit a rise though they wait for no satellite."""
FASTEST_DPS = 0.5
"""Orders at the horizon without a satellite change their azimuth by up to this, in either direction."""
STEP_S = 10.0


@dataclass(frozen=True, slots=True)
class Rising:
    """A satellite and the time of its rise, in seconds since 1970."""

    satellite: Target
    rises_s: float


@dataclass(frozen=True, slots=True)
class Soon:
    """A satellite that rises soon, or has just risen."""

    path: SampledPath
    rises_s: float


def soon_rising(order: Heard, seen: Iterable[tuple[Target, Sight]], in_use: Collection[Target] = ()) -> list[Soon]:
    """The satellites that may rise near the order's azimuth. `seen`: satellites with their present directions.

    Raises NotThere.
    """
    waits_s = {
        satellite: LONGEST_WAIT_S
        for satellite, sight in seen
        if LOWEST_DEG < sight.elevation_deg < 1.0 and abs(turn_deg(sight.azimuth_deg, order.azimuth_deg)) <= SWINGS_DEG
    } | dict.fromkeys(in_use, LONGEST_WAIT_IN_USE_S)
    found = []
    for satellite, wait_s in waits_s.items():
        path = SampledPath(satellite)
        if (rises_s := _rises_s(path, order.utc_s, wait_s)) is not None:
            found.append(Soon(path, rises_s))
    return found


def waits_for(orders: Sequence[Heard], soon: Sequence[Soon], known: Known, likely: Collection[str]) -> Rising | None:
    """The only satellite whose rise explains all orders; None: there is no such satellite, or chance explains them too.

    `likely`: names of the satellites in use. Raises NotThere.
    """
    lasts_s, rounding = orders[-1].utc_s - orders[0].utc_s, rounding_deg(orders)
    repeated = len(orders) >= LEAST_ORDERS and lasts_s >= LEAST_S - UNSTEADY_S
    if any(order.elevation_deg > 0 for order in orders) or not (repeated or rounding < WHOLE_DEG):
        return None
    # A program that follows the azimuth below the horizon sends more than one order.
    fits = [each for each in soon if _explains(each, orders, rounding, follows=repeated)]
    if len(fits) != 1:
        return None
    [only] = fits
    count = known.likely if only.path.satellite.name in likely else known.all
    if count * _chance(only, orders, rounding) > TURN_CHANCE:
        return None
    return Rising(only.path.satellite, only.rises_s)


def _rises_s(path: SampledPath, now_s: float, wait_s: float) -> float | None:
    """The time of the rise; None: the satellite does not rise soon. A rise a few seconds ago counts too, because the
    program's clock may be behind."""
    at_s, last_s = now_s + CLOCKS_S[0] - STEP_S, now_s + wait_s
    before_deg = path.at(at_s).elevation_deg
    while at_s < last_s:
        after_deg = path.at(at_s + STEP_S).elevation_deg
        if before_deg <= 0 < after_deg:
            return at_s + STEP_S * before_deg / (before_deg - after_deg)
        at_s, before_deg = at_s + STEP_S, after_deg
    return None


def _explains(soon: Soon, orders: Sequence[Heard], rounding: float, *, follows: bool) -> bool:
    """Whether this rise explains all orders by one clock of the program: each order has until the rise the azimuth of
    the rise, or, if the program `follows` it below the horizon, the satellite's azimuth of its moment."""
    since_s = (-math.inf, soon.rises_s) if follows else (soon.rises_s,)
    return any(_explained(soon, orders, least_s, rounding) for least_s in since_s)


def _explained(soon: Soon, orders: Sequence[Heard], least_s: float, rounding: float) -> bool:
    """The same with the satellite's azimuth at `least_s` or later."""
    return any(all(_fits(soon, order, clock_s, least_s, rounding) for order in orders) for clock_s in CLOCKS_S)


def _fits(soon: Soon, order: Heard, clock_s: float, least_s: float, rounding: float) -> bool:
    seen = soon.path.at(max(order.utc_s + clock_s, least_s))
    over_deg = turn_deg(seen.azimuth_deg, order.azimuth_deg)
    return seen.elevation_deg <= rounding + BIAS_DEG and -rounding - BIAS_DEG <= over_deg <= rounding / 2 + BIAS_DEG


def _chance(soon: Soon, orders: Sequence[Heard], rounding: float) -> float:
    """The probability that orders without a satellite fit the rise of one satellite: its time, place and motion."""
    last, lasts_s = orders[-1], orders[-1].utc_s - orders[0].utc_s
    clocks_s = CLOCKS_S[-1] - CLOCKS_S[0]
    stands_at_rise = _explained(soon, orders, soon.rises_s, rounding)
    rate_dps = 0.0 if stands_at_rise else abs(soon.path.at(last.utc_s).azimuth_dps)
    wide_deg = 1.5 * rounding + 2 * BIAS_DEG + clocks_s * rate_dps
    span_s = max(0.0, soon.rises_s - last.utc_s) + clocks_s
    moved = min(1.0, (rounding + 2 * UNSTEADY_S * rate_dps) / lasts_s / FASTEST_DPS) if has_moved(orders) else 1.0
    return span_s / RISE_EVERY_S * wide_deg / FULL_TURN_DEG * moved
