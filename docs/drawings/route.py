"""Finds where the wires of a sheet run: right angles only, never through a part, a word or along another wire.

A* over the grid, wire by wire in the order of the sheet. A step costs 1; a corner, a crossing and the neighbourhood
of others cost more, so that wires run straight and keep apart. Different nets cross at right angles or not at all.
"""

from __future__ import annotations

import heapq
from collections import defaultdict
from dataclasses import dataclass, field
from itertools import pairwise

from docs.drawings.parts import DOWN, LEFT, RIGHT, UP
from docs.drawings.shapes import GRID, Box, Place
from docs.drawings.sheet import WIDTH, Net, Sheet

TURN, CROSSING, CLOSE, SHY = 8, 24, 4, 3
WAYS = (UP, DOWN, LEFT, RIGHT)


class NoWay(Exception):  # noqa: N818 - it says what is wrong with the sheet
    """A wire finds no way: parts stand too close."""


@dataclass(slots=True)
class Routed:
    """One net: its stretches from corner to corner, and the places where three or more meet."""

    net: Net
    paths: list[tuple[Place, ...]] = field(default_factory=list)
    joints: list[Place] = field(default_factory=list)


def route(sheet: Sheet) -> list[Routed]:
    """Every net of the sheet. Raises NoWay with the name of the wire."""
    field_ = _Field(sheet)
    return [field_.lay(net) for net in sheet.nets]


class _Field:
    def __init__(self, sheet: Sheet) -> None:
        self._sheet = sheet
        bodies = [part.body for part in sheet.parts.values()]
        words = [words.box for words in sheet.words()]
        self._blocked = _cells([body.grown(1) for body in bodies] + [box.grown(4) for box in words])
        self._shy = _cells([box.grown(GRID + 1) for box in bodies + words])
        # A pin's first step outwards belongs to its wire alone.
        self._kept = {_step(sheet.pin(name).at, sheet.pin(name).out): net for net in sheet.nets for name in net.pins}
        self._taken: dict[Place, set[Place | None]] = defaultdict(set)

    def lay(self, net: Net) -> Routed:
        own: dict[Place, set[Place]] = defaultdict(set)
        paths = []
        for name in net.pins[1:]:
            pin = self._sheet.pin(name)
            goal = set(own) or {_step(self._sheet.pin(net.pins[0]).at, self._sheet.pin(net.pins[0]).out)}
            cells = self._find(_step(pin.at, pin.out), pin.out, goal, net)
            if cells is None:
                raise NoWay(f"{self._sheet.file}: no way from {net.pins[0]} to {name}")
            cells = [pin.at, *cells]
            if not own:
                cells.append(self._sheet.pin(net.pins[0]).at)
            paths.append(_corners(cells))
            for a, b in pairwise(cells):
                own[a].add(b)
                own[b].add(a)
        for cell, around in own.items():
            straight = (
                len(around) == 2 and sum(x - cell[0] for x, _ in around) == sum(y - cell[1] for _, y in around) == 0
            )
            axis = (0, 1) if straight and next(iter(around))[0] == cell[0] else (1, 0)
            self._taken[cell].add(axis if straight else None)
        return Routed(net, paths, sorted(cell for cell, around in own.items() if len(around) > 2))

    def _find(self, start: Place, way: Place, goal: set[Place], net: Net) -> list[Place] | None:
        xs, ys = [x for x, _ in goal], [y for _, y in goal]
        bounds = Box(min(xs), min(ys), max(xs), max(ys))
        best = {(start, way): 0}
        came: dict[tuple[Place, Place], tuple[Place, Place]] = {}
        open_ = [(_far(start, bounds), 0, start, way)]
        while open_:
            _, cost, cell, way = heapq.heappop(open_)
            if cost > best[cell, way]:
                continue
            if cell in goal:
                return _back(came, (cell, way))
            # No turn on another wire: so none is ever run along, only crossed.
            crossing = bool(self._taken.get(cell))
            for turned in WAYS:
                if (turned[0], turned[1]) == (-way[0], -way[1]) or (crossing and turned != way):
                    continue
                ahead = _step(cell, turned)
                price = self._price(ahead, turned, net, goal)
                if price is None:
                    continue
                total = cost + price + (TURN if turned != way else 0)
                if total < best.get((ahead, turned), 1 << 30):
                    best[ahead, turned] = total
                    came[ahead, turned] = (cell, way)
                    heapq.heappush(open_, (total + _far(ahead, bounds), total, ahead, turned))
        return None

    def _price(self, cell: Place, way: Place, net: Net, goal: set[Place]) -> int | None:
        """What a step to the cell costs; None where it must not go."""
        if cell in goal:
            return 1
        if not (GRID < cell[0] < WIDTH - GRID and GRID < cell[1] < self._sheet.height - GRID):
            return None
        if cell in self._blocked or self._kept.get(cell, net) is not net:
            return None
        axis = (abs(way[0]), abs(way[1]))
        others = self._taken.get(cell, set())
        if None in others:
            return None
        beside = (_step(cell, (way[1], way[0])), _step(cell, (-way[1], -way[0])))
        close = sum(
            CLOSE for place in beside if axis in self._taken.get(place, ()) or None in self._taken.get(place, ())
        )
        return 1 + close + (CROSSING if others else 0) + (SHY if cell in self._shy else 0)


def _step(place: Place, way: Place) -> Place:
    return place[0] + GRID * way[0], place[1] + GRID * way[1]


def _cells(boxes: list[Box]) -> set[Place]:
    return {
        (x, y)
        for box in boxes
        for x in range(-(-box.left // GRID) * GRID, box.right + 1, GRID)
        for y in range(-(-box.top // GRID) * GRID, box.bottom + 1, GRID)
    }


def _far(cell: Place, bounds: Box) -> int:
    """At least so many steps to go."""
    dx = max(bounds.left - cell[0], 0, cell[0] - bounds.right)
    dy = max(bounds.top - cell[1], 0, cell[1] - bounds.bottom)
    return (dx + dy) // GRID


def _back(came: dict[tuple[Place, Place], tuple[Place, Place]], end: tuple[Place, Place]) -> list[Place]:
    cells = [end[0]]
    while end in came:
        end = came[end]
        cells.append(end[0])
    return cells[::-1]


def _corners(cells: list[Place]) -> tuple[Place, ...]:
    inner = [
        b
        for a, b, c in zip(cells, cells[1:], cells[2:], strict=False)
        if (b[0] - a[0], b[1] - a[1]) != (c[0] - b[0], c[1] - b[1])
    ]
    return (cells[0], *inner, cells[-1])
