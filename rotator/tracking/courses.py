"""The courses on which the antenna can fly one pass: on each turn of azimuth, over the top, or with an unwind in it.

Knows the axis angles at each look and the worth of each second there: nothing behind trees and roofs, and half as much
at the horizon as overhead. Knows no other pass.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from rotator.control.sky.angles import turn_deg
from rotator.control.sky.mount import Mount
from rotator.control.sky.route import STEP_S, Flown, Way
from rotator.control.sky.sectors import Place
from rotator.control.sky.ways import EVEN_S, possible_ways
from rotator.orbits.passes import Pass
from rotator.orbits.sight import NotThere, Sight
from rotator.tracking.planned import Followed
from rotator.tracking.travel import Travel

LOOKS, LONG_S = 720, 43_200.0
"""Looks at the path of a pass: one every `STEP_S` seconds, and this number in a long pass; in each half day of a
target that stays up, however long the plan is: the plan of a day and that of three leave it for the same passes."""
CUTS = 240
CUT_S = 15.0
"""Cuts, where a pass may be begun late or left early: seconds between two cuts, or their number in a long pass."""
WORST_SHARE = 0.5
"""A course with less than this share of the best course's worth is not considered."""


@dataclass(frozen=True, slots=True)
class SeenPass:
    """The rest of a pass of a followed target, sampled at even times, the looks."""

    found: Pass
    followed: Followed
    moments_s: Sequence[float]
    directions: Sequence[tuple[float, float]]
    rates: Sequence[float]
    """The worth of a minute at each look."""

    @property
    def step_s(self) -> float:
        return self.moments_s[1] - self.moments_s[0]

    @property
    def cuts(self) -> Sequence[int]:
        """The looks at which the pass may be begun late or left early, and its two ends."""
        last = len(self.moments_s) - 1
        return [*range(0, last, self.apart), last]

    @property
    def apart(self) -> int:
        """Looks from one cut to the next."""
        return max(1, round(CUT_S / self.step_s), math.ceil(min(len(self.moments_s), LOOKS) / CUTS))


@dataclass(frozen=True, slots=True)
class Course:
    """A whole pass on one course. Each list has an item for each look."""

    places: Sequence[Place]
    over: Sequence[bool]
    stands: Sequence[bool]
    """Whether the antenna may begin or end at each look: not beside a sector, nor while it turns to another turn."""
    gained: Sequence[float]
    """The worth gained up to each look."""
    lost_s: Sequence[float]
    """Up to each look: the time for which the antenna is more than 10° off."""


def seen_pass(found: Pass, followed: Followed, mount: Mount, from_s: float, until_s: float) -> SeenPass:
    begin_s = from_s if found.aos_s is None else max(found.aos_s, from_s)
    end_s = max(until_s, begin_s + STEP_S) if found.los_s is None else found.los_s
    count = max(1, math.ceil((end_s - begin_s) / max(STEP_S, min(end_s - begin_s, LONG_S) / LOOKS)))
    moments_s = [begin_s + (end_s - begin_s) * look / count for look in range(count + 1)]
    directions, rates = [], []
    for at_s in moments_s:
        sight = _sight(found, followed, at_s)
        azimuth_deg, elevation_deg = sight.azimuth_deg, max(0.0, sight.elevation_deg)
        directions.append((azimuth_deg, elevation_deg))
        seen = elevation_deg >= mount.horizon_deg(azimuth_deg)
        rates.append(followed.priority * (1 + math.sin(math.radians(elevation_deg))) / 2 if seen else 0.0)
    return SeenPass(found, followed, moments_s, directions, rates)


def _sight(found: Pass, followed: Followed, at_s: float) -> Sight:
    """A satellite that decays during the pass is taken at its highest place."""
    try:
        return followed.target.sight(at_s)
    except NotThere:
        return found.highest


