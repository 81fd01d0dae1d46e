"""The picture of the box in a terminal: its LCD, both axes, the relays, and the last bytes on each link.

Knows the layout and the keys' names. Does not read keys, clocks or the terminal: it turns values into text, or into
something that `rich` can print.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Protocol

from rich.console import RenderableType
from rich.style import Style
from rich.text import Text

from hw.ports import Axis, Direction
from rotator.status import AxisStatus, Status
from rotator.views.frame import Column, Framed, Row, beside, boxed, table, wrapped

_WORDS = {
    (Axis.AZIMUTH, Direction.PLUS): "CW",
    (Axis.AZIMUTH, Direction.MINUS): "CCW",
    (Axis.ELEVATION, Direction.PLUS): "UP",
    (Axis.ELEVATION, Direction.MINUS): "DOWN",
}
_BAR_CELLS = 14
_GLASS = "bold #e8f4ff on #1040c0"
_BEZEL = Style.parse("#708090")
_KEYS, _TROUBLE, _ANGLE, _MORE, _LINK, _NOTE, _FRAME, _HEAD, _RULE, _SPACE, _LOG = range(11)
"""Ranks of rows: on a low terminal the rows with the highest rank are left out first. The newest log line has the rank
_LOG, and each older one the next higher rank.
"""
KEYS = "space STOP   q quit   park, resume: type the word and Enter"
_BLANK = Row(Text(), _SPACE)


class WireView(Protocol):
    """The properties of a link that the picture shows."""

    name: str
    protocol: str
    where: str
    state: str
    last_in: bytes
    last_out: bytes


def greeting(version: str, hardware: str, wires: Sequence[WireView]) -> list[str]:
    """The version, and the address of each link, in plain lines."""
    what = "a SIMULATED rotor" if hardware == "sim" else "the rotor on this Pi"
    return [f"rotator {version}: {what}", *(f"  {wire.protocol:<11} {wire.where}  ({wire.state})" for wire in wires)]


def line(status: Status) -> str:
    """The status in one plain line. It has no time and no counter, so equal lines mean that nothing has changed."""
    parts = [_axis_words(status, axis) for axis in Axis]
    if status.mode_switch:
        parts.append(f"mode {status.mode.name}")
    if status.latched:
        parts.append(f"STOPPED by {status.latched}")
    parts += [f"FAULT {fault}" for fault in status.faults]
    parts += [f"NOTE {notice}" for notice in _notes(status)]
    return "  ".join(parts)


def picture(
    version: str,
    status: Status,
    glass: Sequence[str],
    wires: Sequence[WireView],
    log_rows: Sequence[str],
    *,
    typed: str = "",
) -> RenderableType:
    """The whole picture. On a low terminal log lines are left out first; keys, faults and angles stay longest.

    `typed`: what the person at the keys has typed, and what came of it.
    """

    def rows(width: int) -> Iterator[Row]:
        yield from _top(glass, _relays(status))
        yield from _axes(status, width)
        yield from _links(wires, width)
        yield _BLANK
        for fault in status.faults:
            yield from _trouble(str(fault), width)
        if status.latched:
            yield from _trouble(f"held by {status.latched}: nothing moves until resume", width)
        uncalibrated = {axis: status.axis(axis).uncalibrated for axis in Axis}
        notes = [f"{axis.value} UNCALIBRATED: {missing}" for axis, missing in uncalibrated.items() if missing]
        for note in (*status.notices, *notes, *_notes(status)):
            yield from wrapped(note, width, "bold yellow", _NOTE)
        yield from (Row(Text(line, style="dim"), _LOG + age) for age, line in _newest_last(log_rows))
        if typed:
            yield Row(Text(typed, style="bold reverse"), _KEYS)
        yield from wrapped(KEYS, width, "bold", _KEYS)

    return Framed(f"rotator {version}" + ("  SIMULATED" if status.simulated else ""), rows)


def sketch_picture(glass: Sequence[str], drives: tuple[int, int], wires: Sequence[WireView]) -> RenderableType:
    """The picture of the emulated Arduino: its LCD, its relays, its serial line. `drives`: -1, 0 or 1 for each axis."""
    relays = _relay_lamps({Axis.AZIMUTH: Direction(drives[0]), Axis.ELEVATION: Direction(drives[1])})

    def rows(width: int) -> Iterator[Row]:
        yield from _top(glass, relays)
        yield from _links(wires, width)
        yield _BLANK
        yield Row(Text("q quit", style="bold"), _KEYS)

    return Framed("F1EFW sketch on an emulated UNO  SIMULATED", rows)


def _trouble(text: str, width: int) -> list[Row]:
    """Its first row says where and what. On a low terminal the others make way for the keys and the angles."""
    first, *more = wrapped(text, width, "bold white on red", _MORE)
    return [replace(first, rank=_TROUBLE), *more]


def _newest_last(lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Each line with its age: the number of newer lines."""
    return ((len(lines) - 1 - at, line) for at, line in enumerate(lines))


