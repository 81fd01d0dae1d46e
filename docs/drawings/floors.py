"""Places boxes in floors with arrows that go down: which box beside which, and how an arrow gets past floors between.

Knows names and widths. Knows nothing of imports nor of the format.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

from docs.drawings.imports import Arrows, floors

BOX_W, GAP, LANE_W = 128.0, 22.0, 14.0
"""In pixels: a box, the space beside it, and an arrow on its way past a floor."""
SWEEPS = 24


@dataclass(slots=True)
class Spot:
    """A box, or (without a room) the place where an arrow passes a floor."""

    room: str
    x: float = 0.0
    above: list[Spot] = field(default_factory=list)
    below: list[Spot] = field(default_factory=list)

    @property
    def width(self) -> float:
        return BOX_W if self.room else LANE_W


@dataclass(frozen=True, slots=True)
class Plan:
    """`levels`: from the ground up. `ways`: the spots along each arrow, from the room that imports downwards."""

    levels: list[list[Spot]]
    ways: list[list[Spot]]
    width: float


def plan(arrows: Arrows) -> Plan:
    """Raises ValueError where the arrows make a circle."""
    levels = [[Spot(room) for room in rooms] for rooms in floors(arrows)]
    height = {spot.room: at for at, level in enumerate(levels) for spot in level}
    spots = {spot.room: spot for level in levels for spot in level}
    ways = []
    for room in sorted(arrows):
        for below in sorted(arrows[room]):
            way = [spots[room], *(Spot("") for _ in range(height[below] + 1, height[room])), spots[below]]
            for at, lane in enumerate(way[1:-1], start=1):
                levels[height[room] - at].append(lane)
            for upper, lower in pairwise(way):
                upper.below.append(lower)
                lower.above.append(upper)
            ways.append(way)
    for level in levels:
        _spread(level)
    for sweep in range(SWEEPS):
        for level in levels if sweep % 2 else reversed(levels):
            if sweep < SWEEPS // 2:
                level.sort(key=lambda spot: _wish(spot, sweep))
            _settle(level, sweep)
    left = min(spot.x - spot.width / 2 for level in levels for spot in level)
    for level in levels:
        for spot in level:
            spot.x -= left
    return Plan(levels, ways, max(spot.x + spot.width / 2 for level in levels for spot in level))


def _wish(spot: Spot, sweep: int) -> float:
    """Below the middle of what it hangs on, or above the middle of what it stands on."""
    near = (spot.below if sweep % 2 else spot.above) or spot.above or spot.below
    return sum(each.x for each in near) / len(near) if near else spot.x


def _spread(level: list[Spot]) -> None:
    x = -sum(spot.width + GAP for spot in level) / 2
    for spot in level:
        spot.x = x + spot.width / 2
        x += spot.width + GAP


def _settle(level: list[Spot], sweep: int) -> None:
    """Each as near to its wish as its neighbours leave room; their order stays."""
    wishes = [_wish(spot, sweep) for spot in level]
    apart = [(a.width + b.width) / 2 + GAP for a, b in pairwise(level)]
    right = list(wishes)
    for at, gap in enumerate(apart, start=1):
        right[at] = max(right[at], right[at - 1] + gap)
    left = list(wishes)
    for at in reversed(range(len(apart))):
        left[at] = min(left[at], left[at + 1] - apart[at])
    for spot, one, other in zip(level, left, right, strict=True):
        spot.x = (one + other) / 2
