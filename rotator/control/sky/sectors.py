"""Boxes of azimuth and elevation, on the axes' own scales: the sectors in which the antenna would touch something.

While each axis turns one way, from one angle to another, the antenna stays in the box that the two places span, at any
speed of the motors. So a move is safe where that box meets no sector; and an antenna inside a sector may only leave it.
Knows boxes. Knows no motor and no order.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Range, Sector

NEAREST_MORE_DEG = 3.0
"""An edge that is this much further than the nearest one is as good a way out: readings tremble."""
UNKNOWN = Range(-math.inf, math.inf)
"""The range of an axis whose angle is not known."""
OTHER = {Axis.AZIMUTH: Axis.ELEVATION, Axis.ELEVATION: Axis.AZIMUTH}

Place = tuple[float, float]
"""Azimuth and elevation, as axis angles in degrees."""


@dataclass(frozen=True, slots=True)
class Box:
    """Where the two axes may be."""

    azimuth: Range
    elevation: Range

    def of(self, axis: Axis) -> Range:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    def but(self, axis: Axis, span: Range) -> Box:
        """The same box with another span of one axis."""
        return Box(span, self.elevation) if axis is Axis.AZIMUTH else Box(self.azimuth, span)

    def meets(self, other: Box) -> bool:
        return self.azimuth.meets(other.azimuth) and self.elevation.meets(other.elevation)

    def stretched(self, place: Place) -> Box:
        """The box that holds this place too: what a move there, each axis one way, may sweep."""
        return Box(self.azimuth.spanning(place[0]), self.elevation.spanning(place[1]))

    @property
    def known(self) -> bool:
        return UNKNOWN not in (self.azimuth, self.elevation)

    @property
    def middle(self) -> Place:
        return self.azimuth.middle_deg, self.elevation.middle_deg


def box_at(place: Place) -> Box:
    return Box(Range(place[0], place[0]), Range(place[1], place[1]))


@dataclass(frozen=True, slots=True)
class Kept:
    """A sector with what is kept free around it."""

    name: str
    box: Box


def kept(sector: Sector, more_azimuth_deg: float = 0.0, more_elevation_deg: float = 0.0) -> Kept:
    """The sector with its margin, and more of it on each axis."""
    azimuth_deg, elevation_deg = sector.margin_deg + more_azimuth_deg, sector.margin_deg + more_elevation_deg
    return Kept(sector.name, Box(sector.azimuth.widened(azimuth_deg), sector.elevation.widened(elevation_deg)))


@dataclass(frozen=True, slots=True)
class WayOut:
    """One axis turns in one direction until the antenna has left every sector in which it may be."""

    axis: Axis
    direction: Direction
    to_deg: float
    far_deg: float
    through: frozenset[str]
    """The sectors that it leaves, or passes where they overlap with those."""


def ways_out(sectors: Iterable[Kept], where: Box, limits: Box) -> list[WayOut]:
    """The nearest ways out of the sectors in which the antenna may be. Empty: it is in no sector, or cannot leave."""
    every = list(sectors)
    inside = [each for each in every if each.box.meets(where)]
    if not inside:
        return []
    ways = []
    for axis in Axis:
        if where.of(axis) == UNKNOWN:
            continue
        # Where the other axis may be anywhere, a sector that is not met yet might be entered from outside.
        known = where.of(OTHER[axis]) != UNKNOWN
        crossed = [each for each in every if each.box.of(OTHER[axis]).meets(where.of(OTHER[axis]))] if known else inside
        for direction in (Direction.PLUS, Direction.MINUS):
            way = _way_out(axis, direction, where.of(axis), crossed)
            if limits.of(axis).holds(way.to_deg):
                ways.append(way)
    nearest_deg = min((way.far_deg for way in ways), default=0.0)
    return sorted(
        (way for way in ways if way.far_deg <= nearest_deg + NEAREST_MORE_DEG), key=lambda way: (way.far_deg, way.axis)
    )


def _way_out(axis: Axis, direction: Direction, span: Range, crossed: list[Kept]) -> WayOut:
    """Past the far edges of the sectors, one after another where they overlap."""
    begin_deg = to_deg = span.min_deg if direction > 0 else span.max_deg
    through: set[str] = set()
    left = list(crossed)
    while left:
        swept = Range(min(to_deg, span.min_deg), max(to_deg, span.max_deg))
        met = [each for each in left if each.box.of(axis).meets(swept)]
        if not met:
            break
        for each in met:
            edge_deg = each.box.of(axis).max_deg if direction > 0 else each.box.of(axis).min_deg
            to_deg = max(to_deg, edge_deg) if direction > 0 else min(to_deg, edge_deg)
            through.add(each.name)
            left.remove(each)
    return WayOut(axis, direction, to_deg, abs(to_deg - begin_deg), frozenset(through))


def may_sweep(sectors: Iterable[Kept], where: Box, swept: Box, limits: Box) -> bool:
    """Whether the antenna may go from where it may be now to anywhere in `swept`, which holds that place.

    The antenna enters no sector. A sector in which it may be, it leaves by turning one axis.
    """
    every = list(sectors)
    met = {each.name for each in every if each.box.meets(swept)}
    if not met:
        return True
    moved = [axis for axis in Axis if swept.of(axis) != where.of(axis)]
    if len(moved) != 1:
        return False
    axis = moved[0]
    up, down = swept.of(axis).max_deg > where.of(axis).max_deg, swept.of(axis).min_deg < where.of(axis).min_deg
    if up and down:
        return False
    direction = Direction.PLUS if up else Direction.MINUS
    return any(
        way.axis is axis and way.direction is direction and met <= way.through for way in ways_out(every, where, limits)
    )
