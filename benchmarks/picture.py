"""Draws starts against error, both logarithmic, as an SVG: `python -m benchmarks.picture FILE` from the kept figures.

Knows how to draw. `benchmarks.passes` flies, and keeps the figures in passes.json beside it.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

Point = tuple[float, float]
"""Relay starts a pass, and the error in degrees."""

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 860, 540, 66, 24, 44, 66
STARTS = (15, 1000)
ERRORS_DEG = (0.3, 8.0)
FONT_PX = 17
RED, BLUE, GREEN, GREY = "#b22", "#05b", "#363", "#666"
FIGURES = Path(__file__).with_name("passes.json")
OPTIMUM = Path(__file__).parents[1] / "tests" / "passes" / "optimum.json"

PEERS: dict[str, Point] = {"K3NG, its defaults": (893, 2.12), "K3NG at 4°": (167, 4.39)}
"""The best-known Arduino controller: compiled, run on an emulated ATmega2560, with the same motor."""
BESIDE = {
    "emulated sketch, nine passes": ("end", -18.0),
    "K3NG, its defaults": ("end", 32.0),
    "K3NG at 4°": ("start", 18.0),
}
USUAL = "start", -2.0
"""Where a label stands beside its dot: its anchor, and how much lower it is. As the figures are, none meets another."""
PLOT_RIGHT, PLOT_BOTTOM = WIDTH - RIGHT, HEIGHT - BOTTOM


def draw(series: dict[str, Point], optima: Iterable[Sequence[Point]]) -> str:
    """`series`: name to its point; `optima`: curves of the least error for so many starts."""
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"'
        f' font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="{FONT_PX}">',
        "<title>Relay starts a pass against pointing error</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<clipPath id="plot"><rect x="{LEFT}" y="{TOP}" width="{PLOT_RIGHT - LEFT}" height="{PLOT_BOTTOM - TOP}"/>'
        "</clipPath>",
    ]
    for starts in (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0):
        x = _x(starts)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{PLOT_BOTTOM}" stroke="#ddd"/>')
        parts.append(text(x, PLOT_BOTTOM + 24, f"{starts:g}", "middle"))
    for error_deg in (0.5, 1.0, 2.0, 4.0, 8.0):
        y = _y(error_deg)
        parts.append(f'<line x1="{LEFT}" x2="{PLOT_RIGHT}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(text(LEFT - 8, y + 6, f"{error_deg:g}°", "end"))
    for curve in optima:
        points = " ".join(f"{_x(starts):.1f},{_y(error):.1f}" for starts, error in curve)
        parts.append(f'<polyline points="{points}" fill="none" stroke="#9c9" clip-path="url(#plot)"/>')
    for row, line in enumerate(("green lines: the least possible", "on each pass, knowing the future")):
        parts.append(text(LEFT + 14, PLOT_BOTTOM - 40 + 24 * row, line, "start", GREEN))
    colours = {name: RED if "sketch" in name else BLUE for name in series} | dict.fromkeys(PEERS, GREY)
    points_of = {**series, **PEERS}
    for name, (starts, error) in points_of.items():
        parts.append(f'<circle cx="{_x(starts):.1f}" cy="{_y(error):.1f}" r="7" fill="{colours[name]}"/>')
    for name, (starts, error) in points_of.items():
        anchor, lower = BESIDE.get(name, USUAL)
        x = _x(starts) + (12 if anchor == "start" else -12)
        words = f"{name}: {starts:.0f} starts, {error:.1f}°"
        parts.append(text(x, _y(error) + lower, words, anchor, colours[name]))
    parts.append(text((LEFT + PLOT_RIGHT) / 2, HEIGHT - 14, "relay starts a pass (mean of twelve)", "middle"))
    parts.append(text(12, 24, "pointing error, rms", "start"))
    return "\n".join((*parts, "</svg>")) + "\n"


def text(x: float, y: float, words: str, anchor: str, colour: str = "#333") -> str:
    """With a white edge, painted first and by itself: not every viewer keeps the letters on top of their own edge."""
    where = f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
    edge = f'{where} fill="white" stroke="white" stroke-width="4" stroke-linejoin="round">{words}</text>'
    return f'{edge}{where} fill="{colour}">{words}</text>'


def _x(starts: float) -> float:
    share = math.log(starts / STARTS[0]) / math.log(STARTS[1] / STARTS[0])
    return LEFT + share * (PLOT_RIGHT - LEFT)


def _y(error_deg: float) -> float:
    share = math.log(error_deg / ERRORS_DEG[0]) / math.log(ERRORS_DEG[1] / ERRORS_DEG[0])
    return PLOT_BOTTOM - share * (PLOT_BOTTOM - TOP)


def kept() -> str:
    """The picture from the figures of the last flights."""
    series = {name: (starts, error) for name, (starts, error) in json.loads(FIGURES.read_text("utf-8")).items()}
    optima = json.loads(OPTIMUM.read_text("utf-8"))
    return draw(series, [sorted((starts, error) for starts, error in curve) for curve in optima.values()])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.parse_args().file.write_text(kept(), encoding="utf-8")
