"""Draws one real pass as the box and the emulated sketch fly it: `python -m benchmarks.one_pass docs/img/one-pass.svg`.

Above, the sky as a polar plot: the satellite, the antenna under the box, the antenna under the sketch, and where all
three are at four moments. Below, how far each antenna is off, and a tick for each time that a relay closes. Flies both
in simulated time: the same picture on every machine.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path

from benchmarks.picture import BLUE, RED, text
from rotator.config.load import parse
from rotator.rehearsal.flight import SETTLING_S, Sample, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, read_pass

PASS_NAME = "mid-1-iss"
WIDTH, HEIGHT = 820, 980
CENTRE, RADIUS = (500, 330), 285
"""The horizon is the outer circle, the zenith its middle."""
LEFT, RIGHT = 150, 780
"""The ends of the time line."""
GREY, YELLOW = "#888", "#e0b000"
MOMENTS_S = (150.0, 240.0, 330.0, 420.0)
ZERO_Y, DEGREE_PX = 800, 14
"""The strip of the errors."""
EVERY = 10
"""Of the samples, twenty a second, so many make one point of a line."""

Flown = tuple[list[Sample], int, float]
"""The trace, the relay starts, and the error in degrees, rms."""


def flown() -> tuple[Flown, Flown]:
    """By the box with its defaults, then by the emulated sketch."""
    config = parse("", "benchmark")
    made = []
    for arduino in (False, True):
        trace, summary = fly(read_pass(SHIPPED / f"{PASS_NAME}.csv"), plant_maker(config, arduino=arduino))
        made.append((trace, summary.relay_starts or 0, summary.rms_deg))
    return made[0], made[1]


def closings(trace: Sequence[Sample]) -> list[float]:
    """When a relay closed: an axis that stood, or that turned the other way, begins to turn."""
    found = [
        after.t
        for before, after in pairwise(trace)
        for was, drive in ((before.az_drive, after.az_drive), (before.el_drive, after.el_drive))
        if drive not in (0, was)
    ]
    return sorted(found)


def draw(box: Flown, sketch: Flown) -> str:
    end_s = box[0][-1].t
    up = [sample for sample in box[0] if sample.target_el > 0]
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}"'
        ' font-family="DejaVu Sans, Verdana, Arial, sans-serif" font-size="17">',
        "<title>One pass of the ISS: the satellite, the box, the sketch that it replaces</title>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        *_sky(),
        _path(((s.antenna_az, s.antenna_el) for s in sketch[0][::EVERY]), RED, 2, 0.85),
        _path(((s.target_az, s.target_el) for s in up[::EVERY]), YELLOW, 9, 0.75),
        _path(((s.antenna_az, s.antenna_el) for s in box[0][::EVERY]), BLUE, 2.5, 1),
        *_legend(box, sketch),
        *_moments(box[0], sketch[0]),
        *_errors(box[0], sketch[0], end_s),
    ]
    for y, name, colour, flight in ((862, "box", BLUE, box), (904, "sketch", RED, sketch)):
        parts.append(text(LEFT - 16, y - 3, f"{name}:", "end", colour))
        parts.append(text(LEFT - 16, y + 17, f"{flight[1]} clicks", "end", colour))
        parts.append(f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y}" y2="{y}" stroke="#ddd"/>')
        ticks = " ".join(f"M {_x(t, end_s):.1f} {y - 13} v 26" for t in closings(flight[0]))
        parts.append(f'<path d="{ticks}" stroke="{colour}" stroke-width="1.6"/>')
    for minute in range(int(end_s // 60) + 1):
        x = _x(minute * 60, end_s)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="928" y2="935" stroke="{GREY}"/>')
        parts.append(text(x, 956, f"{minute}" if minute else "0 min", "middle", "#333"))
    return "\n".join((*parts, "</svg>")) + "\n"


def _sky() -> Iterable[str]:
    x, y = CENTRE
    for elevation_deg in (0, 30, 60):
        radius = RADIUS * (1 - elevation_deg / 90)
        yield f'<circle cx="{x}" cy="{y}" r="{radius:.0f}" fill="none" stroke="#bbb"/>'
        yield text(x + 6, y - radius + 20, f"{elevation_deg}°", "start", GREY)
    yield f'<path d="M {x - RADIUS} {y} H {x + RADIUS} M {x} {y - RADIUS} V {y + RADIUS}" stroke="#ddd"/>'
    for azimuth_deg, name, anchor in ((0, "N", "middle"), (90, "E", "start"), (180, "S", "middle"), (270, "W", "end")):
        dx, dy = math.sin(math.radians(azimuth_deg)), -math.cos(math.radians(azimuth_deg))
        yield text(x + dx * (RADIUS + 12), y + dy * (RADIUS + 16) + 6, name, anchor, "#333")


def _legend(box: Flown, sketch: Flown) -> Iterable[str]:
    lines = (
        (YELLOW, "the satellite (ISS)"),
        (BLUE, f"the box: {box[2]:.1f}° rms off"),
        (RED, f"the sketch: {sketch[2]:.1f}° rms off"),
    )
    for row, (colour, words) in enumerate(lines):
        y = 28 + row * 26
        yield f'<line x1="24" x2="60" y1="{y - 6}" y2="{y - 6}" stroke="{colour}" stroke-width="6"/>'
        yield text(70, y, words, "start", "#333")


def _moments(box: list[Sample], sketch: list[Sample]) -> Iterable[str]:
    """At some moments: the satellite as a ring, and a line from it to where each antenna points then."""
    for moment_s in MOMENTS_S:
        by_box, by_sketch = (next(s for s in trace if s.t >= moment_s) for trace in (box, sketch))
        x, y = _place(by_box.target_az, by_box.target_el)
        for sample, colour in ((by_sketch, RED), (by_box, BLUE)):
            at_x, at_y = _place(sample.antenna_az, sample.antenna_el)
            yield f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{at_x:.1f}" y2="{at_y:.1f}" stroke="#222" stroke-width="1.5"/>'
            yield f'<circle cx="{at_x:.1f}" cy="{at_y:.1f}" r="5.5" fill="{colour}" stroke="white"/>'
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="7" fill="white" stroke="#222" stroke-width="2"/>'
    yield text(
        24, 664, "rings: where the satellite is at four moments, and where each antenna points then", "start", GREY
    )


def _errors(box: list[Sample], sketch: list[Sample], end_s: float) -> Iterable[str]:
    yield text(24, 700, "off by", "start", "#333")
    for degrees in (0, 4, 8):
        y = ZERO_Y - degrees * DEGREE_PX
        yield f'<line x1="{LEFT}" x2="{RIGHT}" y1="{y}" y2="{y}" stroke="#ddd"/>'
        yield text(LEFT - 16, y + 6, f"{degrees}°", "end", GREY)
    for trace, colour in ((sketch, RED), (box, BLUE)):
        seen = [s for s in trace[::EVERY] if s.target_el > 0 and s.t >= SETTLING_S]
        points = " ".join(f"{_x(s.t, end_s):.1f},{ZERO_Y - min(s.error_deg, 9.0) * DEGREE_PX:.1f}" for s in seen)
        yield f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.8"/>'


def _path(directions: Iterable[tuple[float, float]], colour: str, width: float, opacity: float) -> str:
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (_place(az, el) for az, el in directions))
    return (
        f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="{width:g}"'
        f' stroke-opacity="{opacity:g}" stroke-linejoin="round" stroke-linecap="round"/>'
    )


def _place(azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
    radius = RADIUS * (1 - elevation_deg / 90)
    angle = math.radians(azimuth_deg)
    return CENTRE[0] + radius * math.sin(angle), CENTRE[1] - radius * math.cos(angle)


def _x(t_s: float, end_s: float) -> float:
    return LEFT + t_s / end_s * (RIGHT - LEFT)


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(draw(*flown()), encoding="utf-8")
