"""The one satellite that explains a program's orders: surely enough to fly its path in their place, or none.

Knows the orders of one stream and the satellites near them. A satellite explains them when its path, by one clock of
the program, gives every order to its rounding, when no other satellite explains them too, when chance hardly would, and
when they hardly follow its neighbour in a train. Does not know who sent the orders.

The satellites of a train fly one path, seconds to minutes apart, and some may be unknown here. The stream of such a one
fits its known neighbour by a clock that is wrong by the gap. So the clock that fits best is looked for in a wider range
than programs' clocks have, and with the least error of the elements: it must be one that a program can have. A
neighbour as near as a clock may be wrong cannot be told apart.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from rotator.orbits.chance import (
    LINE_CHANCE,
    RISE_BIAS_DEG,
    STANDING_CHANCE,
    Known,
    begins_with_rise,
    has_come_far,
    has_moved,
    line_chance,
    rises,
    rising_line_chance,
    standing_chance,
)
from rotator.orbits.sight import NotThere
from rotator.orbits.stream_fit import (
    BIAS_DEG,
    CLOCKS_S,
    Heard,
    SampledPath,
    clocks_that_explain,
    explains,
    rounding_deg,
    showing,
)

WIDE_CLOCKS_S = tuple(clock / 2 for clock in range(-60, 61))
"""Leads of the program's clock among which the best one is looked for, in seconds."""
BIASES_DEG = RISE_BIAS_DEG, BIAS_DEG / 2, BIAS_DEG
"""Errors of the elements or of the place; the least that any clock needs is taken."""


@dataclass(frozen=True, slots=True)
class Explained:
    """The orders follow this path, rounded like this. `clocks_s`: the possible leads of the program's clock."""

    path: SampledPath
    clocks_s: tuple[float, ...]
    rounding_deg: float


def explained(
    orders: Sequence[Heard], near: Iterable[SampledPath], known: Known, up: Known, likely: Collection[str]
) -> Explained | None:
    """`near`: the satellites near the orders. `known`, `up`: the number of all, and of those that are up now. `likely`:
    names of the satellites in use."""
    rounding = rounding_deg(orders)
    fits = [Explained(path, clocks_s, rounding) for path in near if (clocks_s := _clocks(path, orders, rounding))]
    if len(fits) != 1:
        return None
    [found] = fits
    with suppress(NotThere):
        is_likely = found.path.satellite.name in likely
        if _is_sure(found, orders, known.share(likely=is_likely), up.share(likely=is_likely)):
            return found
    return None


def _is_sure(found: Explained, orders: Sequence[Heard], share: float, share_up: float) -> bool:
    """Whether the orders show enough of this satellite. `share`, `share_up`: of the chance that is allowed for all
    satellites, and for those that are up now. Raises NotThere."""
    path, clocks_s, rounding = found.path, found.clocks_s, found.rounding_deg
    # Each clock that explains the orders explains all of these.
    shown = orders if begins_with_rise(path, orders, clocks_s, rounding) else showing(path, orders, clocks_s[0])
    if not has_moved(shown):
        # In whole degrees a satellite may stand for 15 s after its rise. Then only place and time identify it.
        return standing_chance(path, orders, clocks_s, rounding) <= share * STANDING_CHANCE
    return (
        has_come_far(path, shown, rounding)
        and _is_no_chance(found, shown, share, share_up)
        and has_likely_clock(path, shown, rounding)
    )


def _clocks(path: SampledPath, orders: Sequence[Heard], rounding: float) -> tuple[float, ...]:
    try:
        return clocks_that_explain(path, orders, rounding)
    except NotThere:
        return ()


def _is_no_chance(found: Explained, shown: Sequence[Heard], share: float, share_up: float) -> bool:
    """Whether a line at random hardly fits one of all satellites: in the orders' places, or in place and time of their
    rise."""
    path, rounding = found.path, found.rounding_deg
    return (
        line_chance(path, shown, rounding) <= share_up * LINE_CHANCE
        or rising_line_chance(path, shown, found.clocks_s, rounding) <= share * LINE_CHANCE
    )


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
