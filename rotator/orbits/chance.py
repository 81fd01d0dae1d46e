"""How probable it is that a stream which follows no satellite fits one as well: whether its orders tell enough.

Knows how antennas are turned and how often satellites rise. Does not know how many satellites there are, nor which
probability is small enough.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from rotator.orbits.sight import FULL_TURN_DEG
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, RISING_DEG, UNSTEADY_S, Heard, SampledPath

TRAVEL_ROUNDINGS = 3.0
LEAST_TRAVEL_DEG = 0.5
"""So far must the orders have moved for their course and speed to be those of the satellite; less only as it rises:
hardly anything else begins low in the sky there and then."""
RISES_DEG = 5.0
RISE_EVERY_S = 10_800.0
"""A satellite near the earth rises about so often."""
JUST_RISEN_DEG = 0.1
SKY_SQUARE_DEG = 20_627.0
"""Above the horizon."""
RATES_SQUARE_DPS = math.pi
"""What moves in the sky without following a satellite does so at up to 1°/s, in any direction."""


def has_moved(orders: Sequence[Heard]) -> bool:
    """A target that stands is no satellite, but for one that has just risen."""
    return any(before.direction != after.direction for before, after in pairwise(orders))


def has_told(path: SampledPath, orders: Sequence[Heard], rounding: float) -> bool:
    """Whether the satellite has moved far enough in this time, or rises."""
    first, last = path.at(orders[0].utc_s), path.sight(orders[-1].utc_s)
    if first.elevation_deg < RISES_DEG and orders[0].elevation_deg <= RISES_DEG and first.elevation_dps > 0:
        return True
    return path.sight(orders[0].utc_s).apart_deg(last) >= max(TRAVEL_ROUNDINGS * rounding, LEAST_TRAVEL_DEG)


def line_chance(path: SampledPath, orders: Sequence[Heard], rounding: float) -> float:
    """The probability that a line through the sky at random fits this satellite as well: in place, and in motion."""
    first_s, last_s = orders[0].utc_s, orders[-1].utc_s
    travelled_dps = path.sight(first_s).apart_deg(path.sight(last_s)) / (last_s - first_s)
    wide_deg = rounding + 2 * BIAS_DEG
    place = wide_deg * (wide_deg + (CLOCKS_S[-1] - CLOCKS_S[0]) * travelled_dps) / SKY_SQUARE_DEG
    loose_dps = (rounding + 2 * UNSTEADY_S * travelled_dps) / (last_s - first_s)
    return place * min(1.0, loose_dps**2 / RATES_SQUARE_DPS)


def rise_chance(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> float:
    """The probability that a stream that stands at the horizon begins when one satellite rises there; 1: it does not
    begin as this one rises."""
    first = orders[0]
    seen = [path.at(first.utc_s + clock_s) for clock_s in clocks_s]
    begins = any(RISING_DEG <= each.elevation_deg <= JUST_RISEN_DEG and each.elevation_dps > 0 for each in seen)
    if first.elevation_deg > 0 or not begins:
        return 1.0
    span_s = CLOCKS_S[-1] - CLOCKS_S[0]
    wide_deg = rounding + 2 * BIAS_DEG + span_s * abs(seen[0].azimuth_dps)
    return span_s / RISE_EVERY_S * wide_deg / FULL_TURN_DEG
