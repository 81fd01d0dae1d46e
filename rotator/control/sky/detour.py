"""The way round forbidden sectors: places to turn to one after another, each by a box that meets no sector.

Knows the sectors with the room that the motors need before them, the limits and the motors' speeds. The places lie on
the crossings of the lines beside the sectors' edges. Knows no order, no goal and no time of day.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Sequence
from dataclasses import dataclass

from hw.ports import Axis
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import Speeds
from rotator.control.sky.sectors import Box, Kept, Place, box_at, kept, ways_out

BESIDE_DEG = 0.6
"""The lines beside a sector lie this much further out: a motor stops about there, not exactly there."""
OTHER_SIDE_DEG = 5.0
"""Beside a target inside a sector the antenna changes sides only where it comes this much nearer."""


@dataclass(frozen=True, slots=True)
class Detour:
    """The places to turn to, one after another. The last one is the target, or the nearest place that is free."""

    places: tuple[Place, ...]
    sector: str = ""
    """The sector that keeps the antenna from the target, or that it has to leave first; empty: none does."""
    leaves: bool = False
    """The antenna may be inside that sector, and the only place is the nearest one outside."""


class Detours:
    """`room_deg`: the room that each axis needs before a sector, beside the sector's margin. `about_deg`: how far each
    axis may be from the place to which it was sent."""

    def __init__(self, mount: Mount, room_deg: Place, about_deg: Place, speeds: Speeds) -> None:
        self.limits = Box(mount.azimuth, mount.elevation)
        self._speeds = speeds
        self._kept = [kept(sector) for sector in mount.sectors]
        self._zones = [kept(sector, *room_deg) for sector in mount.sectors]
        self._about_deg = about_deg
        self._lines = {axis: self._beside(axis) for axis in Axis}

    def _beside(self, axis: Axis) -> list[float]:
        limits, about_deg = self.limits.of(axis), self._about_deg[0 if axis is Axis.AZIMUTH else 1]
        edges_deg = {limits.min_deg, limits.max_deg}
        for zone in self._zones:
            beside = zone.box.of(axis).widened(about_deg + BESIDE_DEG)
            edges_deg |= {beside.min_deg, beside.max_deg}
        return sorted(edge_deg for edge_deg in edges_deg if limits.holds(edge_deg))

    def free(self, here: Box, place: Place) -> bool:
        """Whether the antenna may turn there with both axes at once."""
        swept = here.stretched(place)
        return not any(zone.box.meets(swept) for zone in self._seen_from(here)) and not self._inside(here)

    def further(self, here: Box, places: Sequence[Place]) -> int | None:
        """The last of these places to which the antenna may turn at once; None: there is none."""
        return next((at for at in reversed(range(len(places))) if self.free(here, places[at])), None)

    def round(self, here: Box, target: Place, before: Place | None = None) -> Detour:
        """The way to the target, or to the nearest free place that can be reached.

        `before`: where the antenna was sent before, if not to its target. It keeps to that side of a sector.
        """
        if ways := ways_out(self._kept, here, self.limits):
            way = ways[0]
            beside_deg = self.limits.of(way.axis).nearest(self._clear_of(way.axis, way.to_deg, way.direction))
            middle = here.middle
            out = (beside_deg, middle[1]) if way.axis is Axis.AZIMUTH else (middle[0], beside_deg)
            return Detour((out,), " and ".join(sorted(way.through)), leaves=True)
        if inside := self._inside(here):
            return Detour((here.middle,), inside, leaves=True)
        lines = {
            axis: sorted({*self._lines[axis], here.of(axis).middle_deg, self.limits.of(axis).nearest(target_deg)})
            for axis, target_deg in zip(Axis, target, strict=True)
        }
        # An antenna that stands nearer to a sector than it should keeps that distance until it is further away.
        first = self._seen_from(here)
        zones = [near if zone.box.meets(here) else zone for near, zone in zip(first, self._zones, strict=True)]
        grid = _Grid(here, lines, (first, zones), self._about_deg, self._speeds)
        reached = grid.reached(target)
        sides = set(enumerate(before)) if before is not None else set()

        def off_deg(place: Place) -> float:
            far_deg = math.hypot(
                (place[0] - target[0]) * math.cos(math.radians(target[1])) or 1e-6 * (place[0] - target[0]),
                place[1] - target[1],
            )
            same = any(side in sides and side[1] != target[side[0]] for side in enumerate(place))
            return far_deg - OTHER_SIDE_DEG if same and place != target else far_deg

        end = target if target in reached else min(reached, key=lambda place: (off_deg(place), reached[place]))
        sector = "" if end == target else self._between(end, target)
        return Detour(tuple(self._pulled(here, grid.way_to(end))), sector)

    def seconds(self, here: Box, target: Place) -> float:
        """How long the way to the target takes at the motors' speeds; endless where there is none."""
        if self.free(here, target):
            return self._travel_s(here.middle, target)
        detour = self.round(here, target)
        if detour.places[-1] != target:
            return math.inf
        total_s, at = 0.0, here.middle
        for place in detour.places:
            total_s += self._travel_s(at, place)
            at = place
        return total_s

    def _travel_s(self, a: Place, b: Place) -> float:
        return max(abs(b[0] - a[0]) / self._speeds.azimuth_dps, abs(b[1] - a[1]) / self._speeds.elevation_dps)

    def _clear_of(self, axis: Axis, edge_deg: float, direction: int) -> float:
        """The first line beyond an edge that leaves room for the motor."""
        lines_deg = [line_deg for line_deg in self._lines[axis] if (line_deg - edge_deg) * direction > 0]
        return min(lines_deg, key=lambda line_deg: abs(line_deg - edge_deg), default=edge_deg)

    def _pulled(self, here: Box, places: Sequence[Place]) -> list[Place]:
        """The same way with as few places as it needs."""
        pulled: list[Place] = []
        while places:
            at = self.further(here, places) or 0
            pulled.append(places[at])
            here, places = box_about(places[at], self._about_deg), places[at + 1 :]
        return pulled

    def _inside(self, here: Box) -> str:
        return " and ".join(each.name for each in self._kept if each.box.meets(here))

    def _between(self, end: Place, target: Place) -> str:
        """The sector in which the target is, or the first one between the two."""
        at_target, swept = box_at(target), box_at(end).stretched(target)
        for box in (at_target, swept):
            for zone in self._zones:
                if zone.box.meets(box):
                    return zone.name
        return self._zones[0].name

    def _seen_from(self, here: Box) -> list[Kept]:
        """The sectors with the room before them: less of it on each side where the antenna stands nearer already."""
        return [
            zone if each.box.meets(here) else _shrunk(zone, each.box, here)
            for zone, each in zip(self._zones, self._kept, strict=True)
        ]


