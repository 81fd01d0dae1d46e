"""The plan of many passes: which of them the antenna flies, and which part of each where two are up at once.

Knows the worth of each part of a pass on each of its courses, and makes flights of the best chain of parts. Knows no
clock: time is an argument, in seconds since 1970 (UTC).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.sectors import Place
from rotator.orbits.passes import passes
from rotator.tracking.chain import Part, best_chain, ready_s
from rotator.tracking.courses import Course, SeenPass, courses, seen_pass
from rotator.tracking.planned import SPARE_S, Flight, Followed, PlannedPass
from rotator.tracking.reasons import in_part, left_out, too_low, unseen
from rotator.tracking.travel import Travel

START_S = 5.0
"""Extra seconds before the antenna sets off, if there is time: for the planning of the steps and the motors' start."""


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
                planned.append(PlannedPass(found, each.priority, None, too_low(found, each)))
                continue
            seen = seen_pass(found, each, antenna.mount, from_s, until_s)
            if ways := courses(seen, antenna.mount, travel):
                flyable.append((seen, ways))
            else:
                planned.append(PlannedPass(found, each.priority, None, unseen(seen)))
    parts = widened(best_chain(flyable, antenna.stands_deg, travel, from_s), antenna.stands_deg, travel, from_s)
    ways_of = {id(seen): ways for seen, ways in flyable}
    flown = list(_flights(parts, ways_of, travel, from_s))
    chosen = {id(part.seen) for part in parts}
    for seen, _ in flyable:
        if id(seen) not in chosen:
            planned.append(PlannedPass(seen.found, seen.followed.priority, None, left_out(seen, flown)))
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
        yield PlannedPass(part.seen.found, part.seen.followed.priority, flight, in_part(part, ways, before, after))
        free_s = part.end_s


def _order(each: PlannedPass, from_s: float) -> tuple[float, float]:
    aos_s = from_s if each.found.aos_s is None else each.found.aos_s
    return aos_s, each.flight.begin_s if each.flight else aos_s
