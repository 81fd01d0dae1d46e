"""Looks at a finished sheet as a reader would: what overlaps, what leaves the page, which wire runs through something.

Knows only the geometry that is drawn, nothing of how the wires were found.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise

from docs.drawings.route import Routed
from docs.drawings.shapes import Box, Place
from docs.drawings.sheet import WIDTH, Sheet

Segment = tuple[Place, Place]


def complaints(sheet: Sheet, wires: list[Routed]) -> list[str]:
    """One sentence for each thing that is wrong; none for a clean sheet."""
    return [*_crowded(sheet), *_through(sheet, wires), *_along(wires), *_loose(sheet, wires)]


def _things(sheet: Sheet) -> list[tuple[str, Box]]:
    words = [(f'"{each.text}"', each.box) for each in sheet.words()]
    return [(part.name, part.body) for part in sheet.parts.values()] + words


def _crowded(sheet: Sheet) -> Iterator[str]:
    things = _things(sheet)
    for (name, box), (other, its) in combinations(things, 2):
        if box.meets(its):
            yield f"{name} overlaps {other}"
    for name, box in things:
        if not (box.left >= 0 and box.top >= 0 and box.right <= WIDTH and box.bottom <= sheet.height):
            yield f"{name} leaves the sheet"


def _through(sheet: Sheet, wires: list[Routed]) -> Iterator[str]:
    for wire in wires:
        for segment in _segments(wire):
            for name, box in _things(sheet):
                if box.meets(_thin(segment)):
                    yield f"the wire of {wire.net.pins[0]} runs through {name}"


def _along(wires: list[Routed]) -> Iterator[str]:
    for one, other in combinations(wires, 2):
        for a in _segments(one):
            for b in _segments(other):
                corner = {*a, *b} & _shared(a, b)
                if corner or (_shared(a, b) and (a[0][0] == a[1][0]) == (b[0][0] == b[1][0])):
                    yield f"the wires of {one.net.pins[0]} and {other.net.pins[0]} touch at {min(_shared(a, b))}"


def _loose(sheet: Sheet, wires: list[Routed]) -> Iterator[str]:
    for wire in wires:
        ends = {place for path in wire.paths for place in (path[0], path[-1])}
        for name in wire.net.pins:
            if sheet.pin(name).at not in ends:
                yield f"no wire reaches {name}"


def _segments(wire: Routed) -> list[Segment]:
    return [segment for path in wire.paths for segment in pairwise(path)]


def _span(segment: Segment) -> Box:
    (x, y), (u, v) = segment
    return Box(min(x, u), min(y, v), max(x, u), max(y, v))


def _thin(segment: Segment) -> Box:
    """Half a line's width to each side, and as much short of its ends: a wire may end at an edge."""
    box = _span(segment)
    if box.left == box.right:
        return Box(box.left - 1, box.top + 1, box.right + 1, box.bottom - 1)
    return Box(box.left + 1, box.top - 1, box.right - 1, box.bottom + 1)


def _shared(a: Segment, b: Segment) -> set[Place]:
    one, other = _span(a), _span(b)
    left, right = max(one.left, other.left), min(one.right, other.right)
    top, bottom = max(one.top, other.top), min(one.bottom, other.bottom)
    return {(left, top), (right, bottom)} if left <= right and top <= bottom else set()
