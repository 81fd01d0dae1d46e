"""Solid things for the scene: boxes, tubes and cables seen from above at a slant, as SVG.

Knows one projection (parallel lines stay parallel) and how light falls: from the left and above. Knows no rotator.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Point = tuple[float, float]
"""On the picture, in pixels."""
Spot = tuple[float, float, float]
"""In the room: to the right, away from the eye, up; in pixels."""

ACROSS = (0.94, 0.26)
"""Where a pixel to the right goes on the picture."""
AWAY = (0.62, -0.40)
UPWARD = (0.0, -1.0)


@dataclass(frozen=True, slots=True)
class Colour:
    red: int
    green: int
    blue: int

    def lit(self, by: float) -> str:
        """Brighter above 1, darker below."""
        return "#" + "".join(f"{max(0, min(255, round(part * by))):02x}" for part in (self.red, self.green, self.blue))


def seen(origin: Point, spot: Spot) -> Point:
    x, y, z = spot
    return (
        round(origin[0] + x * ACROSS[0] + y * AWAY[0] + z * UPWARD[0], 1),
        round(origin[1] + x * ACROSS[1] + y * AWAY[1] + z * UPWARD[1], 1),
    )


def polygon(points: Sequence[Point], fill: str, extra: str = "") -> str:
    return f'<polygon points="{_joined(points)}" fill="{fill}"{extra}/>'


def box(origin: Point, at: Spot, size: Spot, colour: Colour) -> list[str]:
    """The three faces that are seen: top, front, right side."""
    (x, y, z), (wide, deep, high) = at, size

    def corner(right: int, back: int, top: int) -> Point:
        return seen(origin, (x + right * wide, y + back * deep, z + top * high))

    return [
        polygon([corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)], colour.lit(1.12)),
        polygon([corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)], colour.lit(0.82)),
        polygon([corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)], colour.lit(0.58)),
    ]


def shadow(origin: Point, at: Spot, size: Spot) -> str:
    """On the table under a box, thrown to the right."""
    (x, y, _), (wide, deep, _) = at, size
    around = [(x, y), (x + wide + 16, y), (x + wide + 16, y + deep - 4), (x + 10, y + deep)]
    return polygon([seen(origin, (right, back, 0)) for right, back in around], "#2a1608", ' opacity="0.45"')


def flat(origin: Point, at: Spot) -> str:
    """The transformation that lays a drawing on a table or a board: its x to the right, its y towards the eye."""
    x, y = seen(origin, at)
    return f"matrix({ACROSS[0]} {ACROSS[1]} {-AWAY[0]} {-AWAY[1]} {x} {y})"


def upright(origin: Point, foot: Spot, high: float, lean: float) -> str:
    """The transformation of a drawing on a screen that stands along the x of the room and leans back.

    `foot`: where its lower left corner stands; the drawing is `high`; `lean`: how far back for each pixel of height.
    """
    x, y = seen(origin, foot)
    down_x, down_y = -lean * AWAY[0], 1 - lean
    return f"matrix({ACROSS[0]} {ACROSS[1]} {down_x:.3f} {down_y:.3f} {x - high * down_x:.1f} {y - high * down_y:.1f})"


def tube(one: Point, other: Point, width: float, colour: Colour) -> list[str]:
    """A round bar: dark edge, body, and a light line where the sun is."""
    (ax, ay), (bx, by) = one, other
    long = max(1.0, ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5)
    # The light comes from the left and above: the bright line lies on that side of the bar.
    nx, ny = (by - ay) / long, -(bx - ax) / long
    if nx + ny > 0:
        nx, ny = -nx, -ny
    nx, ny = nx * width * 0.22, ny * width * 0.22
    return [
        _line(one, other, width, colour.lit(0.45)),
        _line(one, other, width * 0.72, colour.lit(0.85)),
        _line((ax + nx, ay + ny), (bx + nx, by + ny), width * 0.24, colour.lit(1.5)),
    ]


def cable(path: str, width: float, colour: Colour) -> list[str]:
    """A cable along an SVG path, with its shadow on what lies below."""
    drawn = 'fill="none" stroke-linecap="round"'
    return [
        f'<path d="{path}" {drawn} stroke="#1c0f05" stroke-opacity="0.35" stroke-width="{width}"'
        f' transform="translate(5 7)"/>',
        f'<path d="{path}" {drawn} stroke="{colour.lit(0.6)}" stroke-width="{width}"/>',
        f'<path d="{path}" {drawn} stroke="{colour.lit(1.4)}" stroke-width="{width * 0.3:.1f}"'
        f' transform="translate(-1 -1.5)"/>',
    ]


def _line(one: Point, other: Point, width: float, colour: str) -> str:
    return (
        f'<line x1="{one[0]:.1f}" y1="{one[1]:.1f}" x2="{other[0]:.1f}" y2="{other[1]:.1f}" stroke="{colour}"'
        f' stroke-width="{width:.1f}" stroke-linecap="round"/>'
    )


def _joined(points: Sequence[Point]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
