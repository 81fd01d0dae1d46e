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
from rotator.control.sky.route import LOST_DEG, STEP_S, Direction, Flown, Speeds, Way
from rotator.control.sky.turning import Place, Turning

EVEN_S = 0.5
"""Ways that differ by less are equally good: the nearest of them is taken."""
CHANGE_S = 0.5
"""A change to another way must save this much."""
NEARLY_LOST = 0.1
"""What a second costs just before it is lost; with half that error a quarter of it. Lost seconds come first, then the
square of the error."""
FAR_DEG = 1800.0
"""Of two turns that lose as many seconds, the one with the smaller errors is made: 72° cost 0.04 s a second."""


@dataclass(frozen=True, slots=True)
class Leg:
    """At `look` the antenna leaves for this way, and at `arrival` it is on it."""

    look: int
    arrival: int
    flown: Flown


@dataclass(frozen=True, slots=True)
class Route:
    legs: tuple[Leg, ...]
    lost_s: float
    """How many seconds the antenna is more than `LOST_DEG` off: at a limit, or on the way from one turn to another."""


def best_route(
    mount: Mount,
    directions: Sequence[Direction],
    from_deg: Place,
    early_s: float,
    speeds: Speeds,
    *,
    begin_on: Way | None = None,
) -> Route:
    """Through directions that are `STEP_S` apart.

    `from_deg`: where the axes stand. `early_s`: how long it is until the first of the directions. `begin_on`: the way
    nearest to this one is the first, as a plan of many passes has chosen it.
    """
    turning = Turning(mount, directions, speeds)
    ways = [Flown(mount, directions, way) for way in possible_ways(mount, directions[0], from_deg[0])]
    # cheapest[way][look]: what the rest costs from there on, being on this way; then where to change to, if anywhere.
    cheapest = [[0.0] * (len(directions) + 1) for _ in ways]
    changes: list[list[tuple[int, int] | None]] = [[None] * len(directions) for _ in ways]
    for look in reversed(range(len(directions))):
        for index, way in enumerate(ways):
            cost_s = error_cost_s(way.errors_deg[look]) + cheapest[index][look + 1]
            for other, there in enumerate(ways):
                if other == index or cost_s <= CHANGE_S:
                    continue
                arrival = turning.change(way, there, look)
                then_s = CHANGE_S + cheapest[other][arrival]
                if then_s >= cost_s or not there.holds(arrival):
                    continue
                then_s += sum(map(error_cost_s, turning.errors_deg(way.place(look), there, look, arrival)))
                if then_s < cost_s:
                    cost_s, changes[index][look] = then_s, (other, arrival)
            cheapest[index][look] = cost_s
    begins = [_Beginning(turning, way, from_deg, early_s, rest) for way, rest in zip(ways, cheapest, strict=True)]
    costs = [each.cost if begin_on is None else _apart(each.way.way, begin_on) for each in begins]
    index = costs.index(min(costs))
    begin = begins[index]
    legs, look, lost_s = [Leg(0, begin.look, begin.way)], begin.look, _lost_s(begin.errors_deg)
    while look < len(directions):
        if (change := changes[index][look]) is None:
            lost_s += _lost_s([ways[index].errors_deg[look]])
            look += 1
            continue
        left, (index, arrival) = index, change
        lost_s += _lost_s(turning.errors_deg(ways[left].place(look), ways[index], look, arrival))
        if legs[-1].look == look:  # it sets off on the other way at once
            legs.pop()
        legs.append(Leg(look, arrival, ways[index]))
        look = arrival
    return Route(tuple(legs), lost_s)


class _Beginning:
    """The antenna goes to the beginning of a way. `rest`: the cost of the pass from each look on, on that way."""

    def __init__(self, turning: Turning, way: Flown, from_deg: Place, early_s: float, rest: Sequence[float]) -> None:
        waits_deg = way.place(0)
        begins_deg = turning.after(from_deg, waits_deg, early_s)
        self.way = way
        self.look = turning.arrival(begins_deg, way, 0, left=0)
        """The look at which the antenna is on the way."""
        self.errors_deg = turning.errors_deg(begins_deg, way, 0, self.look)
        cost_s = sum(map(error_cost_s, self.errors_deg)) + rest[self.look]
        self.cost = float(round(cost_s / EVEN_S)), turning.travel_s(from_deg, waits_deg)


def error_cost_s(error_deg: float) -> float:
    """The cost of this error for the time of a look."""
    share = 1.0 if error_deg > LOST_DEG else NEARLY_LOST * (error_deg / LOST_DEG) ** 2
    return STEP_S * (share + error_deg / FAR_DEG)


def _lost_s(errors_deg: Sequence[float]) -> float:
    return STEP_S * sum(error_deg > LOST_DEG for error_deg in errors_deg)


def _apart(way: Way, other: Way) -> tuple[float, float]:
    return float(way.flipped is not other.flipped), abs(way.azimuth_deg - other.azimuth_deg)


def possible_ways(mount: Mount, first: Direction, from_azimuth_deg: float = 0.0) -> list[Way]:
    """Every turn that reaches into the range, also one that begins beyond it; over the top where the antenna may.
    Without ends: the turn that begins nearest to `from_azimuth_deg`."""
    azimuth = mount.azimuth
    found = []
    for flipped in (False, True) if mount.flip else (False,):
        begin_deg, _ = mount.on_the_way(*first, first[0], flipped=flipped)
        if azimuth.endless:
            found.append(Way(mount.near_deg(begin_deg, from_azimuth_deg), flipped))
            continue
        turns = range(
            math.floor((azimuth.min_deg - 360.0 - begin_deg) / 360.0),
            math.ceil((azimuth.max_deg + 360.0 - begin_deg) / 360.0) + 1,
        )
        found += [Way(begin_deg + 360.0 * turn, flipped) for turn in turns]
    return found
