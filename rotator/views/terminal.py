"""The box in a terminal: the display as it looks, both axes, the relays, the last bytes on each link.

Knows the layout. Pure: values in, something `rich` can print out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from rich.box import HEAVY, SIMPLE_HEAD
from rich.columns import Columns
from rich.console import Group, RenderableType
from rich.panel import Panel
from rich.table import Table
from rich.text import Text

from hw.ports import Axis, Direction
from rotator.status import AxisStatus, Status

_WORDS = {
    (Axis.AZIMUTH, Direction.PLUS): "CW",
    (Axis.AZIMUTH, Direction.MINUS): "CCW",
    (Axis.ELEVATION, Direction.PLUS): "UP",
    (Axis.ELEVATION, Direction.MINUS): "DOWN",
}
WIDTH = 88
_IN_CELLS, _OUT_CELLS = 16, 18
_BAR_CELLS = 14


class WireView(Protocol):
    """What is shown of a link."""

    name: str
    protocol: str
    where: str
    state: str
    last_in: bytes
    last_out: bytes


def greeting(version: str, hardware: str, wires: Sequence[WireView]) -> list[str]:
    """Where to connect, in plain lines."""
    what = "a SIMULATED rotor" if hardware == "sim" else "the rotor on this Pi"
    return [f"rotator {version}: {what}", *(f"  {wire.protocol:<11} {wire.where}  ({wire.state})" for wire in wires)]


def line(status: Status) -> str:
    """The status in one plain line, without anything that changes when nothing does."""
    parts = [_axis_words(status, axis) for axis in Axis]
    if status.latched:
        parts.append(f"STOPPED by {status.latched}")
    parts += [f"FAULT {fault}" for fault in status.faults]
    parts += [f"NOTE {notice}" for notice in _notes(status)]
    return "  ".join(parts)


def picture(
    version: str, status: Status, glass: Sequence[str], wires: Sequence[WireView], log_rows: Sequence[str]
) -> RenderableType:
    title = f"rotator {version}" + ("  SIMULATED" if status.simulated else "")
    parts: list[RenderableType] = [
        Columns([_glass(glass), _relays(status)], padding=(0, 2)),
        _axes(status),
        _links(wires),
    ]
    if status.faults or status.latched:
        parts.append(_alarm(status))
    uncalibrated = [f"{axis.value} UNCALIBRATED: {each}" for axis in Axis if (each := status.axis(axis).uncalibrated)]
    notes = uncalibrated + _notes(status)
    if notes:
        parts.append(Text("\n".join(notes), style="bold yellow"))
    if log_rows:
        parts.append(Text("\n".join(log_rows), style="dim", no_wrap=True, overflow="ellipsis"))
    parts.append(Text("space STOP   p storm park   r release   q quit", style="bold"))
    return Panel(Group(*parts), title=title, title_align="left", width=WIDTH)


def sketch_picture(glass: Sequence[str], drives: tuple[int, int], wires: Sequence[WireView]) -> RenderableType:
    """The emulated Arduino: its display, its relays, its serial line."""
    relays = _relay_lamps({Axis.AZIMUTH: Direction(drives[0]), Axis.ELEVATION: Direction(drives[1])})
    parts = [Columns([_glass(glass), relays], padding=(0, 2)), _links(wires), Text("q quit", style="bold")]
    return Panel(Group(*parts), title="F1EFW sketch on an emulated UNO  SIMULATED", title_align="left", width=WIDTH)


def _glass(rows: Sequence[str]) -> RenderableType:
    text = Text("\n".join(f" {row} " for row in rows), style="bold #e8f4ff on #1040c0")
    return Panel(text, box=HEAVY, expand=False, style="#708090")


def _relays(status: Status) -> RenderableType:
    text = _relay_lamps({axis: status.axis(axis).drive for axis in Axis})
    who = f"under {status.controlled_by}" if status.controlled_by else "under nobody's orders"
    if status.timed_points:
        who += f", point {status.timed_point} of {status.timed_points}"
    text.append(f" {who}", style="dim")
    return text


def _relay_lamps(drives: Mapping[Axis, Direction]) -> Text:
    text = Text()
    for (axis, direction), word in _WORDS.items():
        on = drives[axis] is direction
        text.append(f" {'●' if on else '○'} {word:<5}", style="bold green" if on else "dim")
        if direction is Direction.MINUS:
            text.append("\n")
    return text


def _axes(status: Status) -> RenderableType:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("axis", "angle", "target", "", "range", "reading"):
        table.add_column(heading, justify="right" if heading in ("angle", "target") else "left", no_wrap=True)
    for axis in Axis:
        each = status.axis(axis)
        table.add_row(
            axis.value,
            _degrees(each.angle_deg),
            _degrees(each.target_deg),
            _bar(each),
            f"{each.min_deg:g}…{each.max_deg:g}°",
            "" if each.raw is None else f"{each.raw:.4f} {each.source.value}",
        )
    return table


def _links(wires: Sequence[WireView]) -> RenderableType:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading, cells in (("link", 8), ("where", 14), ("state", 13), ("last in", _IN_CELLS), ("last out", _OUT_CELLS)):
        table.add_column(heading, width=cells, no_wrap=True, overflow="ellipsis")
    for wire in wires:
        last_in, last_out = _bytes(wire.last_in, _IN_CELLS), _bytes(wire.last_out, _OUT_CELLS)
        table.add_row(wire.name, wire.where, wire.state, last_in, last_out)
    return table


def _alarm(status: Status) -> RenderableType:
    rows = [str(fault) for fault in status.faults]
    if status.latched:
        rows.append(f"held by {status.latched}: no order moves it until released (r)")
    return Panel(Text("\n".join(rows), style="bold white on red"), box=HEAVY, style="red", expand=False)


def _notes(status: Status) -> list[str]:
    return [f"{axis.value}: {notice}" for axis in Axis for notice in status.axis(axis).notices]


def _bar(axis: AxisStatus) -> Text:
    """The range from end to end, with the antenna (█) and its target (│) on it."""
    cells = ["─"] * _BAR_CELLS
    for angle_deg, mark in ((axis.target_deg, "│"), (axis.angle_deg, "█")):
        if angle_deg is not None:
            share = (angle_deg - axis.min_deg) / (axis.max_deg - axis.min_deg)
            cells[min(max(int(share * _BAR_CELLS), 0), _BAR_CELLS - 1)] = mark
    return Text("".join(cells), style="cyan")


def _axis_words(status: Status, axis: Axis) -> str:
    each = status.axis(axis)
    words = [f"{axis.value} {_degrees(each.angle_deg, 0)}"]
    if each.target_deg is not None:
        words.append(f"to {_degrees(each.target_deg)}")
    if each.drive is not Direction.OFF:
        words.append(_WORDS[axis, each.drive])
    if each.uncalibrated:
        words.append(
            f"UNCALIBRATED ({each.uncalibrated}; reads {each.raw if each.raw is None else round(each.raw, 3)})"
        )
    return " ".join(words)


def _degrees(angle_deg: float | None, digits: int = 1) -> str:
    # Adding zero turns the minus zero of a noisy pot at its stop into zero.
    return "---" if angle_deg is None else f"{round(angle_deg, digits) + 0.0:.{digits}f}°"


def _bytes(data: bytes, cells: int) -> str:
    """Bytes as a person reads them: printable as they are, the rest escaped."""
    text = data.decode("latin-1").encode("unicode_escape").decode("ascii")
    return text if len(text) <= cells else "…" + text[-cells + 1 :]
