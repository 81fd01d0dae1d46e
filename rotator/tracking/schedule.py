"""The plan of many passes: which of them the antenna flies, and which part of each where two are up at once.

Knows the worth of each part of a pass on each of its courses, and makes flights of the best chain of parts. Knows no
clock: time is an argument, in seconds since 1970 (UTC). Why a pass is left out, or flown in part, it tells in sentences
for a person.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.sectors import Place
from rotator.orbits.passes import Pass, passes
from rotator.tracking.chain import Part, best_chain, ready_s
from rotator.tracking.courses import Course, SeenPass, courses, seen_pass
from rotator.tracking.planned import SPARE_S, Flight, Followed, PlannedPass
from rotator.tracking.travel import Travel

START_S = 5.0
"""Extra seconds before the antenna sets off, if there is time: for the planning of the steps and the motors' start."""
NEAR_S = 300.0
"""Seconds: a flight this near may leave no time to turn the antenna."""
LITTLE = 0.02
"""Minutes: a shorter loss is not mentioned."""


def schedule(followed: Sequence[Followed], antenna: Antenna, from_s: float, until_s: float) -> tuple[PlannedPass, ...]:
    """Every pass of the followed targets between two times, in order of rise: flown or left out, and why.

    `antenna`: its place at `from_s`, its mount and motors. To fly one of the passes, call `plan_flight` at its
    `set_off_s`, with the target's path from `begin_s` to `end_s` and with `begin_on`. A long pass may be flown in
    several parts; each part is an item.
    """
    travel = Travel(antenna)
    planned: list[PlannedPass] = []
    flyable: list[tuple[SeenPass, list[Course]]] = []
    for each in followed:
        for found in passes(each.target, from_s, until_s):
            if found.highest.elevation_deg < each.min_culmination_deg:
                planned.append(PlannedPass(found, each.priority, None, _too_low(found, each)))
                continue
            seen = seen_pass(found, each, antenna.mount, from_s, until_s)
            if ways := courses(seen, antenna.mount, travel):
                flyable.append((seen, ways))
            else:
                planned.append(PlannedPass(found, each.priority, None, _unseen(seen)))
    parts = widened(best_chain(flyable, antenna.stands_deg, travel, from_s), antenna.stands_deg, travel, from_s)
    ways_of = {id(seen): ways for seen, ways in flyable}
    flown = list(_flights(parts, ways_of, travel, from_s))
    chosen = {id(part.seen) for part in parts}
    for seen, _ in flyable:
        if id(seen) not in chosen:
            planned.append(PlannedPass(seen.found, seen.followed.priority, None, _left_out(seen, flown)))
    return tuple(sorted([*planned, *flown], key=lambda each: _order(each, from_s)))


def widened(parts: Sequence[Part], stands_deg: Place, travel: Travel, from_s: float) -> list[Part]:
    """The same parts, each begun as early and left as late as its neighbours allow, to a few seconds."""
    found: list[Part] = []
    place, free_s = stands_deg, from_s
    for index, part in enumerate(parts):
        after = parts[index + 1] if index + 1 < len(parts) else None
        kept = part
        for look in range(part.first - 1, -1, -1):
            earlier = replace(kept, first=look)
            ready = ready_s(part.seen, earlier.begin_s, from_s)
            if not (earlier.may_begin and travel.reaches(place, earlier.wait_deg, ready - free_s)):
                break
            kept = earlier
        for look in range(part.last + 1, len(part.seen.moments_s)):
            later = replace(kept, last=look)
            left_s = math.inf if after is None else after.begin_s - SPARE_S - later.end_s
            if not later.may_end or (after and not travel.reaches(later.end_deg, after.wait_deg, left_s)):
                break
            kept = later
        found.append(kept)
        place, free_s = kept.end_deg, kept.end_s
    return found


def _flights(
    parts: Sequence[Part], ways_of: Mapping[int, Sequence[Course]], travel: Travel, from_s: float
) -> Iterator[PlannedPass]:
    """`ways_of`: the courses of each pass, by its identity."""
    free_s = from_s
    for index, part in enumerate(parts):
        before = parts[index - 1].seen.found.name if index else None
        after = parts[index + 1].seen.found.name if index + 1 < len(parts) else None
        ways = ways_of[id(part.seen)]
        flight = Flight(
            # Early enough from any place: a person may have moved the antenna since the last pass.
            set_off_s=max(free_s, part.begin_s - SPARE_S - travel.longest_s - START_S),
            begin_s=part.begin_s,
            end_s=part.end_s,
            wait_deg=part.wait_deg,
            over_the_top=part.course.over[part.first],
            lost_s=part.course.lost_s[part.last] - part.course.lost_s[part.first],
        )
        yield PlannedPass(part.seen.found, part.seen.followed.priority, flight, _in_part(part, ways, before, after))
        free_s = part.end_s


def _order(each: PlannedPass, from_s: float) -> tuple[float, float]:
    aos_s = from_s if each.found.aos_s is None else each.found.aos_s
    return aos_s, each.flight.begin_s if each.flight else aos_s


def _too_low(found: Pass, followed: Followed) -> str:
    high_deg, asked_deg = found.highest.elevation_deg, followed.min_culmination_deg
    shown = f"{high_deg:.0f}" if round(high_deg) < asked_deg else f"{high_deg:.2f}"
    return f"culminates at {shown}°, below the {asked_deg:g}° asked"


def _unseen(seen: SeenPass) -> str:
    """Why no course of this pass is worth anything."""
    if any(seen.rates):
        return "the rotor does not reach it"
    on_already = seen.found.aos_s is not None and seen.found.aos_s < seen.moments_s[0]
    return f"{'the rest of it' if on_already else 'all of it'} is behind the horizon of trees and roofs"


def _left_out(seen: SeenPass, flown: Sequence[PlannedPass]) -> str:
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


def _in_part(part: Part, ways: Iterable[Course], before: str | None, after: str | None) -> str:
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
