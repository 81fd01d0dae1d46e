"""The probability that a stream fits a satellite by chance, and so whether its orders are enough to recognise one.

Knows the usual motions of antennas, how often satellites rise, and which probability is small enough. Does not know
the satellites or their names.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, takewhile

from rotator.orbits.rise_chance import lift_off_chance, rise_chance
from rotator.orbits.stream_fit import BIAS_DEG, CLOCKS_S, UNSTEADY_S, Heard, SampledPath

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
