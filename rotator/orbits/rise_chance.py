"""A stream that begins at the horizon or leaves it, and a satellite that rises there: whether they fit, and how likely
by chance.

Knows how often satellites rise, and how long their rounded directions stand after it. Does not know which probability
is small enough. Looks closer than `stream_fit`: a program whose elements or place differ more from ours is recognised
when its orders have moved.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from rotator.orbits.sight import FULL_TURN_DEG, turn_deg
from rotator.orbits.stream_fit import CLOCKS_S, Heard, SampledPath, Second

RISE_EVERY_S = 10_800.0
"""Mean seconds between two rises of a satellite near the earth."""
RISING_SOON_DEG, JUST_RISEN_DEG, RISE_BIAS_DEG = -0.07, 0.13, 0.07
"""Degrees: at the first order of a pass the satellite is between these elevations, and its azimuth this near."""
STANDING = (
    (8.0, 2.8e-6, 4.3e-6),
    (9.0, 2.4e-6, 3.9e-6),
    (10.0, 1.9e-6, 3.4e-6),
    (11.0, 1.2e-6, 2.7e-6),
    (12.0, 0.6e-6, 2.2e-6),
    (14.0, 0.1e-6, 1.5e-6),
    (17.0, 0.0, 0.9e-6),
    (20.0, 0.0, 0.4e-6),
    (30.0, 0.0, 0.0),
)
"""Seconds; then the probabilities that a stream which stands in whole degrees for this time fits the rise of one
satellite by chance: if it is rounded, and if it is rounded or cut off. For orbits near the earth at random."""


def rises(seen: Second) -> bool:
    """Whether a satellite with this direction and motion is rising over the horizon."""
    return RISING_SOON_DEG <= seen.elevation_deg <= JUST_RISEN_DEG and seen.elevation_dps > 0


def begins_with_rise(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> bool:
    """Whether a stream begins when and where one satellite rises, by one of these clocks."""
    return bool(_rising(path, orders[0], clocks_s, rounding))


def rise_chance(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> float:
    """The probability that a stream begins when and where one satellite rises; 1: it does not begin as this one
    rises."""
    rising = _rising(path, orders[0], clocks_s, rounding)
    if not rising:
        return 1.0
    return _meeting_chance(rising[0], (JUST_RISEN_DEG - RISING_SOON_DEG) / rising[0].elevation_dps, rounding)


def lift_off_chance(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> float:
    """The probability that a stream's elevation leaves zero when and where that of one satellite does; 1: it does not
    leave it as this one does. Before, the program may have waited at the horizon for any time.

    `orders`: the last one at the horizon, the first one above it, and any others.
    """
    last, first = orders[:2]
    leaving = [
        seen
        for clock_s in clocks_s
        if _is_near(seen := path.at(first.utc_s + clock_s), first, rounding)
        and _leaves_zero(path.at(last.utc_s + clock_s), seen, rounding)
    ]
    if not leaving:
        return 1.0
    between_s, bias_s = first.utc_s - last.utc_s, 2 * RISE_BIAS_DEG / leaving[0].elevation_dps
    return _meeting_chance(leaving[0], between_s + bias_s, rounding)


def _rising(path: SampledPath, first: Heard, clocks_s: Sequence[float], rounding: float) -> list[Second]:
    """The satellite at the first order of a stream, for each clock by which it rises then and there."""
    if first.elevation_deg > 0:
        return []
    return [
        seen
        for clock_s in clocks_s
        if rises(seen := path.at(first.utc_s + clock_s)) and _is_near(seen, first, rounding)
    ]


def _is_near(seen: Second, order: Heard, rounding: float) -> bool:
    """Whether the order's azimuth is the satellite's. One that is cut off is up to a whole rounding too low, one that
    is rounded half of it too high."""
    over_deg = turn_deg(seen.azimuth_deg, order.azimuth_deg)
    return -rounding - RISE_BIAS_DEG <= over_deg <= rounding / 2 + RISE_BIAS_DEG


def _leaves_zero(before: Second, after: Second, rounding: float) -> bool:
    """Whether the elevation, rounded or cut off, leaves zero between these moments."""
    return after.elevation_dps > 0 and any(
        before.elevation_deg < zero_below_deg + RISE_BIAS_DEG and after.elevation_deg > zero_below_deg - RISE_BIAS_DEG
        for zero_below_deg in (rounding / 2, rounding)
    )


def _meeting_chance(seen: Second, lasts_s: float, rounding: float) -> float:
    """The probability that a stream without a satellite meets one satellite at this moment of its rise, known to so
    many seconds and to the error of the program's clock."""
    span_s = CLOCKS_S[-1] - CLOCKS_S[0] + lasts_s
    wide_deg = 1.5 * rounding + 2 * RISE_BIAS_DEG + lasts_s * abs(seen.azimuth_dps)
    return span_s / RISE_EVERY_S * wide_deg / FULL_TURN_DEG


def standing_chance(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> float:
    """The probability that a stream which stands at the horizon from its beginning fits the rise of one satellite;
    1: it does not fit the rise of this one.

    Most satellites would have moved on after some seconds, so the longer it stands, the fewer remain.
    """
    if orders[0].elevation_deg > 0:
        return 1.0
    lasts_s = orders[-1].utc_s - orders[0].utc_s
    for column, cut_deg in ((1, 0.0), (2, rounding / 2)):
        if any(_stands(path, orders, clock_s, rounding, cut_deg) for clock_s in clocks_s):
            return _measured(lasts_s, column)
    return 1.0


def _stands(path: SampledPath, orders: Sequence[Heard], clock_s: float, rounding: float, cut_deg: float) -> bool:
    """Whether it rises at the first order, and its rounded direction is the same until the last. `cut_deg`: by so much
    orders are too low that are cut off."""
    first, last = orders[0], orders[-1]
    begin, end = path.at(first.utc_s + clock_s), path.at(last.utc_s + clock_s)
    loose_deg = rounding / 2 + RISE_BIAS_DEG
    return (
        rises(begin)
        and end.elevation_deg <= loose_deg + cut_deg
        and all(abs(turn_deg(seen.azimuth_deg, first.azimuth_deg) + cut_deg) <= loose_deg for seen in (begin, end))
    )


def _measured(lasts_s: float, column: int) -> float:
    for before, after in pairwise(STANDING):
        if lasts_s < after[0]:
            share = max(0.0, lasts_s - before[0]) / (after[0] - before[0])
            return before[column] + share * (after[column] - before[column])
    return 0.0
