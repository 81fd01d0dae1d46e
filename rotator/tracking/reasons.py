"""Why a pass is left out of the plan, or flown in part: sentences for a person.

Knows the plan. Does not decide anything.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from rotator.orbits.passes import Pass
from rotator.tracking.chain import Part
from rotator.tracking.courses import Course, SeenPass
from rotator.tracking.planned import SPARE_S, Followed, PlannedPass

NEAR_S = 300.0
"""Seconds: a flight this near may leave no time to turn the antenna."""
LITTLE = 0.02
"""Minutes: a shorter loss is not mentioned."""


def too_low(found: Pass, followed: Followed) -> str:
    high_deg, asked_deg = found.highest.elevation_deg, followed.min_culmination_deg
    shown = f"{high_deg:.0f}" if round(high_deg) < asked_deg else f"{high_deg:.2f}"
    return f"culminates at {shown}°, below the {asked_deg:g}° asked"


def unseen(seen: SeenPass) -> str:
    """Why no course of this pass is worth anything."""
    if any(seen.rates):
        return "the rotor does not reach it"
    on_already = seen.found.aos_s is not None and seen.found.aos_s < seen.moments_s[0]
    return f"{'the rest of it' if on_already else 'all of it'} is behind the horizon of trees and roofs"


def left_out(seen: SeenPass, flown: Sequence[PlannedPass]) -> str:
    """Names the flights that are worth more."""
    begin_s, end_s = seen.moments_s[0], seen.moments_s[-1]
    during = _between(flown, begin_s - SPARE_S, end_s + SPARE_S)
    rivals = during or _between(flown, begin_s - NEAR_S, end_s + NEAR_S)
    names = list(dict.fromkeys(each.name for each in rivals))
    if not names:
        return "sets before the antenna can be there"
    if not during:
        return f"no time to turn there beside {_and(names)}"
    higher = [each.name for each in during if each.priority > seen.followed.priority]
    if higher:
        return f"{_and(list(dict.fromkeys(higher)))} {_has(higher)} the higher priority"
    if len(names) > 1:
        return f"{_and(names)} are worth more together"
    (rival, *_) = rivals
    high_deg, its_deg = seen.found.highest.elevation_deg, rival.found.highest.elevation_deg
    if rival.priority == seen.followed.priority and round(its_deg) > round(high_deg):
        return f"{rival.name} rises higher, to {its_deg:.0f}°"
    return f"{rival.name} is {'up for longer' if _lasts_s(rival.found) > _lasts_s(seen.found) else 'worth more'}"


def in_part(part: Part, ways: Iterable[Course], before: str | None, after: str | None) -> str:
    """Names the flights that take its beginning or its end; empty: nothing of the pass is lost.

    `ways`: every course of the pass. The chosen one may have turned no further because the next flight comes soon.
    """
    little = LITTLE * part.seen.followed.priority
    late = any(way.gained[part.first] > little for way in ways)
    early = any(way.gained[-1] - way.gained[part.last] > little for way in ways)
    cause = f"after {before}" if before else "the antenna has to turn there first"
    words = [f"begins late: {cause}"] if late else []
    return "; ".join([*words, f"ends early: for {after}"] if early and after else words)


def _lasts_s(found: Pass) -> float:
    return math.inf if found.aos_s is None or found.los_s is None else found.los_s - found.aos_s


def _between(flown: Sequence[PlannedPass], begin_s: float, end_s: float) -> list[PlannedPass]:
    return [each for each in flown if each.flight and each.flight.begin_s < end_s and each.flight.end_s > begin_s]


def _and(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _has(names: Sequence[str]) -> str:
    return "has" if len(set(names)) == 1 else "have"
