"""Whether a stream may follow a neighbour of the satellite that explains it: another one of the same launch.

The satellites of a train fly one path, seconds to minutes apart, and some may be unknown here. The stream of such a one
fits its known neighbour by a clock that is wrong by the gap. So the clock that fits best is looked for in a wider range
than programs' clocks have, and with the least error of the elements: it must be one that a program can have. A
neighbour as near as a clock may be wrong cannot be told apart. Does not know which satellites fly in trains.
"""

from __future__ import annotations

from collections.abc import Sequence

from rotator.orbits.rise_chance import RISE_BIAS_DEG, rises
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, Heard, SampledPath, explains

WIDE_CLOCKS_S = tuple(clock / 2 for clock in range(-60, 61))
"""Leads of the program's clock among which the best one is looked for, in seconds."""
BIASES_DEG = RISE_BIAS_DEG, BIAS_DEG / 2, BIAS_DEG
"""Errors of the elements or of the place; the least that any clock needs is taken."""


def has_likely_clock(path: SampledPath, orders: Sequence[Heard], rounding: float) -> bool:
    """Whether the clocks that explain the orders best lie about one that a program can have. Raises NotThere.

    Orders that are rounded and orders that are cut off give two clocks. If the stream begins at the horizon, one of
    them is enough; later it must be both, or more orders are needed.
    """
    at_horizon = orders[0].elevation_deg == 0
    for bias_deg in BIASES_DEG:
        fits = [_explaining_clocks_s(path, orders, rounding, cut_deg, bias_deg) for cut_deg in (0.0, rounding / 2)]
        likely = [_is_likely(path, orders[0], clocks_s) for clocks_s in fits if clocks_s]
        if likely:
            return any(likely) if at_horizon else all(likely)
    return False


def _explaining_clocks_s(
    path: SampledPath, orders: Sequence[Heard], rounding: float, cut_deg: float, bias_deg: float
) -> list[float]:
    return [
        clock_s
        for clock_s in WIDE_CLOCKS_S
        if explains(path, orders, clock_s, rounding=rounding, cuts_deg=(cut_deg,), bias_deg=bias_deg)
    ]


def _is_likely(path: SampledPath, first: Heard, clocks_s: Sequence[float]) -> bool:
    """Whether a program can have the middle one of these clocks, or one by which the stream begins as the satellite
    rises."""
    if first.elevation_deg == 0 and (rising_s := [each for each in clocks_s if rises(path.at(first.utc_s + each))]):
        return any(_is_possible(each) for each in rising_s)
    return _is_possible((clocks_s[0] + clocks_s[-1]) / 2)


def _is_possible(clock_s: float) -> bool:
    return CLOCKS_S[0] <= clock_s <= CLOCKS_S[-1]
