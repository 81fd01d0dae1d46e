"""The one satellite that explains a program's orders: surely enough to fly its path in their place, or none.

Knows the orders of one stream and the satellites near them. A satellite explains them when its path, by one clock of
the program, gives every order to its rounding, when no other satellite explains them too, when chance hardly would, and
when they hardly follow its neighbour in a train. Does not know who sent the orders.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from rotator.orbits.chance import (
    LINE_CHANCE,
    STANDING_CHANCE,
    Known,
    has_come_far,
    has_moved,
    line_chance,
    rising_line_chance,
)
from rotator.orbits.neighbours import has_likely_clock
from rotator.orbits.rise_chance import begins_with_rise, standing_chance
from rotator.orbits.sight import NotThere
from rotator.orbits.stream_fit import Heard, SampledPath, clocks_that_explain, rounding_deg, showing


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
