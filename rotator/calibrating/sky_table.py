"""How far off the boom is at each point, as a table and as a picture, and the terms of a mount in words.

Knows columns and characters. Does not know how a model is found.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import astuple

from rotator.control.sky.model_fit import Miss, SkyPoint
from rotator.control.sky.pointing_model import PointingModel

NAMES = ("IA", "IE", "AN", "AW", "CA", "NPAE")
ROWS, COLUMNS = 9, 25
"""Of the picture: odd, so that the middle is a cell. A character is about twice as high as it is wide."""


def miss_text(miss: Miss) -> str:
    """`1.9° right, 0.7° below`."""
    right, above = miss
    sideways = f"{abs(right):.1f}° {'right' if right >= 0 else 'left'}"
    return f"{sideways}, {abs(above):.1f}° {'above' if above >= 0 else 'below'}"


def terms_text(model: PointingModel) -> str:
    return "  ".join(f"{name} {value + 0.0:+.2f}" for name, value in zip(NAMES, astuple(model), strict=True))


def table(points: Sequence[SkyPoint], before: PointingModel, after: PointingModel | None) -> list[str]:
    """One row a point: where it is, and how far off the boom was there, by the model before and by the new one."""
    rows = [f"  {'point':>5}  {'azimuth':>7}  {'elevation':>9}  {'off now':>7}  {'off then' if after else ''}".rstrip()]
    for number, point in enumerate(points, start=1):
        off = f"{math.hypot(*point.miss(before)):6.2f}°"
        then = f"  {math.hypot(*point.miss(after)):7.2f}°" if after else ""
        rows.append(f"  {number:>5}  {point.azimuth_deg:6.1f}°  {point.elevation_deg:8.1f}°  {off}{then}")
    return rows


def picture(points: Sequence[SkyPoint], before: PointingModel, after: PointingModel) -> list[str]:
    """Where the target was, seen along the boom: o by the model before, * by the new one, + where the boom points."""
    was, left = ([point.miss(model) for point in points] for model in (before, after))
    half_deg = max(0.1, *(abs(part) for miss in (*was, *left) for part in miss))
    cells = {(COLUMNS // 2, ROWS // 2): "+"}
    for misses, mark in ((was, "o"), (left, "*")):
        for right, above in misses:
            column = COLUMNS // 2 + round(right / half_deg * (COLUMNS // 2))
            row = ROWS // 2 - round(above / half_deg * (ROWS // 2))
            cells[column, row] = mark
    drawn = ["".join(cells.get((column, row), "·") for column in range(COLUMNS)) for row in range(ROWS)]
    return [f"  {line}" for line in drawn] + [f"  o now, * then; from edge to edge {2 * half_deg:.1f}°"]
