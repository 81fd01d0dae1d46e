"""The sky as a drawing (SVG): north up, the zenith in the middle, the horizon as a circle; in light and in dark.

Draws the compass, trees and roofs, forbidden sectors, the ends of an azimuth that does not go all the way round, and
lines, dots and words on top. Knows directions and pixels. Knows no motor and no file.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from html import escape

from rotator.control.sky.mount import Mount, Sector

Way = tuple[float, float]
"""Azimuth and elevation in degrees; above 90 it is over the top, and on any turn."""
FONT = "DejaVu Sans, Verdana, Arial, sans-serif"
FONT_PX = 17
COLOURS = {
    "paper": ("#ffffff", "#15191e"),
    "ink": ("#333333", "#d5d9dd"),
    "faint": ("#777777", "#959ba1"),
    "grid": ("#c8c8c8", "#444b52"),
    "target": ("#e0b000", "#b99412"),
    "blue": ("#0055bb", "#5aa9ff"),
    "red": ("#bb2222", "#ff7a70"),
    "trees": ("#3f7d3f", "#5da05d"),
    "sector": ("#c04040", "#c85a55"),
}
"""Colours by name: on white paper, and on a dark screen."""
STEP_DEG = 2.0


def document(wide: int, high: int, title: str, parts: Iterable[str]) -> str:
    """The whole drawing. A viewer that supports dark screens uses the dark colours there."""
    light, dark = (_rules(theme) for theme in (0, 1))
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" width="{wide}" height="{high}"'
            f' font-family="{FONT}" font-size="{FONT_PX}">',
            f"<title>{escape(title)}</title>",
            f"<style>{light}@media (prefers-color-scheme: dark) {{{dark}}}</style>",
            f'<rect width="{wide}" height="{high}" class="f-paper"/>',
            *parts,
            "</svg>\n",
        )
    )


def _rules(theme: int) -> str:
    return "".join(
        f".f-{name}{{fill:{colours[theme]}}}.s-{name}{{stroke:{colours[theme]}}}" for name, colours in COLOURS.items()
    )


def text(x: float, y: float, words: str, anchor: str = "start", colour: str = "ink") -> str:
    """Words with an edge in the colour of the paper. The edge is a text of its own, painted first, because not every
    viewer paints letters on top of their edge."""
    where, shown = f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"', escape(words)
    edge = f'{where} class="f-paper s-paper" stroke-width="4" stroke-linejoin="round">{shown}</text>'
    return f'{edge}{where} class="f-{colour}">{shown}</text>'


def line(points: Iterable[Way], colour: str, width: float, *, opacity: float = 1.0, dashes: str = "") -> str:
    """A line. `points` are pixels."""
    at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (
        f'<polyline points="{at}" fill="none" class="s-{colour}" stroke-width="{width:g}"{dashed}'
        f' stroke-opacity="{opacity:g}" stroke-linejoin="round" stroke-linecap="round"/>'
    )


def dot(at: Way, radius: float, fill: str, edge: str, width: float = 1.0) -> str:
    x, y = at
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" class="f-{fill} s-{edge}" stroke-width="{width:g}"/>'


@dataclass(frozen=True, slots=True)
class SkySvg:
    """The sky in pixels. The horizon is the outer circle."""

    x: float
    y: float
    radius: float

    def place(self, way: Way) -> Way:
        out, angle = self.radius * (1 - way[1] / 90.0), math.radians(way[0])
        return self.x + out * math.sin(angle), self.y - out * math.cos(angle)

    def path(self, ways: Iterable[Way], colour: str, width: float, opacity: float = 1.0) -> str:
        return line((self.place(way) for way in ways), colour, width, opacity=opacity)

    def backdrop(self, mount: Mount | None = None) -> Iterator[str]:
        if mount is not None:
            yield from self._obstacles(mount)
        for elevation_deg in (0, 30, 60):
            radius = self.radius * (1 - elevation_deg / 90)
            yield f'<circle cx="{self.x:g}" cy="{self.y:g}" r="{radius:.0f}" fill="none" class="s-grid"/>'
            yield text(self.x + 6, self.y - radius + 20, f"{elevation_deg}°", "start", "faint")
        for azimuth_deg in (0.0, 90.0):
            yield line((self.place((azimuth_deg + turn, 0.0)) for turn in (0.0, 180.0)), "grid", 1.0)
        for azimuth_deg, name, anchor in (
            (0, "N", "middle"),
            (90, "E", "start"),
            (180, "S", "middle"),
            (270, "W", "end"),
        ):
            east, south = math.sin(math.radians(azimuth_deg)), -math.cos(math.radians(azimuth_deg))
            yield text(self.x + east * (self.radius + 12), self.y + south * (self.radius + 16) + 6, name, anchor)

    def _obstacles(self, mount: Mount) -> Iterator[str]:
        if mount.horizon:
            trees = [(at * STEP_DEG, mount.horizon_deg(at * STEP_DEG)) for at in range(round(360 / STEP_DEG))]
            level = [(azimuth_deg, 0.0) for azimuth_deg, _ in trees]
            yield self._area((level, trees), "trees", 0.25)
        for sector in mount.sectors:
            yield self._area((self._around(mount, sector),), "sector", 0.3)
        if mount.azimuth.max_deg - mount.azimuth.min_deg <= 360.0:
            for end_deg in {mount.azimuth.min_deg % 360.0, mount.azimuth.max_deg % 360.0}:
                ends = [self.place(mount.pointed(end_deg, elevation_deg)) for elevation_deg in (0.0, 30.0, 60.0, 89.0)]
                yield line(ends, "sector", 1.5, opacity=0.8, dashes="3 5")

    def _around(self, mount: Mount, sector: Sector) -> list[Way]:
        """The edge of a sector on the sky."""
        west, east = sector.azimuth.min_deg, sector.azimuth.max_deg
        low, high = max(sector.elevation.min_deg, 0.0), min(sector.elevation.max_deg, 180.0)
        across, upright = (
            [start + (end - start) * at / 24 for at in range(25)] for start, end in ((west, east), (low, high))
        )
        edge = [(azimuth_deg, low) for azimuth_deg in across] + [(east, elevation_deg) for elevation_deg in upright]
        edge += [(azimuth_deg, high) for azimuth_deg in reversed(across)]
        edge += [(west, elevation_deg) for elevation_deg in reversed(upright)]
        return [mount.pointed(*axes) for axes in edge]

    def _area(self, edges: Iterable[list[Way]], colour: str, opacity: float) -> str:
        """An area between edges. A part inside two edges stays free."""
        rings = (" L ".join(f"{x:.1f} {y:.1f}" for x, y in map(self.place, edge)) for edge in edges)
        path = " ".join(f"M {ring} Z" for ring in rings)
        return f'<path d="{path}" class="f-{colour} s-{colour}" fill-opacity="{opacity:g}" fill-rule="evenodd"/>'
