"""Draws starts against error, both logarithmic, as an SVG. Knows how to draw, not what it means."""

from __future__ import annotations

import math

WIDTH, HEIGHT, LEFT, BOTTOM = 720, 440, 60, 50
STARTS = (15, 1000)
ERRORS_DEG = (0.3, 8.0)
COLOURS = ("#b33", "#06c", "#06c", "#06c")

PEERS = {"K3NG, its defaults": (893, 2.12), "K3NG at 4°": (167, 4.39)}
"""Starts a pass and error of the best-known Arduino controller: compiled, run on an emulated ATmega2560, same motor."""


def draw(series: dict[str, tuple[float, float]], optima: list[list[tuple[float, float]]]) -> str:
    """`series`: name to (starts, error); `optima`: curves of the same, the least error for so many starts."""
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
    ]
    for starts in (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0):
        x = _x(starts)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="20" y2="{HEIGHT - BOTTOM}" stroke="#ddd"/>')
        parts.append(_text(x, HEIGHT - BOTTOM + 16, f"{starts:g}", "middle"))
    for error_deg in (0.5, 1.0, 2.0, 4.0, 8.0):
        y = _y(error_deg)
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - 20}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        parts.append(_text(LEFT - 8, y + 4, f"{error_deg:g}°", "end"))
    for curve in optima:
        points = " ".join(f"{_x(starts):.1f},{_y(error):.1f}" for starts, error in curve)
        parts.append(f'<polyline points="{points}" fill="none" stroke="#9c9" stroke-width="1"/>')
    parts.append(_text(_x(190), _y(0.34), "the least possible, knowing the future (each pass)", "middle", "#474"))
    for (name, (starts, error)), colour in zip(series.items(), COLOURS, strict=False):
        parts.append(_dot(starts, error, name, colour))
    parts += [_dot(starts, error, name, "#777") for name, (starts, error) in PEERS.items()]
    parts.append(_text((LEFT + WIDTH) / 2, HEIGHT - 12, "relay starts a pass (mean of twelve)", "middle"))
    parts.append(_text(LEFT, 14, "pointing error, rms", "middle"))
    return "\n".join((*parts, "</svg>")) + "\n"


def _dot(starts: float, error_deg: float, name: str, colour: str) -> str:
    x, y = _x(starts), _y(error_deg)
    side = "end" if x > WIDTH * 0.75 else "start"
    offset = -9 if side == "end" else 9
    dot = f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{colour}"/>'
    return dot + _text(x + offset, y - 6, f"{name}: {starts:.0f} starts, {error_deg:.2f}°", side, colour)


def _text(x: float, y: float, text: str, anchor: str, colour: str = "#333") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="12" text-anchor="{anchor}" fill="{colour}">{text}</text>'


def _x(starts: float) -> float:
    share = math.log(starts / STARTS[0]) / math.log(STARTS[1] / STARTS[0])
    return LEFT + share * (WIDTH - LEFT - 20)


def _y(error_deg: float) -> float:
    share = math.log(error_deg / ERRORS_DEG[0]) / math.log(ERRORS_DEG[1] / ERRORS_DEG[0])
    return HEIGHT - BOTTOM - share * (HEIGHT - BOTTOM - 20)