def _shrunk(zone: Kept, core: Box, here: Box) -> Kept:
    """The zone without the sides on which the antenna stands."""
    box = zone.box
    for axis in Axis:
        span, inner, mine = box.of(axis), core.of(axis), here.of(axis)
        if mine.max_deg <= inner.min_deg:
            box = box.but(axis, Range(max(span.min_deg, mine.max_deg), span.max_deg))
        if mine.min_deg >= inner.max_deg:
            box = box.but(axis, Range(span.min_deg, min(span.max_deg, mine.min_deg)))
    return Kept(zone.name, box)


def box_about(place: Place, about_deg: Place) -> Box:
    """Where the antenna may be when it has come to rest at this place."""
    azimuth, elevation = (Range(deg - off_deg, deg + off_deg) for deg, off_deg in zip(place, about_deg, strict=True))
    return Box(azimuth, elevation)


class _Grid:
    """Every crossing of the lines beside the sectors, and of those through start and target, and the ways between."""

    def __init__(
        self,
        here: Box,
        lines: dict[Axis, list[float]],
        zones: tuple[Sequence[Kept], Sequence[Kept]],
        about_deg: Place,
        speeds: Speeds,
    ) -> None:
        self._here, self._about_deg = here, about_deg
        self._first, self._zones = zones
        """The sectors with their room, as seen from the start, and from everywhere else."""
        self._start = here.middle
        self._azimuths_deg, self._elevations_deg = lines[Axis.AZIMUTH], lines[Axis.ELEVATION]
        self._dps = speeds.azimuth_dps, speeds.elevation_dps
        self._from: dict[Place, Place] = {}

    def reached(self, target: Place) -> dict[Place, float]:
        """The places that can be reached, with the seconds that it takes there (Dijkstra's way): those that are no
        further than the target, or all of them."""
        at_az, at_el = self._azimuths_deg.index(self._start[0]), self._elevations_deg.index(self._start[1])
        found: dict[Place, float] = {}
        waiting: list[tuple[float, int, int, Place]] = [(0.0, at_az, at_el, self._start)]
        while waiting:
            spent_s, i, j, before = heapq.heappop(waiting)
            place = self._azimuths_deg[i], self._elevations_deg[j]
            if place in found:
                continue
            found[place], self._from[place] = spent_s, before
            if place == target:
                break
            for ni, nj in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if not (0 <= ni < len(self._azimuths_deg) and 0 <= nj < len(self._elevations_deg)):
                    continue
                then = self._azimuths_deg[ni], self._elevations_deg[nj]
                if then not in found and self._free(place, then):
                    step_s = abs(then[0] - place[0]) / self._dps[0] + abs(then[1] - place[1]) / self._dps[1]
                    heapq.heappush(waiting, (spent_s + step_s, ni, nj, place))
        return found

    def _free(self, place: Place, then: Place) -> bool:
        if place == self._start:
            return not any(zone.box.meets(self._here.stretched(then)) for zone in self._first)
        swept = box_about(place, self._about_deg).stretched(then)
        return not any(zone.box.meets(swept) for zone in self._zones)

    def way_to(self, end: Place) -> list[Place]:
        """The places from the start on, without the start unless it is the end."""
        places = [end]
        while self._from[places[-1]] != places[-1]:
            places.append(self._from[places[-1]])
        return places[-2::-1] or [end]
