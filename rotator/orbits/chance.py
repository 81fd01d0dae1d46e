"""The probability that a stream fits a satellite by chance, and so whether its orders are enough to recognise one.

Knows the usual motions of antennas, how often satellites rise and how long their rounded directions stand after it, and
which probability is small enough. At a rise it looks closer than `stream_fit`: a program whose elements or place differ
more from ours is recognised when its orders have moved. Does not know the satellites or their names.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile

from rotator.orbits.sight import FULL_TURN_DEG, turn_deg
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, UNSTEADY_S, Heard, SampledPath, Second

TRAVEL_ROUNDINGS = 3.0
LEAST_TRAVEL_DEG = 0.5
"""Degrees that a satellite must have moved before its orders show course and speed. At its rise less is enough: hardly
any other motion begins at that place and time low in the sky."""
RISES_DEG = 5.0
"""A satellite that climbs below this elevation counts as one that rises."""
SKY_SQUARE_DEG = 20_627.0
"""Square degrees of the sky above the horizon."""
LOW_DEG, LOW_SHARE = 15.0, 0.5
"""Antennas without a satellite stand below this elevation in this share of the time."""
FASTEST_DPS = 1.0
"""A target that is no satellite moves at up to this speed, in any direction."""
LINE_CHANCE = 1e-5
"""Allowed chance, for all satellites together, that a moving stream without a satellite is accepted: anywhere in the
sky, and the same again where it rises."""
STANDING_CHANCE = 1e-4
"""The same for a stream that stands at the horizon from its beginning on."""
LIKELY_SHARE, MOST_LIKELY = 0.5, 12
"""The satellites that this station uses have this share of an allowed chance, and all others have the rest. So many of
them are recognised after eight seconds, rounded or cut off."""

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


@dataclass(frozen=True, slots=True)
class Known:
    """The number of possible satellites: in all, and of those that the station uses."""

    all: int
    likely: int

    def share(self, *, likely: bool) -> float:
        """The share of one satellite in an allowed chance. The shares of all satellites add up to 1."""
        if self.likely in (0, self.all):
            return 1.0 / max(1, self.all)
        if likely:
            return LIKELY_SHARE / self.likely
        return (1.0 - LIKELY_SHARE) / (self.all - self.likely)


def has_moved(orders: Sequence[Heard]) -> bool:
    """Whether the target has moved: one that stands is no satellite, unless it has just risen."""
    return any(before.direction != after.direction for before, after in pairwise(orders))


def has_come_far(path: SampledPath, orders: Sequence[Heard], rounding: float) -> bool:
    """Whether the satellite has moved far enough in this time, or rises."""
    first, last = path.at(orders[0].utc_s), path.sight(orders[-1].utc_s)
    if first.elevation_deg < RISES_DEG and orders[0].elevation_deg <= RISES_DEG and first.elevation_dps > 0:
        return True
    return path.sight(orders[0].utc_s).apart_deg(last) >= max(TRAVEL_ROUNDINGS * rounding, LEAST_TRAVEL_DEG)


def line_chance(path: SampledPath, orders: Sequence[Heard], rounding: float) -> float:
    """The probability that a line through the sky at random fits this satellite as well: in place, and in motion.

    Each of its speeds is as likely: slow lines lie closer together than fast ones.
    """
    travelled_dps = _travelled_dps(path, orders)
    wide_deg = rounding + 2 * BIAS_DEG
    long_deg = wide_deg + (CLOCKS_S[-1] - CLOCKS_S[0]) * travelled_dps
    loose_dps = _loose_dps(orders, travelled_dps, rounding)
    motion = loose_dps**2 / (2 * math.pi * FASTEST_DPS * max(travelled_dps, loose_dps))
    return wide_deg * long_deg * _lines_a_square_deg(orders) * min(1.0, motion)


def rising_line_chance(path: SampledPath, orders: Sequence[Heard], clocks_s: Sequence[float], rounding: float) -> float:
    """The probability that a line at random begins at the horizon, or leaves it, as this satellite does when it rises,
    and moves as it does.

    1: the orders do neither as it rises. `orders`: those that tell something of it. Before them the program may have
    waited at the horizon for any time.
    """
    begins = rise_chance(path, orders, clocks_s, rounding) * _motion_chance(path, orders, rounding)
    waiting = sum(1 for _ in takewhile(lambda each: each.elevation_deg == 0, orders))
    if not 0 < waiting < len(orders):
        return begins
    # The program may have waited with an azimuth that stood, so only the orders from its last one on show a motion.
    leaving = orders[waiting - 1 :]
    leaves = lift_off_chance(path, leaving, clocks_s, rounding)
    return min(begins, leaves * _motion_chance(path, leaving, rounding))


def _motion_chance(path: SampledPath, orders: Sequence[Heard], rounding: float) -> float:
    """The probability that a line at random moves as this satellite does, as far as the orders show it."""
    loose_dps = _loose_dps(orders, _travelled_dps(path, orders), rounding)
    return min(1.0, loose_dps**2 / (math.pi * FASTEST_DPS**2))


def _travelled_dps(path: SampledPath, orders: Sequence[Heard]) -> float:
    first_s, last_s = orders[0].utc_s, orders[-1].utc_s
    return path.sight(first_s).apart_deg(path.sight(last_s)) / (last_s - first_s)


def _loose_dps(orders: Sequence[Heard], travelled_dps: float, rounding: float) -> float:
    """How much the satellite's speed may differ from the true one, in any direction, and still give the same orders."""
    return (rounding + 2 * UNSTEADY_S * travelled_dps) / (orders[-1].utc_s - orders[0].utc_s)


def _lines_a_square_deg(orders: Sequence[Heard]) -> float:
    """The share of all lines at random that lie in a square degree of the sky about these orders."""
    low = math.sin(math.radians(LOW_DEG))
    if orders[-1].elevation_deg < LOW_DEG:
        return LOW_SHARE / (low * SKY_SQUARE_DEG)
    return (1.0 - LOW_SHARE) / ((1.0 - low) * SKY_SQUARE_DEG)


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