def courses(seen: SeenPass, mount: Mount, travel: Travel) -> list[Course]:
    """All courses worth flying."""
    plain = [_on_one_way(seen, mount, way, travel) for way in _reaching(seen, mount)]
    found = [course for course in plain if course.gained[-1] > 0]
    if not found:
        return []
    if min(course.lost_s[-1] for course in found) > EVEN_S:
        changed = [_changed(seen, before, after, travel) for before in found for after in found if before is not after]
        found += [each for each in changed if each is not None]
    most = max(course.gained[-1] for course in found)
    return [course for course in found if course.gained[-1] >= WORST_SHARE * most]


def _reaching(seen: SeenPass, mount: Mount) -> list[Way]:
    """The ways that lie at least partly within the range."""
    turned_deg = list(
        accumulate(
            turn_deg(before[0], after[0]) for before, after in zip(seen.directions, seen.directions[1:], strict=False)
        )
    )
    least_deg, most_deg = min(0.0, *turned_deg), max(0.0, *turned_deg)
    return [
        way
        for way in possible_ways(mount, seen.directions[0])
        if way.azimuth_deg + least_deg <= mount.azimuth.max_deg and way.azimuth_deg + most_deg >= mount.azimuth.min_deg
    ]


def _on_one_way(seen: SeenPass, mount: Mount, way: Way, travel: Travel) -> Course:
    flown = Flown(mount, seen.directions, way)
    places = [
        (azimuth_deg, mount.clear_deg(azimuth_deg, elevation_deg))
        for azimuth_deg, elevation_deg in zip(flown.azimuths_deg, flown.elevations_deg, strict=True)
    ]
    step_s = seen.step_s
    gains, losses_s = [0.0], [0.0]
    for look, rate in enumerate(seen.rates[:-1]):
        share = flown.loss_s(look) / STEP_S if travel.on_this_side(places[look]) else 1.0
        gains.append(rate * (1.0 - share) * step_s / 60.0)
        losses_s.append(step_s if share >= 1.0 and rate > 0 else 0.0)
    over = [way.flipped] * len(places)
    stands = [travel.may_stand(place) for place in places]
    return Course(places, over, stands, list(accumulate(gains)), list(accumulate(losses_s)))


def _changed(seen: SeenPass, before: Course, after: Course, travel: Travel) -> Course | None:
    """The change from one course to another in the middle of the pass, at the best look. None: no look is worth it."""
    last = len(seen.moments_s) - 1
    step_s = seen.step_s
    most, best = max(before.gained[-1], after.gained[-1]), None
    for look in range(last):
        arrival = look + _looks(travel.least_s(before.places[look], after.places[look]), step_s)
        if arrival < last:
            gained = before.gained[look] + after.gained[-1] - after.gained[arrival]
            if gained > most:
                most, best = gained, look
    if best is None:
        return None
    spent_s = travel.seconds(before.places[best], after.places[best])
    if best + spent_s / step_s >= last:
        return None
    arrival = best + _looks(spent_s, step_s)
    under_way = arrival - best
    gained, lost_s = before.gained[best], before.lost_s[best]
    return Course(
        [*before.places[: best + 1], *after.places[best + 1 :]],
        [*before.over[: best + 1], *after.over[best + 1 :]],
        [*before.stands[: best + 1], *[False] * (under_way - 1), *after.stands[arrival:]],
        [
            *before.gained[: best + 1],
            *[gained] * (under_way - 1),
            *(gained + each - after.gained[arrival] for each in after.gained[arrival:]),
        ],
        [
            *before.lost_s[: best + 1],
            *(lost_s + step_s * (look + 1) for look in range(under_way - 1)),
            *(lost_s + step_s * under_way + each - after.lost_s[arrival] for each in after.lost_s[arrival:]),
        ],
    )


def _looks(travel_s: float, step_s: float) -> int:
    """The number of looks until the antenna is there."""
    return max(1, math.ceil(travel_s / step_s))
