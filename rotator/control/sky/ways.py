"""The way of the antenna through a whole pass: which turn of the overlap, over the top or not, and when it changes.

Knows the target's path to its end, the ranges and the motors' speeds. A moment at which the antenna points elsewhere is
lost; the least loss over the whole pass is found by going back from its end (dynamic programming). Knows nothing of
steps, relays or sensors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.mount import Mount
from rotator.control.sky.route import Direction, Flown, Speeds, Way

EVEN_S = 0.5
"""Ways that lose so much more are as good as the best: the nearest of them is taken."""


@dataclass(frozen=True, slots=True)
class Leg:
    """From this look on, the antenna is on this way."""

    look: int
    flown: Flown


@dataclass(frozen=True, slots=True)
class Route:
    legs: tuple[Leg, ...]
    lost_s: float
    """How many seconds of the pass are lost: at a limit, or on the way from one turn to another."""


def best_route(
    mount: Mount,
    directions: Sequence[Direction],
    from_deg: tuple[float, float],
    early_s: float,
    speeds: Speeds,
    *,
    begin_on: Way | None = None,
) -> Route:
    """Through directions that are `STEP_S` apart.

    `from_deg`: where the axes stand. `early_s`: how long it is until the first of the directions. `begin_on`: the way
    nearest to this one is the first, as a plan of many passes has chosen it.
    """
    ways = [Flown(mount, directions, way) for way in possible_ways(mount, directions[0])]
    # least[way][look]: what is lost from this look on, being on this way; then where to change to, if anywhere.
    least = [[0.0] * (len(directions) + 1) for _ in ways]
    changes: list[list[tuple[int, int] | None]] = [[None] * len(directions) for _ in ways]
    for look in reversed(range(len(directions))):
        stays = [way.loss_s(look) + least[index][look + 1] for index, way in enumerate(ways)]
        for index, way in enumerate(ways):
            least[index][look] = stays[index]
            for other, there in enumerate(ways):
                if other == index:
                    continue
                arrival, spent_s = way.change(there, look, speeds)
                if arrival == look:  # both wait at the same limit
                    arrival, spent_s = look + 1, way.loss_s(look)
                cost_s = spent_s + least[other][arrival]
                if cost_s < least[index][look] - EVEN_S:
                    least[index][look], changes[index][look] = cost_s, (other, arrival)
    if begin_on is None:
        costs = [_first_cost(way, from_deg, early_s, speeds, lost[0]) for way, lost in zip(ways, least, strict=True)]
    else:
        costs = [_apart(flown.way, begin_on) for flown in ways]
    first = costs.index(min(costs))
    legs, look, index = [Leg(0, ways[first])], 0, first
    while look < len(directions):
        change = changes[index][look]
        if change is None:
            look += 1
            continue
        index = change[0]
        if legs[-1].look == look:  # it sets off on the other way at once
            legs.pop()
        legs.append(Leg(look, ways[index]))
        look = change[1]
    return Route(tuple(legs), least[first][0])


def _first_cost(
    way: Flown, from_deg: tuple[float, float], early_s: float, speeds: Speeds, lost_s: float
) -> tuple[float, float]:
    """What is lost on this way, and how long the antenna travels to its beginning."""
    travel_s = max(
        abs(way.azimuths_deg[0] - from_deg[0]) / speeds.azimuth_dps,
        abs(way.elevations_deg[0] - from_deg[1]) / speeds.elevation_dps,
    )
    return round((lost_s + max(0.0, travel_s - early_s)) / EVEN_S), travel_s


def _apart(way: Way, other: Way) -> tuple[float, float]:
    return float(way.flipped is not other.flipped), abs(way.azimuth_deg - other.azimuth_deg)


def possible_ways(mount: Mount, first: Direction) -> list[Way]:
    """Every turn that reaches into the range, also one that begins beyond it; over the top where the antenna may."""
    azimuth = mount.azimuth
    found = []
    for flipped in (False, True) if mount.flip else (False,):
        begin_deg, _ = mount.on_the_way(*first, first[0], flipped=flipped)
        turns = range(
            math.floor((azimuth.min_deg - 360.0 - begin_deg) / 360.0),
            math.ceil((azimuth.max_deg + 360.0 - begin_deg) / 360.0) + 1,
        )
        found += [Way(begin_deg + 360.0 * turn, flipped) for turn in turns]
    return found
