"""Strokes, discs, words and boxes on a grid of ten units. Knows geometry and how wide a word is; nothing electrical."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

GRID = 10
"""Every pin and every corner of a wire lies on a multiple of it."""

INK = "#222"
SMALL, PLAIN, LARGE = 17, 18, 22
"""Sizes of letters. A sheet is 1200 wide: at 800 pixels the small ones are 11 pixels high."""

Place = tuple[int, int]
Anchor = Literal["start", "middle", "end"]


@dataclass(frozen=True, slots=True)
class Box:
    left: int
    top: int
    right: int
    bottom: int

    def grown(self, by: int) -> Box:
        return Box(self.left - by, self.top - by, self.right + by, self.bottom + by)

    def holds(self, place: Place) -> bool:
        """Strictly inside: the edge is outside."""
        return self.left < place[0] < self.right and self.top < place[1] < self.bottom

    def meets(self, other: Box) -> bool:
        """They share more than an edge."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )


@dataclass(frozen=True, slots=True)
class Stroke:
    points: tuple[Place, ...]
    width: float = 2.5
    fill: str = "none"
    closed: bool = False
    colour: str = INK


@dataclass(frozen=True, slots=True)
class Disc:
    centre: Place
    radius: float
    fill: str = INK


@dataclass(frozen=True, slots=True)
class Words:
    at: Place
    """The middle of the line's height; left end, middle or right end by `anchor`."""
    text: str
    size: int = PLAIN
    anchor: Anchor = "start"
    bold: bool = False
    colour: str = INK

    @property
    def box(self) -> Box:
        """The room it takes, a little more than less: fonts differ from viewer to viewer."""
        width = round(len(self.text) * self.size * (0.62 if self.bold else 0.56)) + 4
        left = self.at[0] - {"start": 2, "middle": width // 2, "end": width - 2}[self.anchor]
        half = self.size * 6 // 10
        return Box(left, self.at[1] - half, left + width, self.at[1] + half)


Shape = Stroke | Disc | Words


def rectangle(box: Box, fill: str = "white", width: float = 2.5, colour: str = INK) -> Stroke:
    corners = ((box.left, box.top), (box.right, box.top), (box.right, box.bottom), (box.left, box.bottom))
    return Stroke(corners, width, fill, closed=True, colour=colour)
