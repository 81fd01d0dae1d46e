"""Draws starts against error, both logarithmic, as an SVG: `python -m benchmarks.picture FILE` from the kept figures.

Knows how to draw and where a label has room. `benchmarks.passes` flies, and keeps the figures in passes.json beside it.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

Point = tuple[float, float]
"""Relay starts a pass, and the error in degrees."""

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 860, 540, 66, 24, 44, 66
STARTS = (15, 1000)
ERRORS_DEG = (0.3, 8.0)
FONT_PX = 17
CHARACTER_PX = 9.6
"""The widest that a character is on average in the usual fonts of this size."""
RED, BLUE, GREEN, GREY = "#b22", "#05b", "#363", "#666"
FIGURES = Path(__file__).with_name("passes.json")
OPTIMUM = Path(__file__).parents[1] / "tests" / "passes" / "optimum.json"

PEERS: dict[str, Point] = {"K3NG, its defaults": (893, 2.12), "K3NG at 4°": (167, 4.39)}
"""The best-known Arduino controller: compiled, run on an emulated ATmega2560, with the same motor."""


@dataclass(frozen=True, slots=True)
class Box:
    """In pixels."""

    left: float
    top: float
    right: float
    bottom: float

    def hits(self, other: Box) -> bool:
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def inside(self, other: Box) -> bool:
        return (
            other.left <= self.left
            and self.right <= other.right
            and other.top <= self.top
            and self.bottom <= other.bottom
        )


PLOT = Box(LEFT, TOP, WIDTH - RIGHT, HEIGHT - BOTTOM)


@dataclass(frozen=True, slots=True)
class Label:
    text: str
    colour: str
    box: Box
    anchor: str
    """The end of the text that stands beside its dot."""


def draw(series: dict[str, Point], optima: Iterable[Sequence[Point]]) -> str:
    """`series`: name to its point; `optima`: curves of the least error for so many starts."""
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"'
        f' font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="{FONT_PX}">',
        "<title>Relay starts a pass against pointing error</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<clipPath id="plot"><rect x="{LEFT}" y="{TOP}" width="{PLOT.right - LEFT}" height="{PLOT.bottom - TOP}"/>'
        "</clipPath>",
    ]
    for starts in (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0):
        x = _x(starts)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{PLOT.bottom}" stroke="#ddd"/>')
        parts.append(text(x, PLOT.bottom + 24, f"{starts:g}", "middle"))
    for error_deg in (0.5, 1.0, 2.0, 4.0, 8.0):
        y = _y(error_deg)
        parts.append(f'<line x1="{LEFT}" x2="{PLOT.right}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(text(LEFT - 8, y + 6, f"{error_deg:g}°", "end"))
    for curve in optima:
        points = " ".join(f"{_x(starts):.1f},{_y(error):.1f}" for starts, error in curve)
        parts.append(f'<polyline points="{points}" fill="none" stroke="#9c9" clip-path="url(#plot)"/>')
    for row, line in enumerate(("green lines: the least possible", "on each pass, knowing the future")):
        parts.append(text(LEFT + 14, PLOT.bottom - 40 + 24 * row, line, "start", GREEN))
    colours = {name: RED if "sketch" in name else BLUE for name in series} | dict.fromkeys(PEERS, GREY)
    points_of = {**series, **PEERS}
    for name, (starts, error) in points_of.items():
        parts.append(f'<circle cx="{_x(starts):.1f}" cy="{_y(error):.1f}" r="7" fill="{colours[name]}"/>')
    for label in labels(points_of, colours):
        x = label.box.left if label.anchor == "start" else label.box.right
        parts.append(text(x, label.box.bottom - 6, label.text, label.anchor, label.colour))
    parts.append(text((LEFT + PLOT.right) / 2, HEIGHT - 14, "relay starts a pass (mean of twelve)", "middle"))
    parts.append(text(12, 24, "pointing error, rms", "start"))
    return "\n".join((*parts, "</svg>")) + "\n"


def labels(points: dict[str, Point], colours: dict[str, str]) -> list[Label]:
    """Each beside its dot, inside the plot, and clear of every dot and every other label. Raises ValueError."""
    dots = [Box(_x(s) - 8, _y(e) - 8, _x(s) + 8, _y(e) + 8) for s, e in points.values()]
    placed: list[Label] = []
    for name, (starts, error_deg) in points.items():
        words = f"{name}: {starts:.0f} starts, {error_deg:.1f}°"
        taken = [*dots, *(label.box for label in placed)]
        free = (box for box in _beside(starts, error_deg, words) if box.inside(PLOT) and not any(map(box.hits, taken)))
        box = next(free, None)
        if box is None:
            raise ValueError(f"no room for the label: {words}")
        placed.append(Label(words, colours[name], box, "start" if box.left > _x(starts) else "end"))
    return placed


def _beside(starts: float, error_deg: float, text: str) -> Iterable[Box]:
    """Where a label may stand: right of its dot, then left; higher first, then level, then lower."""
    x, y, long = _x(starts), _y(error_deg), len(text) * CHARACTER_PX
    for left, middle in product((x + 12, x - 12 - long), (y - 8, y, y + 12, y - 24, y + 26)):
        yield Box(left, middle - 12, left + long, middle + 12)


def text(x: float, y: float, words: str, anchor: str, colour: str = "#333") -> str:
    """With a white edge, painted first and by itself: not every viewer keeps the letters on top of their own edge."""
    where = f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
    edge = f'{where} fill="white" stroke="white" stroke-width="4" stroke-linejoin="round">{words}</text>'
    return f'{edge}{where} fill="{colour}">{words}</text>'


def _x(starts: float) -> float:
    share = math.log(starts / STARTS[0]) / math.log(STARTS[1] / STARTS[0])
    return LEFT + share * (PLOT.right - LEFT)


def _y(error_deg: float) -> float:
    share = math.log(error_deg / ERRORS_DEG[0]) / math.log(ERRORS_DEG[1] / ERRORS_DEG[0])
    return PLOT.bottom - share * (PLOT.bottom - TOP)


def kept() -> str:
    """The picture from the figures of the last flights."""
    series = {name: (starts, error) for name, (starts, error) in json.loads(FIGURES.read_text("utf-8")).items()}
    optima = json.loads(OPTIMUM.read_text("utf-8"))
    return draw(series, [sorted((starts, error) for starts, error in curve) for curve in optima.values()])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.parse_args().file.write_text(kept(), encoding="utf-8")