def _top(glass: Sequence[str], relays: Sequence[Text]) -> Iterator[Row]:
    """The LCD in its frame, and the relays beside it."""
    display = boxed([Text(f" {row} ", style=_GLASS) for row in glass], _BEZEL)
    for at, text in enumerate(beside(display, relays)):
        yield Row(text, _FRAME if at in (0, len(display) - 1) else _ANGLE)


def _relays(status: Status) -> list[Text]:
    who = f"under {status.controlled_by}" if status.controlled_by else "under nobody's orders"
    if status.timed_points:
        who += f", point {status.timed_point} of {status.timed_points}"
    if status.mode_switch:
        who = f"mode {status.mode.name}, {who}"
    rows = _relay_lamps({axis: status.axis(axis).drive for axis in Axis})
    return [*rows, Text(f" {who}", style="dim")]


def _relay_lamps(drives: Mapping[Axis, Direction]) -> list[Text]:
    """A blank row beside the upper edge of the LCD's frame, then a row for each axis."""
    rows = [Text()]
    for axis in Axis:
        row = Text()
        for direction in (Direction.PLUS, Direction.MINUS):
            on = drives[axis] is direction
            row.append(f" {'●' if on else '○'} {_WORDS[axis, direction]:<5}", style="bold green" if on else "dim")
        rows.append(row)
    return rows


def _axes(status: Status, width: int) -> Iterator[Row]:
    every = [status.axis(axis) for axis in Axis]
    readings = ["" if each.raw is None else f"{round(each.raw, 4) + 0.0:.4f} {each.source.value}" for each in every]
    columns = [
        Column("axis", [Text(axis.value) for axis in Axis]),
        Column("angle", [Text(_degrees(each.shown_deg)) for each in every], right=True, width=7),
        Column("target", [Text(_degrees(each.target_deg)) for each in every], right=True, width=7),
        Column("", [_bar(each) for each in every], rank=2),
        Column("range", [Text(f"{each.min_deg:g}…{each.max_deg:g}°") for each in every]),
        Column("reading", [Text(reading) for reading in readings], width=18, rank=1),
    ]
    yield _BLANK
    yield from table(columns, width, rank=_ANGLE, head_rank=_HEAD, rule_rank=_RULE)


def _links(wires: Sequence[WireView], width: int) -> Iterator[Row]:
    """The table of links. Names and addresses come first; the last bytes get the remaining width."""
    columns = [
        Column("link", [Text(wire.name) for wire in wires]),
        Column("where", [Text(wire.where) for wire in wires], least=16),
        Column("state", [Text(wire.state) for wire in wires], least=12),
        Column("last in", [Text(_bytes(wire.last_in)) for wire in wires], width=16, least=8, rank=1, end=True),
        Column("last out", [Text(_bytes(wire.last_out)) for wire in wires], width=18, least=10, rank=2, end=True),
    ]
    yield _BLANK
    yield from table(columns, width, rank=_LINK, head_rank=_HEAD, rule_rank=_RULE)


def _notes(status: Status) -> list[str]:
    return [f"{axis.value}: {notice}" for axis in Axis for notice in status.axis(axis).notices]


def _bar(axis: AxisStatus) -> Text:
    """The axis's range as a line of cells, with marks for the antenna (█) and its target (│)."""
    cells = ["─"] * _BAR_CELLS
    for angle_deg, mark in ((axis.target_deg, "│"), (axis.angle_deg, "█")):
        if angle_deg is not None:
            share = (angle_deg - axis.min_deg) / (axis.max_deg - axis.min_deg)
            cells[min(max(int(share * _BAR_CELLS), 0), _BAR_CELLS - 1)] = mark
    return Text("".join(cells), style="cyan")


def _axis_words(status: Status, axis: Axis) -> str:
    each = status.axis(axis)
    words = [f"{axis.value} {_degrees(each.shown_deg, 0)}"]
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
    # Adding zero turns -0.0, from a noisy pot at its stop, into 0.0.
    return "---" if angle_deg is None else f"{round(angle_deg, digits) + 0.0:.{digits}f}°"


def _bytes(data: bytes) -> str:
    """Bytes as text for the operator: printable characters, and escapes for the other bytes."""
    return data.decode("latin-1").encode("unicode_escape").decode("ascii")
