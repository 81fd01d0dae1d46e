"""Both axes on a screen: the angle of each, its target, its error, and the direction of its motor.

Knows the numbers and the bars of an axis, on a wide and on a narrow screen. Does not know what else is shown.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rich.text import Text

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Mount
from rotator.exchange.status import AxisStatus, Status
from rotator.views.bars import Bar, Zone, forbidden, overlap
from rotator.views.frame import Row
from rotator.views.sky_plot import ANTENNA_STYLE, TARGET_STYLE
from rotator.views.words import ALARMS, TURNS, by_itself, degrees

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
    for axis in Axis:
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
        (axis.value, each.shown_deg, _filled(bar, each), Text.assemble(one, " ", other), ranks.numbers),
        (
            "target",
            each.ordered_deg,
            bar.filled_to(each.ordered_deg, TARGET_STYLE, names=True),
            _worth(each),
            worth_rank,
        ),
    )
    for name, angle_deg, filled, beside, row_rank in rows:
        text = Text(f"{name:<9} {degrees(angle_deg):>7} ", style="bold" if name == axis.value else "")
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
        text = Text(f"{'az' if axis is Axis.AZIMUTH else 'el'} {degrees(each.shown_deg)}", style="bold")
        if stray := by_itself(axis, each):
            text.append(" ").append(stray, style=ALARMS)
        elif each.seen and each.ordered_deg is not None:
            text.append(f" → {degrees(each.ordered_deg)}").append(f" {off}{degrees(each.off_deg, sign=True)}")
        if each.drive is not Direction.OFF:
            text.append(f" {TURNS[axis, each.drive]}", style="bold green")
        worth = _worth(each)
        if short and each.seen:
            worth.plain = f"{worth.plain[:4]}."
        text.append(" ").append_text(worth)
        if text.cell_len <= width:
            break
    return text


def _worth(each: AxisStatus) -> Text:
    """What the angle is worth: measured, counted, or what it was when the sensor was last heard."""
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
    for sector in mount.sectors if mount else ():
        here, there = sector.azimuth, sector.elevation
        if axis is Axis.ELEVATION:
            here, there = there, here
        if other is None or there.widened(sector.margin_deg).holds(other):
            yield forbidden(sector.name, here.min_deg, here.max_deg)
