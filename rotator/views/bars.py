"""An axis as a bar: from its low limit to its angle, in eighths of a cell, with the scale below.

Marks the overlap, where the antenna points as it did a turn before, and the forbidden sectors. Knows angles, cells and
colours. Does not know whether the bar is the antenna or its target.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from operator import itemgetter

from rich.text import Text

PARTS = "▏▎▍▌▋▊▉█"
"""A cell filled from the left by one eighth, two eighths and so on."""
OVERLAP, FORBIDDEN = "░", "▒"
_STEPS_DEG = (5, 10, 15, 30, 45, 90, 180, 360)
_LABEL_CELLS = 8
"""Least number of cells from one label of the scale to the next."""


@dataclass(frozen=True, slots=True)
class Zone:
    """A marked part of the range. `mark`: the character where the bar is empty; `filled`: colour of the bar there."""

    name: str
    from_deg: float
    to_deg: float
    mark: str
    style: str
    filled: str

    def holds(self, angle_deg: float) -> bool:
        return self.from_deg <= angle_deg <= self.to_deg


def overlap(low_deg: float, high_deg: float) -> list[Zone]:
    """The zones beyond a whole turn, where the antenna points in the same directions again."""
    return [Zone("overlap", low_deg + 360.0, high_deg, OVERLAP, "dim", "yellow")] if high_deg > low_deg + 360.0 else []


def forbidden(name: str, from_deg: float, to_deg: float) -> Zone:
    return Zone(name, from_deg, to_deg, FORBIDDEN, "red", "bold red")


@dataclass(frozen=True, slots=True)
class Bar:
    """The range of an axis, drawn on a number of cells."""

    low_deg: float
    high_deg: float
    cells: int
    zones: Sequence[Zone] = ()
    """If two zones are at one place, the first is shown."""

    def filled_to(self, angle_deg: float | None, style: str, *, names: bool = False) -> Text:
        """Beyond the high end the bar is full; beyond the low end nearly empty, as an empty bar means an unknown angle.

        `names`: show the name of each zone where the bar is empty and has room for it.
        """
        eighths = 0
        if angle_deg is not None:
            share = (angle_deg - self.low_deg) / (self.high_deg - self.low_deg)
            eighths = min(max(round(share * self.cells * 8), 1), self.cells * 8)
        text = Text()
        for style_here, cells in groupby(map(partial(self._cell, eighths, style), range(self.cells)), itemgetter(1)):
            text.append("".join(mark for mark, _ in cells), style=style_here)
        return self._named(text) if names else text

    def _cell(self, eighths: int, style: str, cell: int) -> tuple[str, str]:
        zone = self._zone(cell)
        part = min(eighths - 8 * cell, 8)
        if part > 0:
            return PARTS[part - 1], zone.filled if zone else style
        return (zone.mark, zone.style) if zone else (" ", "")

    def _named(self, text: Text) -> Text:
        for zone in self.zones:
            run = zone.mark * (len(zone.name) + 2)
            at = text.plain.find(run)
            if at >= 0 and zone.holds(self.low_deg + (at + 1) * self._cell_deg):
                text.plain = text.plain[: at + 1] + zone.name + text.plain[at + 1 + len(zone.name) :]
        return text

    def scale(self) -> Text:
        """The limits at both ends, and round angles between them if there is room."""
        places = {0: f"{self.low_deg:g}"}
        last = f"{self.high_deg:g}"
        places[self.cells - len(last)] = last
        for angle_deg in self._labelled():
            label = f"{angle_deg:g}"
            at = int((angle_deg - self.low_deg) / self._cell_deg) - len(label) // 2
            if _free(places, at, label):
                places[at] = label
        row = ""
        for at, label in sorted(places.items()):
            row = row.ljust(at) + label
        return Text(row[: self.cells].ljust(self.cells), style="dim")

    def _labelled(self) -> Iterable[float]:
        span_deg = self.high_deg - self.low_deg
        most = max(self.cells // _LABEL_CELLS, 1)
        step_deg = next((step for step in _STEPS_DEG if span_deg / step <= most), _STEPS_DEG[-1])
        first = int(self.low_deg // step_deg) + 1
        while first * step_deg < self.high_deg:
            yield float(first * step_deg)
            first += 1

    @property
    def _cell_deg(self) -> float:
        return (self.high_deg - self.low_deg) / self.cells

    def _zone(self, cell: int) -> Zone | None:
        from_deg = self.low_deg + cell * self._cell_deg
        # A sector narrower than a cell is marked too.
        return next((z for z in self.zones if z.from_deg < from_deg + self._cell_deg and z.to_deg > from_deg), None)


def _free(places: dict[int, str], at: int, label: str) -> bool:
    """Whether the label has a space on both sides."""
    return all(at >= there + len(text) + 1 or at + len(label) + 1 <= there for there, text in places.items())
