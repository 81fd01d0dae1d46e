"""The sky from below the antenna: north up, the zenith in the middle, the horizon as a circle.

Shows the antenna, its target, where the antenna has been, the horizon of trees and roofs, the forbidden sectors and
the ends of an azimuth that does not go all the way round. Draws with dots: eight in each cell. Knows directions and
dots. Knows no motor.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import groupby
from typing import TYPE_CHECKING

from hw.ports import Axis
from rotator.control.sky.angles import direction, great_circle_deg
from rotator.control.sky.mount import Mount, counted_target
from rotator.exchange.status import Status

if TYPE_CHECKING:
    from rich.text import Text

ANTENNA, TARGET, BOTH = "◆", "◇", "◈"
ANTENNA_STYLE, TARGET_STYLE, FORBIDDEN_STYLE = "bold cyan", "bold green", "red"
LEAST_CELLS = 24, 12
"""Columns and rows of the smallest readable plot."""
_BRAILLE = 0x2800
_DOTS = ((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80))
"""The bit of each dot of a cell: by column, then by row from the top."""
_ROUNDED = 0.4999
"""A little less than half a dot: a direction between two dots then always gives the same dot."""
_TRAIL_STEP_DEG, _TRAIL_S = 1.5, 1200.0

Way = tuple[float, float]
"""A direction: azimuth and elevation in degrees, elevation up to 90."""


def pointing(status: Status) -> Way | None:
    """The direction of the antenna; None while an angle is not known."""
    azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
    return None if azimuth_deg is None or elevation_deg is None else direction(azimuth_deg, elevation_deg)


def aimed_at(status: Status) -> Way | None:
    """The wanted direction: each axis where it was ordered, or at its place if it has no order. None: no axis has one,
    or one that turns or is faulty has none: its place would ride with the antenna, as if that were on target.

    In a planned pass it is the satellite's direction, because there a target is the next place of rest.
    """
    azimuth, elevation = status.azimuth, status.elevation
    free = [axis for axis in (azimuth, elevation) if axis.ordered_deg is None]
    if len(free) == len(Axis) or any(axis.moving or axis.fault or axis.by_itself_dps for axis in free):
        return None
    if status.flown and status.wanted_azimuth_deg is not None and status.wanted_elevation_deg is not None:
        wanted = direction(status.wanted_azimuth_deg, status.wanted_elevation_deg)
        antenna = pointing(status)
        return wanted if antenna is None else counted_target(status.fitted, antenna, wanted)
    azimuth_deg, elevation_deg = (
        axis.points_deg if axis.ordered_deg is None else axis.ordered_deg + axis.correction_deg
        for axis in (azimuth, elevation)
    )
    return None if azimuth_deg is None or elevation_deg is None else direction(azimuth_deg, elevation_deg)


def off_deg(status: Status) -> float | None:
    """The angle on the sky between the antenna and its target."""
    antenna, target = pointing(status), aimed_at(status)
    return None if antenna is None or target is None else great_circle_deg(*antenna, *target)


class Trail:
    """The directions of the antenna in the last 20 minutes."""

    def __init__(self) -> None:
        self._points: deque[tuple[float, Way]] = deque()

    def note(self, status: Status) -> None:
        while self._points and status.at_s - self._points[0][0] > _TRAIL_S:
            self._points.popleft()
        here = pointing(status)
        if here and (not self._points or great_circle_deg(*self._points[-1][1], *here) >= _TRAIL_STEP_DEG):
            self._points.append((status.at_s, here))

    @property
    def ways(self) -> list[Way]:
        return [way for _, way in self._points]


class _Canvas:
    """Cells of dots, and marks that take a whole cell. The centre and the radius are in dots."""

    def __init__(self, columns: int, rows: int) -> None:
        self.columns, self.rows = columns, rows
        self.dots: dict[tuple[int, int], tuple[int, str]] = {}
        self.marks: dict[tuple[int, int], tuple[str, str]] = {}
        self.centre = columns - 0.5, 2.0 * rows - 0.5
        # A cell on each side is left for the letters of the compass.
        self.radius = min(columns - 6.0, 2.0 * rows - 7.0)

    def copy(self) -> _Canvas:
        other = _Canvas(self.columns, self.rows)
        other.dots, other.marks = dict(self.dots), dict(self.marks)
        return other

    def place(self, way: Way) -> tuple[int, int]:
        out = self.radius * (90.0 - max(way[1], 0.0)) / 90.0
        angle = math.radians(way[0])
        x, y = self.centre[0] + out * math.sin(angle), self.centre[1] - out * math.cos(angle)
        return math.floor(x + _ROUNDED), math.floor(y + _ROUNDED)

    def dot(self, way: Way, style: str) -> None:
        x, y = self.place(way)
        cell = x // 2, y // 4
        bits, _ = self.dots.get(cell, (0, ""))
        self.dots[cell] = bits | _DOTS[x % 2][y % 4], style

    def mark(self, way: Way, mark: str, style: str) -> None:
        x, y = self.place(way)
        self.marks[x // 2, y // 4] = mark, style

    def letter(self, azimuth_deg: float, letter: str) -> None:
        angle = math.radians(azimuth_deg)
        x = self.centre[0] + (self.radius + 4.0) * math.sin(angle)
        y = self.centre[1] - (self.radius + 5.0) * math.cos(angle)
        self.marks[round(x) // 2, round(y) // 4] = letter, "bold"

    def texts(self) -> list[Text]:
        columns = range(self.columns)
        from rich.text import Text  # noqa: PLC0415 - the page needs only the directions of this file

        return [Text.assemble(*_runs(self._cell(column, row) for column in columns)) for row in range(self.rows)]

    def _cell(self, column: int, row: int) -> tuple[str, str]:
        if (mark := self.marks.get((column, row))) is not None:
            return mark
        bits, style = self.dots.get((column, row), (0, ""))
        return (chr(_BRAILLE + bits), style) if bits else (" ", "")


def _runs(cells: Iterable[tuple[str, str]]) -> Iterable[tuple[str, str]]:
    """Joins neighbours of the same style, which is drawn much faster."""
    for style, run in groupby(cells, lambda cell: cell[1]):
        yield "".join(text for text, _ in run), style


def plot(columns: int, rows: int, status: Status, mount: Mount | None, trail: Iterable[Way] = ()) -> list[Text]:
    """The plot with a legend as its last row, each row `columns` cells wide."""
    canvas = _backdrop(columns, rows - 1, mount).copy()
    _curve(canvas, list(trail), "cyan")
    antenna, target = pointing(status), aimed_at(status)
    if target:
        canvas.mark(target, TARGET, TARGET_STYLE)
    if antenna:
        same = target is not None and canvas.place(target) == canvas.place(antenna)
        canvas.mark(antenna, BOTH if same else ANTENNA, ANTENNA_STYLE)
    from rich.text import Text  # noqa: PLC0415 - the page needs only the directions of this file

    legend = Text.assemble((ANTENNA, ANTENNA_STYLE), " antenna   ", (TARGET, TARGET_STYLE), " target")
    legend.align("center", columns)
    return [*canvas.texts(), legend]


@lru_cache(maxsize=4)
def _backdrop(columns: int, rows: int, mount: Mount | None) -> _Canvas:
    """The part of the plot that stays the same while the terminal has this size."""
    canvas = _Canvas(columns, rows)
    # At any size the horizon is solid, and the others are dotted, with two empty dots between two.
    for elevation_deg, dots, most_deg in ((0.0, 0.9, 1.0), (30.0, 3.0, 6.0), (60.0, 3.0, 10.0)):
        radius = max(canvas.radius * (90.0 - elevation_deg) / 90.0, 1.0)
        step_deg = min(most_deg, math.degrees(dots / radius))
        _curve(canvas, [(step * step_deg, elevation_deg) for step in range(math.ceil(360.0 / step_deg))], "dim")
    if mount:
        _obstacles(canvas, mount)
    for at, letter in enumerate("NESW"):
        canvas.letter(90.0 * at, letter)
    return canvas


def _obstacles(canvas: _Canvas, mount: Mount) -> None:
    if mount.horizon:
        lowest_deg = max(mount.elevation.min_deg, 0.0)
        _curve(canvas, [(az / 2, mount.clear_deg(az / 2, lowest_deg)) for az in range(720)], "yellow")
    if mount.azimuth.max_deg - mount.azimuth.min_deg < 360.0:
        for end_deg in (mount.azimuth.min_deg, mount.azimuth.max_deg):
            _curve(canvas, [(end_deg, float(elevation)) for elevation in range(0, 90, 3)], FORBIDDEN_STYLE)
    for sector in mount.sectors:
        azimuths = _steps(sector.azimuth.min_deg, sector.azimuth.max_deg)
        elevations = _steps(max(sector.elevation.min_deg, 0.0), sector.elevation.max_deg)
        _curve(canvas, [direction(az, el) for az in azimuths for el in elevations], FORBIDDEN_STYLE)


def _steps(low_deg: float, high_deg: float) -> Sequence[float]:
    count = max(round((high_deg - low_deg) / 4.0), 1)
    return [low_deg + (high_deg - low_deg) * step / count for step in range(count + 1)]


def _curve(canvas: _Canvas, ways: Iterable[Way], style: str) -> None:
    for way in ways:
        canvas.dot(way, style)
