"""How far off the boom is at each point, as a table and as a picture, and the terms of a mount in words.

Knows columns and characters. Does not know how a model is found.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass
from itertools import zip_longest

from rotator.control.sky.model_fit import Fit, Miss, SkyPoint
from rotator.control.sky.pointing_model import PointingModel

NAMES = ("IA", "IE", "AN", "AW", "CA", "NPAE")
ROWS, COLUMNS, SKY_COLUMNS = 13, 33, 31
"""Of the picture: odd, so that the middle is a cell. A character is about twice as high as it is wide."""


@dataclass(frozen=True, slots=True)
class Residuals:
    """Points, the model in force when they were taken, and the one that fits them."""

    points: tuple[SkyPoint, ...]
    before: PointingModel
    after: PointingModel


def miss_text(miss: Miss) -> str:
    """`1.9° right, 0.7° below`."""
    right, above = miss
    sideways = f"{abs(right):.1f}° {'right' if right >= 0 else 'left'}"
    return f"{sideways}, {abs(above):.1f}° {'above' if above >= 0 else 'below'}"


def terms_text(model: PointingModel) -> str:
    return "  ".join(f"{name} {value + 0.0:+.2f}" for name, value in zip(NAMES, astuple(model), strict=True))


def found_text(fit: Fit) -> str:
    """Which terms the points were not enough for; empty: they were enough for all."""
    match len(fit.terms):
        case 2:
            return " IA and IE are found; for the tilt it takes three points or more, far apart."
        case 4:
            return " CA and NPAE stay: for these it takes six points, low and high."
        case _:
            return ""


def table(points: Sequence[SkyPoint], before: PointingModel, after: PointingModel | None) -> list[str]:
    """One row a point: where it is, and how far off the boom was there, by the model before and by the new one."""
    rows = [f"  {'point':>5}  {'azimuth':>7}  {'elevation':>9}  {'off now':>7}  {'off then' if after else ''}".rstrip()]
    for number, point in enumerate(points, start=1):
        off = f"{math.hypot(*point.miss(before)):6.2f}°"
        then = f"  {math.hypot(*point.miss(after)):7.2f}°" if after else ""
        rows.append(f"  {number:>5}  {point.azimuth_deg:6.1f}°  {point.elevation_deg:8.1f}°  {off}{then}")
    return rows


def pictures(shown: Residuals) -> list[str]:
    """Two side by side: where each point is on the sky, by its number, and where the target was in the beam."""
    sky, beam = _sky(shown.points), _beam(shown)
    return [f"  {left:<{SKY_COLUMNS}}    {right}".rstrip() for left, right in zip_longest(sky, beam, fillvalue="")]


def _sky(points: Sequence[SkyPoint]) -> list[str]:
    """North up, the zenith in the middle, the horizon as a circle."""
    middle_x, middle_y = SKY_COLUMNS // 2, ROWS // 2
    cells = {(middle_x, middle_y): "+"}

    def cell(azimuth_deg: float, elevation_deg: float) -> tuple[int, int]:
        out, az = 1 - max(elevation_deg, 0.0) / 90.0, math.radians(azimuth_deg)
        return middle_x + round(out * math.sin(az) * (middle_x - 1)), middle_y - round(out * math.cos(az) * middle_y)

    cells |= {cell(azimuth_deg, 0.0): "." for azimuth_deg in range(0, 360, 10)}
    cells |= {cell(90.0 * at, 0.0): letter for at, letter in enumerate("NESW")}
    for number, point in enumerate(points, start=1):
        x, y = cell(point.azimuth_deg, point.elevation_deg)
        cells |= {(x + at, y): digit for at, digit in enumerate(str(number))}
    rows = ["".join(cells.get((x, y), " ") for x in range(SKY_COLUMNS)) for y in range(ROWS)]
    return [*rows, "the points on the sky"]


def _beam(shown: Residuals) -> list[str]:
    """Seen along the boom: o by the model before, * by the new one, + where the boom points."""
    was, left = ([point.miss(model) for point in shown.points] for model in (shown.before, shown.after))
    half_deg = max(0.1, *(abs(part) for miss in (*was, *left) for part in miss))
    cells = {(COLUMNS // 2, ROWS // 2): "+"}
    for misses, mark in ((was, "o"), (left, "*")):
        for right, above in misses:
            column = COLUMNS // 2 + round(right / half_deg * (COLUMNS // 2))
            row = ROWS // 2 - round(above / half_deg * (ROWS // 2))
            cells[column, row] = mark
    rows = ["".join(cells.get((column, row), "·") for column in range(COLUMNS)) for row in range(ROWS)]
    return [*rows, f"o now, * then; from edge to edge {2 * half_deg:.1f}°"]
