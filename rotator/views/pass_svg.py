"""One pass as a drawing (SVG): the sky with target and antenna, the pointing error, and each start of a motor.

Knows traces, and how to draw several flights of one pass together. Knows no rotor and no file.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import Protocol

from rotator.control.sky.mount import Mount
from rotator.views.sky_svg import SkySvg, document, dot, line, text
from rotator.views.trace import SETTLING_S, Sample

WIDTH = 820
SKY = SkySvg(500, 330, 285)
LEFT, RIGHT = 150, 780
"""The ends of the time line, in pixels."""
OFF_TOP, OFF_BOTTOM = 688, 800
"""The strip of the errors."""
ROWS_Y, ROW_PX = 862, 42
MOST_POINTS = 1300
"""Points of a line, at most: without a limit a pass of hours makes a drawing of megabytes."""
MOMENTS = (0.22, 0.38, 0.54, 0.7)
"""Moments marked on the sky: shares of the time for which the target is up."""
SCALES_DEG = (1.0, 2.0, 4.0, 8.0, 16.0, 40.0, 80.0, 180.0)
SHARE_SHOWN = 0.98
"""Share of the errors that the strip must hold. If it held all, a swing right round would hide the others."""
MINUTES = (1, 2, 5, 10, 20, 60, 120, 240)
MOST_MINUTES = 16

DRIVES: dict[str, Callable[[Sample], int]] = {
    "azimuth": lambda sample: sample.az_drive,
    "elevation": lambda sample: sample.el_drive,
}


class Summed(Protocol):
    """A flight as numbers, for the words of the drawing. `relay_starts` None: there are no relays."""

    @property
    def rms_deg(self) -> float: ...

    @property
    def relay_starts(self) -> int | None: ...


@dataclass(frozen=True, slots=True)
class Flown:
    """A flown pass. `name`: who flew it; `colour`: a colour of `sky_svg`."""

    name: str
    colour: str
    trace: Sequence[Sample]
    summary: Summed
    clicks_s: Mapping[str, Sequence[float]] | None = None
    """For each axis, the times at which a relay closed, if the trace is too coarse. None: the trace shows them."""

    def clicks(self, axis: str) -> Sequence[float]:
        return closings(self.trace, DRIVES[axis]) if self.clicks_s is None else self.clicks_s[axis]


def closings(trace: Sequence[Sample], drive: Callable[[Sample], int]) -> list[float]:
    """The times at which one axis, at rest or turning the other way, began to turn."""
    return [after.t for before, after in pairwise(trace) if drive(after) not in (0, drive(before))]


def draw(target: str, flights: Sequence[Flown], mount: Mount | None = None, when: str = "") -> str:
    """The whole drawing. `mount`: draw the horizon and sectors around the antenna; None: do not. `when`: the date."""
    first = flights[0]
    rows = list(_rows(flights))
    high = ROWS_Y + ROW_PX * len(rows) + 34
    times = _Times(first.trace[0].t, first.trace[-1].t)
    parts = [
        *SKY.backdrop(mount),
        *_paths(flights),
        *_legend(target, flights, mount),
        *([text(WIDTH - 26, 28, when, "end", "faint")] if when else []),
        *_moments(flights),
        *_errors(flights, times),
    ]
    for number, row in enumerate(rows):
        parts += row.drawn(ROWS_Y + number * ROW_PX, times)
    parts += times.scale(ROWS_Y + ROW_PX * len(rows) - 18)
    return document(
        WIDTH, high, f"One pass of {target}: where it is, where the antenna points, how far it is off", parts
    )


@dataclass(frozen=True, slots=True)
class _Times:
    begin_s: float
    end_s: float

    def x(self, t_s: float) -> float:
        return LEFT + (t_s - self.begin_s) / (self.end_s - self.begin_s) * (RIGHT - LEFT)

    def scale(self, y: float) -> Iterator[str]:
        long = (self.end_s - self.begin_s) / 60
        step = next((each for each in MINUTES if long / each <= MOST_MINUTES), MINUTES[-1])
        for minute in range(step * math.ceil(self.begin_s / 60 / step), int(self.end_s // 60) + 1, step):
            x = self.x(minute * 60)
            yield line([(x, y), (x, y + 7)], "faint", 1.0)
            yield text(x, y + 28, f"{minute}" if minute else "0 min", "middle")


@dataclass(frozen=True, slots=True)
class _Row:
    """Ticks where a relay closes; bars where a motor without relays turns."""

    name: str
    words: str
    colour: str
    ticks_s: Sequence[float] = ()
    bars_s: Sequence[tuple[float, float]] = ()

    def drawn(self, y: float, times: _Times) -> Iterator[str]:
        yield text(LEFT - 16, y - 3, f"{self.name}:", "end", self.colour)
        yield text(LEFT - 16, y + 17, self.words, "end", self.colour)
        yield line([(LEFT, y), (RIGHT, y)], "grid", 1.0)
        ticks = " ".join(f"M {times.x(t):.1f} {y - 13} v 26" for t in self.ticks_s)
        if ticks:
            yield f'<path d="{ticks}" class="s-{self.colour}" stroke-width="1.6"/>'
        bars = " ".join(f"M {times.x(begin):.1f} {y} H {times.x(end):.1f}" for begin, end in self.bars_s)
        if bars:
            yield f'<path d="{bars}" class="s-{self.colour}" stroke-width="12"/>'


def _rows(flights: Sequence[Flown]) -> Iterator[_Row]:
    """A row for each flight. If there is only one flight: a row for each axis."""
    if len(flights) > 1:
        for each in flights:
            every = sorted(t for axis in DRIVES for t in each.clicks(axis))
            yield _Row(each.name, f"{len(every)} clicks", each.colour, every)
        return
    (only,) = flights
    for name, drive in DRIVES.items():
        if only.summary.relay_starts is not None:
            clicks = only.clicks(name)
            yield _Row(name, f"{len(clicks)} click{'' if len(clicks) == 1 else 's'}", only.colour, clicks)
        else:
            turned_s = sum(after.t - before.t for before, after in pairwise(only.trace) if drive(before))
            yield _Row(name, f"turned {turned_s:.0f} s", only.colour, bars_s=list(_turns(only.trace, drive)))


def _turns(trace: Sequence[Sample], drive: Callable[[Sample], int]) -> Iterator[tuple[float, float]]:
    """Begin and end of each time in which an axis was driven."""
    for driven, run in groupby(trace, lambda sample: drive(sample) != 0):
        moments_s = [sample.t for sample in run]
        if driven:
            yield moments_s[0], moments_s[-1]


def _thinned(trace: Sequence[Sample]) -> Sequence[Sample]:
    return trace[:: max(1, math.ceil(len(trace) / MOST_POINTS))]


def _paths(flights: Sequence[Flown]) -> Iterator[str]:
    first, *others = flights
    for flight in others:
        yield SKY.path(((s.antenna_az, s.antenna_el) for s in _thinned(flight.trace)), flight.colour, 2, 0.85)
    up = [sample for sample in first.trace if sample.target_el >= 0]
    yield SKY.path(((s.target_az, s.target_el) for s in _thinned(up)), "target", 9, 0.75)
    yield SKY.path(((s.antenna_az, s.antenna_el) for s in _thinned(first.trace)), first.colour, 2.5)


def _legend(target: str, flights: Sequence[Flown], mount: Mount | None) -> Iterator[str]:
    lines = [("target", target)]
    lines += [(each.colour, f"{each.name}: {each.summary.rms_deg:.1f}° rms off") for each in flights]
    if mount is not None and mount.horizon:
        lines.append(("trees", "trees and roofs"))
    if mount is not None and mount.sectors:
        lines.append(("sector", "forbidden"))
    for row, (colour, words) in enumerate(lines):
        y = 28 + row * 26
        yield line([(26, y - 6), (58, y - 6)], colour, 6)
        yield text(70, y, words)


def _moments(flights: Sequence[Flown]) -> Iterator[str]:
    """At some moments: the target as a ring, and a line from it to the direction of each antenna."""
    up = [sample.t for sample in flights[0].trace if sample.target_el >= 0]
    if not up:
        return
    for share in MOMENTS:
        moment_s = up[0] + share * (up[-1] - up[0])
        samples = [next(s for s in each.trace if s.t >= moment_s - 1e-6) for each in flights]
        ring = SKY.place((samples[0].target_az, samples[0].target_el))
        for flight, sample in reversed(list(zip(flights, samples, strict=True))):
            at = SKY.place((sample.antenna_az, sample.antenna_el))
            yield line([ring, at], "ink", 1.5)
            yield dot(at, 5.5, flight.colour, "paper")
        yield dot(ring, 7, "paper", "ink", 2)
    yield text(24, 664, "rings: the target at four moments, and where the antenna points then", "start", "faint")


def _errors(flights: Sequence[Flown], times: _Times) -> Iterator[str]:
    seen = [[s for s in each.trace if s.target_el >= 0 and s.t >= SETTLING_S] for each in flights]
    errors = sorted(sample.error_deg for samples in seen for sample in samples)
    shown = errors[int(SHARE_SHOWN * (len(errors) - 1))] if errors else 0.0
    top_deg = next(scale for scale in SCALES_DEG if shown <= scale * 1.1 or scale == SCALES_DEG[-1])
    degree_px = (OFF_BOTTOM - OFF_TOP) / top_deg
    yield text(24, OFF_TOP + 6, "off by")
    if errors and errors[-1] > top_deg * 1.1:
        yield text(RIGHT, OFF_TOP - 8, f"{errors[-1]:.0f}° at worst", "end", "faint")
    for degrees in (0.0, top_deg / 2, top_deg):
        y = OFF_BOTTOM - degrees * degree_px
        yield line([(LEFT, y), (RIGHT, y)], "grid", 1.0)
        yield text(LEFT - 16, y + 6, f"{degrees:g}°", "end", "faint")
    for flight, samples in reversed(list(zip(flights, seen, strict=True))):
        points = [(times.x(s.t), OFF_BOTTOM - min(s.error_deg, top_deg * 1.1) * degree_px) for s in _thinned(samples)]
        yield line(points, flight.colour, 1.8)
