"""The film of the README: the demo pass as the box flies it, an animated drawing. `make picture-demo`.

Flies it in simulated time on the simulated chips, so that it is the same on every machine. The film runs by itself in
any browser, also as an image of a page (SMIL, no script). Where nothing moves, it shows the whole pass.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from itertools import accumulate, pairwise
from math import dist
from pathlib import Path

from rotator.config.load import parse
from rotator.control.sky.timed_table import smooth
from rotator.orbits.demo_pass import FAST, PASSES
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import Pass
from rotator.store.whole import write_whole
from rotator.views.sky_svg import SkySvg, document, line, text
from rotator.views.trace import Sample

FILE = Path(__file__).parent / "img" / "demo.svg"
FLOWN = PASSES["Europe"]
SHOWN = 3
"""So many times as fast as the demo pass itself is the film."""
STEP_S = 0.5
BEFORE_S, AFTER_S = 3.0, 6.0
"""Seconds before the rise; and for which the end stays."""
WIDE, HIGH = 820, 470
SKY = SkySvg(230, 236, 178)
LEFT, RIGHT, TOP, BOTTOM = 510, 790, 300, 400
"""The strip of the errors, in pixels."""
MOST_DEG = 8.0
LAMPS = ((462, "CCW", "az", -1), (546, "CW", "az", 1), (624, "DOWN", "el", -1), (728, "UP", "el", 1))
"""Each relay: where its lamp is, in pixels; its name, axis and direction."""


class Film:
    """`trace`: the samples that are shown, a step apart."""

    def __init__(self, trace: Sequence[Sample]) -> None:
        self._trace = trace
        self._begin_s = trace[0].t
        self._lasts_s = trace[-1].t - self._begin_s + AFTER_S
        self._when = ";".join([*(f"{self._share(each.t):.4f}" for each in trace), "1"])

    def _share(self, t_s: float) -> float:
        return (t_s - self._begin_s) / self._lasts_s

    def moving(self, name: str, values: Sequence[float]) -> str:
        """An attribute that changes from step to step, and stays at the end."""
        shown = ";".join(f"{value:.1f}" for value in (*values, values[-1]))
        return self._animate(name, shown, self._when, "linear")

    def _animate(self, name: str, values: str, when: str, how: str) -> str:
        return (
            f'<animate attributeName="{name}" values="{values}" keyTimes="{when}" calcMode="{how}" '
            f'dur="{self._lasts_s / SHOWN:.2f}s" repeatCount="indefinite"/>'
        )

    def switched(self, seen: Sequence[bool]) -> str:
        """Shown while that is so."""
        changes = [(0.0, seen[0])]
        changes += [
            (self._share(after.t), now)
            for (_, after), (before, now) in zip(pairwise(self._trace), pairwise(seen), strict=True)
            if now is not before
        ]
        when, values = ";".join(f"{at:.4f}" for at, _ in changes), ";".join(str(int(now)) for _, now in changes)
        return self._animate("opacity", values, when, "discrete")

    def parts(self) -> Iterator[str]:
        yield from SKY.backdrop()
        up = [SKY.place((each.target_az, each.target_el)) for each in self._trace if each.target_el >= 0]
        yield line(up, "target", 7, opacity=0.45)
        antenna = [SKY.place((each.antenna_az, each.antenna_el)) for each in self._trace]
        yield from self._trail(antenna)
        targets = [SKY.place((each.target_az, max(0.0, each.target_el))) for each in self._trace]
        yield self._dot(targets, 9, "f-paper s-target", 4)
        yield self._dot(antenna, 6, "f-blue s-paper", 1.5)
        yield from self._words()
        yield from self._lamps()
        yield from self._errors()

    def _dot(self, at: Sequence[tuple[float, float]], radius: float, colours: str, edge: float) -> str:
        east, south = zip(*at, strict=True)
        still = f'cx="{east[-1]:.1f}" cy="{south[-1]:.1f}"'
        return (
            f'<circle {still} r="{radius:g}" class="{colours}" stroke-width="{edge:g}">'
            f"{self.moving('cx', east)}{self.moving('cy', south)}</circle>"
        )

    def _trail(self, at: Sequence[tuple[float, float]]) -> Iterator[str]:
        """It grows as the antenna turns: a dash as long as the way, which moves into sight."""
        gone = list(accumulate((dist(one, other) for one, other in pairwise(at)), initial=0.0))
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
        yield (
            f'<polyline points="{points}" fill="none" class="s-blue" stroke-width="2.5" stroke-linejoin="round" '
            f'stroke-dasharray="{gone[-1] + 1:.0f}">'
            f"{self.moving('stroke-dashoffset', [gone[-1] + 1 - each for each in gone])}</polyline>"
        )

    def _words(self) -> Iterator[str]:
        yield text(LEFT - 60, 36, f"A demo pass: the ISS over {FLOWN.over}")
        yield text(LEFT - 60, 62, f"simulated rotor, {FAST * SHOWN} times as fast as life", "start", "faint")
        for x, name in ((LEFT - 60, "azimuth"), (LEFT + 130, "elevation")):
            yield text(x, 112, name, "start", "faint")
        yield from self._figures(LEFT - 60, [each.antenna_az for each in self._trace])
        yield from self._figures(LEFT + 130, [each.antenna_el for each in self._trace])
        for x, colour, name in ((26, "target", "the satellite"), (190, "blue", "the antenna")):
            yield line([(x, HIGH - 24), (x + 26, HIGH - 24)], colour, 6)
            yield text(x + 36, HIGH - 18, name, "start", "faint")

    def _figures(self, x: float, angles_deg: Sequence[float]) -> Iterator[str]:
        """Each figure as long as it is true; the last one is also seen where nothing moves."""
        shown = [f"{max(0.0, angle_deg):.0f}°" for angle_deg in angles_deg]
        for figure in dict.fromkeys(shown):
            seen = [each == figure for each in shown]
            still = "" if seen[-1] else ' opacity="0"'
            yield f'<text x="{x}" y="160" font-size="46" class="f-ink"{still}>{figure}{self.switched(seen)}</text>'

    def _lamps(self) -> Iterator[str]:
        for x, name, axis, turn in LAMPS:
            lit = [(each.az_drive if axis == "az" else each.el_drive) == turn for each in self._trace]
            yield f'<circle cx="{x}" cy="212" r="10" class="f-paper s-faint" stroke-width="2"/>'
            yield f'<circle cx="{x}" cy="212" r="10" class="f-trees" opacity="0">{self.switched(lit)}</circle>'
            yield text(x + 16, 218, name, "start", "faint")

    def _errors(self) -> Iterator[str]:
        yield text(LEFT - 60, TOP - 20, "off by")
        for degrees in (0.0, MOST_DEG / 2, MOST_DEG):
            y = BOTTOM - degrees / MOST_DEG * (BOTTOM - TOP)
            yield line([(LEFT, y), (RIGHT, y)], "grid", 1.0)
            yield text(LEFT - 12, y + 6, f"{degrees:g}°", "end", "faint")
        end_s = self._trace[-1].t
        xs = [LEFT + max(0.0, each.t) / end_s * (RIGHT - LEFT) for each in self._trace]
        yield f'<clipPath id="flown"><rect x="{LEFT}" y="{TOP - 20}" width="{RIGHT - LEFT}" height="160">'
        yield f"{self.moving('width', [x - LEFT for x in xs])}</rect></clipPath>"
        seen = [(x, each) for x, each in zip(xs, self._trace, strict=True) if each.t >= 0 and each.target_el >= 0]
        points = [(x, BOTTOM - min(each.error_deg, MOST_DEG) / MOST_DEG * (BOTTOM - TOP)) for x, each in seen]
        yield f'<g clip-path="url(#flown)">{line(points, "blue", 1.8)}</g>'
        yield text(LEFT, BOTTOM + 30, "rise", "start", "faint")
        yield text(RIGHT, BOTTOM + 30, f"set, {FLOWN.lasts_s / FAST:.0f} s later", "end", "faint")


def film() -> str:
    flown = Pass(FLOWN.named(FAST), smooth(FLOWN.rows(FAST)))
    trace, _ = fly(flown, plant_maker(parse("", "film"), via="track"))
    shown: list[Sample] = []
    for sample in trace:
        if sample.t >= -BEFORE_S and (not shown or sample.t >= shown[-1].t + STEP_S - 0.01):
            shown.append(sample)
    title = f"The demo pass: the ISS over {FLOWN.over}, and the antenna that follows it on a simulated rotor"
    return document(WIDE, HIGH, title, Film(shown).parts())


if __name__ == "__main__":
    write_whole(Path(sys.argv[1]) if len(sys.argv) > 1 else FILE, film())
