"""The one satellite for whose rise a program's orders wait at the horizon, before they show enough to recognise it.

Knows that such a program sends the azimuth at which the satellite is below the horizon, or the one at which it will
rise, and no elevation. Knows the orders and the satellites that may be meant. Does not know what follows from it: a
guess that is right nearly always is good enough to choose a turn of the azimuth, and not to leave the orders.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from rotator.orbits.chance import RISE_EVERY_S, Known, has_moved
from rotator.orbits.sight import FULL_TURN_DEG, Sight, Target
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, UNSTEADY_S, Heard, SampledPath, rounding_deg, turn_deg

LONGEST_WAIT_S = 180.0
"""A satellite that rises later is not looked for."""
LOWEST_DEG = -15.0
"""Elevation below which no satellite near the earth is `LONGEST_WAIT_S` before its rise."""
SWINGS_DEG = 60.0
"""The azimuth of a satellite changes by less in this time, low in the sky."""
LEAST_ORDERS, LEAST_S = 3, 2.0
"""One order, or one that is repeated at once, may be a person's."""
TURN_CHANCE = 2e-3
"""Allowed chance, for all satellites together, that orders at the horizon that wait for none fit one."""
FASTEST_DPS = 0.5
"""Azimuths at the horizon that are no satellite's change by up to so much in a second, in either direction."""
STEP_S = 10.0


@dataclass(frozen=True, slots=True)
class Rising:
    """It rises at this time, in seconds since 1970."""

    satellite: Target
    rises_s: float


@dataclass(frozen=True, slots=True)
class Soon:
    """A satellite that rises soon, or has just risen."""

    path: SampledPath
    rises_s: float


def soon_rising(order: Heard, seen: Iterable[tuple[Target, Sight]]) -> list[Soon]:
    """Those that may rise near the order's azimuth. `seen`: satellites, and where they are now. Raises NotThere."""
    found = []
    for satellite, sight in seen:
        apart_deg = abs(turn_deg(sight.azimuth_deg, order.azimuth_deg))
        if not LOWEST_DEG < sight.elevation_deg < 1.0 or apart_deg > SWINGS_DEG:
            continue
        path = SampledPath(satellite)
        if (rises_s := _rises_s(path, order.utc_s)) is not None:
            found.append(Soon(path, rises_s))
    return found


def waits_for(orders: Sequence[Heard], soon: Sequence[Soon], known: Known, likely: Collection[str]) -> Rising | None:
    """The only satellite whose rise explains all orders, where chance hardly would. `likely`: names of those in use.

    Raises NotThere.
    """
    lasts_s = orders[-1].utc_s - orders[0].utc_s
    at_horizon = all(order.elevation_deg == 0 for order in orders)
    if not at_horizon or len(orders) < LEAST_ORDERS or lasts_s < LEAST_S - UNSTEADY_S:
        return None
    rounding = rounding_deg(orders)
    fits = [each for each in soon if _explains(each, orders, rounding)]
    if len(fits) != 1:
        return None
    [only] = fits
    count = known.likely if only.path.satellite.name in likely else known.all
    if count * _chance(only, orders, rounding) > TURN_CHANCE:
        return None
    return Rising(only.path.satellite, only.rises_s)


def _rises_s(path: SampledPath, now_s: float) -> float | None:
    """When it rises; None: not soon. One that has risen a few seconds ago may be sent by a clock that is behind."""
    at_s, last_s = now_s + CLOCKS_S[0] - STEP_S, now_s + LONGEST_WAIT_S
    before_deg = path.at(at_s).elevation_deg
    while at_s < last_s:
        after_deg = path.at(at_s + STEP_S).elevation_deg
        if before_deg <= 0 < after_deg:
            return at_s + STEP_S * before_deg / (before_deg - after_deg)
        at_s, before_deg = at_s + STEP_S, after_deg
    return None


def _explains(soon: Soon, orders: Sequence[Heard], rounding: float) -> bool:
    """By one clock of the program: it sends the azimuth of each moment, or until the rise that of the rise."""
    return any(
        all(_fits(soon, order, clock_s, least_s, rounding) for order in orders)
        for least_s in (-math.inf, soon.rises_s)
        for clock_s in CLOCKS_S
    )


def _fits(soon: Soon, order: Heard, clock_s: float, least_s: float, rounding: float) -> bool:
    seen = soon.path.at(max(order.utc_s + clock_s, least_s))
    over_deg = turn_deg(seen.azimuth_deg, order.azimuth_deg)
    return seen.elevation_deg <= rounding + BIAS_DEG and -rounding - BIAS_DEG <= over_deg <= rounding / 2 + BIAS_DEG


def _chance(soon: Soon, orders: Sequence[Heard], rounding: float) -> float:
    """That one satellite rises in this time, where orders stand that have nothing to do with it, and moves as they."""
    last, lasts_s = orders[-1], orders[-1].utc_s - orders[0].utc_s
    clocks_s = CLOCKS_S[-1] - CLOCKS_S[0]
    rate_dps = abs(soon.path.at(last.utc_s).azimuth_dps)
    wide_deg = 1.5 * rounding + 2 * BIAS_DEG + clocks_s * rate_dps
    span_s = max(0.0, soon.rises_s - last.utc_s) + clocks_s
    moved = min(1.0, (rounding + 2 * UNSTEADY_S * rate_dps) / lasts_s / FASTEST_DPS) if has_moved(orders) else 1.0
    return span_s / RISE_EVERY_S * wide_deg / FULL_TURN_DEG * moved
