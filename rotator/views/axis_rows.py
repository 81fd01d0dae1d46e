"""Both axes on a screen: the angle of each, its target, its error, its motor's direction, and a bar with its scale.

A bar runs from the low limit to the angle, in eighths of a cell. The overlap, where the antenna points as it did a turn
before, and the forbidden sectors are marked on it. Knows wide and narrow screens. Does not know what else is shown.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from operator import itemgetter

from rich.text import Text

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Mount
from rotator.exchange.status import AxisStatus, Status
from rotator.views.frame import Row
from rotator.views.sky_plot import ANTENNA_STYLE, TARGET_STYLE
from rotator.views.words import ALARMS, TURNS, by_itself, degrees, stands

WIDE = 60
"""Cells: at this width or more, the numbers stand beside the bars."""
_NUMBERS, _LAMPS = 18, 12
"""Cells for the numbers at the left of a bar, and for both lamps at its right."""


@dataclass(frozen=True, slots=True)
class Ranks:
    """Ranks of the rows of an axis: first the numbers, then the rows that a low terminal leaves out."""

    numbers: int
    bars: int
    scales: int


def axis_rows(status: Status, mount: Mount | None, width: int, ranks: Ranks) -> Iterator[Row]:
    for axis in status.fitted:
        each = status.axis(axis)
        if width >= WIDE:
            yield from _wide(axis, each, _bar(status, axis, mount, width - _NUMBERS - _LAMPS - 2), ranks)
        else:
            yield from _narrow(axis, each, _bar(status, axis, mount, width - 2), ranks, width)


def lamps(drives: Mapping[Axis, Direction], axis: Axis) -> list[Text]:
    """The lamps of an axis's relays: first clockwise or up, then the other one."""
    texts = []
    for direction in (Direction.PLUS, Direction.MINUS):
        on = drives[axis] is direction
        texts.append(Text(f"{'●' if on else '○'} {TURNS[axis, direction]}", style="bold green" if on else "dim"))
    return texts


def _wide(axis: Axis, each: AxisStatus, bar: Bar, ranks: Ranks) -> Iterator[Row]:
    one, other = lamps({axis: each.drive}, axis)
    # An angle that is not measured now must never look as if it were.
    worth_rank = ranks.bars if each.seen else ranks.numbers
    rows = (
        (axis.value, stands(each), _filled(bar, each), Text.assemble(one, " ", other), ranks.numbers),
        (
            "target",
            degrees(each.ordered_deg),
            bar.filled_to(each.ordered_deg, TARGET_STYLE, names=True),
            _worth(each),
            worth_rank,
        ),
    )
    for name, angle, filled, beside, row_rank in rows:
        text = Text(f"{name:<9} {angle:>7} ", style="bold" if name == axis.value else "")
        yield Row(Text.assemble(text, "▕", filled, "│ ", beside), row_rank)
    off = Text(f"{'off by':<9} {degrees(each.off_deg, sign=True) if each.ordered_deg is not None else '':>7} ")
    if stray := by_itself(axis, each):
        off = Text.assemble((f"{stray:<17}", ALARMS), " ")
    yield Row(Text.assemble(off, " ", bar.scale()), ranks.numbers if stray else ranks.scales)


def _narrow(axis: Axis, each: AxisStatus, bar: Bar, ranks: Ranks, width: int) -> Iterator[Row]:
    yield Row(_in_a_row(axis, each, width), ranks.numbers)
    yield Row(Text.assemble("▕", _filled(bar, each), "│"), ranks.bars)
    yield Row(Text.assemble("▕", bar.filled_to(each.ordered_deg, TARGET_STYLE, names=True), "│"), ranks.scales)
    yield Row(Text.assemble(" ", bar.scale()), ranks.scales)


def _in_a_row(axis: Axis, each: AxisStatus, width: int) -> Text:
    """An axis in one row, with what its angle is worth; in shorter words where they do not fit."""
    text = Text()
    for off, short in (("off ", False), ("", False), ("", True)):
        text = Text(f"{'az' if axis is Axis.AZIMUTH else 'el'} {stands(each)}", style="bold")
        if stray := by_itself(axis, each):
            text.append(" ").append(stray, style=ALARMS)
        elif each.seen and each.ordered_deg is not None:
            text.append(f" → {degrees(each.ordered_deg)}").append(f" {off}{degrees(each.off_deg, sign=True)}")
        if each.drive is not Direction.OFF:
            text.append(f" {TURNS[axis, each.drive]}", style="bold green")
        worth = _worth(each)
        if short and each.seen and not each.error_text:
            worth.plain = f"{worth.plain[:4]}."
        text.append(" ").append_text(worth)
        if text.cell_len <= width:
            break
    return text


def _worth(each: AxisStatus) -> Text:
    """What the angle is worth: measured, counted, how far off, or what it was when the sensor was last heard."""
    if each.seen and each.error_text:
        return Text(each.error_text.strip(), style="dim")
    if each.seen:
        return Text(each.source.value, style="dim")
    return Text("no signal") if each.shown_deg is None else Text("last seen", style=ALARMS)


def _filled(bar: Bar, each: AxisStatus) -> Text:
    return bar.filled_to(each.angle_deg, ANTENNA_STYLE if each.seen else "dim")


def _bar(status: Status, axis: Axis, mount: Mount | None, cells: int) -> Bar:
    each = status.axis(axis)
    zones = [*_forbidden(status, axis, mount), *(overlap(each.min_deg, each.max_deg) if axis is Axis.AZIMUTH else ())]
    return Bar(each.min_deg, each.max_deg, max(cells, 8), zones)


def _forbidden(status: Status, axis: Axis, mount: Mount | None) -> Iterator[Zone]:
    """The forbidden zones of this axis at the present angle of the other one."""
    other = status.axis(Axis.ELEVATION if axis is Axis.AZIMUTH else Axis.AZIMUTH).angle_deg
    for sector in mount.about(0.0).sectors if mount else ():
        here, there = sector.azimuth, sector.elevation
        if axis is Axis.ELEVATION:
            here, there = there, here
        if other is None or there.widened(sector.margin_deg).holds(other):
            yield forbidden(sector.name, here.min_deg, here.max_deg)


# --- a bar

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
