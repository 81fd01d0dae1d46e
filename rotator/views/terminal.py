"""The picture of the box in a terminal: its activity, its display, both axes, the links, the faults, and the keys.

Knows the layout on small and large terminals. Does not read keys, clocks or the terminal: it turns values into
something that `rich` can print.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rich.console import RenderableType
from rich.style import Style
from rich.text import Text

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Mount
from rotator.exchange.spoken import spoken
from rotator.exchange.status import Status
from rotator.views import sky_plot
from rotator.views.axis_rows import WIDE, Ranks, axis_rows, lamps
from rotator.views.frame import ENDLESS, Column, Framed, Row, beside, boxed, fewer, in_ascii, table, wrapped
from rotator.views.sky_plot import Way
from rotator.views.words import (
    ALARMS,
    KEYS,
    WARNS,
    WireView,
    headline,
    is_out,
    lacks,
    links,
    notes,
    off_target,
    orders_from,
    pass_starts,
    release,
)

_GLASS = "bold #e8f4ff on #1040c0"
_BEZEL = Style.parse("#708090")
_LEFT, _BETWEEN = 76, 3
"""Least number of cells for everything beside the plot of the sky, and the cells between the two."""
_GLASS_ROWS = 18
"""Rows: at this height or more, the display is shown."""
_KEYS, _TROUBLE, _ANGLE, _WHO, _MORE, _BARS, _LINKS_LINE, _SCALES, _LINK, _NOTE, _HEAD, _RULE, _SPACE, _LOG = range(14)
"""Ranks of rows: on a low terminal the rows with the highest rank are left out first. The newest log line has the rank
_LOG, and each older one the next higher rank.
"""
_BLANK = Row(Text(), _SPACE)


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The content of the picture that is not in the status.

    `trail`: where the antenna has been. `typed`: what the person at the keys has typed, and what came of it.
    `ascii_only`: the terminal has no more characters than that.
    """

    mount: Mount | None = None
    trail: Sequence[Way] = ()
    typed: str = ""
    ascii_only: bool = False


def picture(
    version: str,
    status: Status,
    glass: Sequence[str],
    wires: Sequence[WireView],
    log_rows: Sequence[str],
    *,
    around: Surroundings = Surroundings(),
) -> RenderableType:
    """The whole picture. On a low terminal log lines are left out first; keys, faults and angles stay longest."""

    def rows(width: int, height: int) -> Iterator[Row]:
        high = ENDLESS if height == ENDLESS else height
        plot_columns, plot_rows = _plot_beside(width, high)
        left = width - plot_columns - _BETWEEN if plot_columns else width
        every = fewer(list(_rows(left, height)), height)
        short_links = sum(row.rank == _LINK for row in every) < len(wires)
        if short_links:
            wanted = list(_rows(left, height, short=True))
            every = fewer(wanted, height)
            if sum(row.rank == _MORE for row in every) < sum(row.rank == _MORE for row in wanted):
                every = fewer(list(_rows(left, height, short=True, short_faults=True)), height)
        if plot_columns:
            plotted = sky_plot.plot(plot_columns, plot_rows, status, around.mount, around.trail)
            texts = beside([_padded(row.text, left) for row in every], plotted, _BETWEEN)
            yield from (Row(text, _KEYS) for text in texts)
            return
        room = height - len(every) - 1
        if height < ENDLESS and room >= sky_plot.LEAST_CELLS[1] and width >= sky_plot.LEAST_CELLS[0]:
            size = min(width, 2 * room), min(room, width // 2 + 1)
            plotted = sky_plot.plot(*size, status, around.mount, around.trail)
            last = len(every) - sum(row.rank == _KEYS for row in every)
            middle = [Row(Text(" " * ((width - size[0]) // 2)) + text, _LOG) for text in plotted]
            every = [*every[:last], *middle, *every[last:]]
        yield from every

    def _rows(width: int, height: int, *, short: bool = False, short_faults: bool = False) -> Iterator[Row]:
        """`short`: a line in place of the table of links, for a terminal that has no room for all of them.
        `short_faults`: a row for each fault, in place of a text that would lose its end."""
        yield from _top(glass, status, wires, width, height)
        yield _BLANK
        yield from axis_rows(status, around.mount, width, Ranks(_ANGLE, _BARS, _SCALES))
        yield from [_links_line(wires)] if short else _links(wires, width)
        yield _BLANK
        for fault in status.faults:
            # The headline already says what to do at once.
            text = str(fault).removeprefix(fault.act_now).strip()
            yield from [_cut(text, width)] if short_faults else _trouble(text, width)
        if to_go_on := release(status):
            yield from (replace(row, rank=_TROUBLE) for row in _trouble(to_go_on, width))
        noted = [spoken(note) for note in (*status.notices, *lacks(status), *notes(status))]
        for note in noted:
            yield from wrapped(note, width, WARNS, _NOTE)
        # A log line that is already shown as a note is left out.
        news = [line for line in log_rows if not line.endswith(tuple(noted))]
        for age, line in _newest_last(news):
            yield from wrapped(line, width, "dim", _LOG + age)
        if around.typed:
            yield Row(Text(around.typed, style="bold reverse"), _KEYS)
        yield from _keys(width)

    title = f"rotator {version}" + ("  SIMULATED" if status.simulated else "")
    return Framed(title, rows, in_ascii) if around.ascii_only else Framed(title, rows)


def sketch_picture(glass: Sequence[str], drives: tuple[int, int], wires: Sequence[WireView]) -> RenderableType:
    """The picture of the emulated Arduino: its LCD, its relays, its serial line. `drives`: -1, 0 or 1 for each axis."""
    on = dict(zip(Axis, map(Direction, drives), strict=True))

    def rows(width: int, _height: int) -> Iterator[Row]:
        relays = [Text(), *(_lamp_row(on, axis) for axis in Axis)]
        yield from _glass_beside(glass, relays)
        yield from _links(wires, width)
        yield _BLANK
        yield Row(Text("q quit", style="bold"), _KEYS)

    return Framed("F1EFW sketch on an emulated UNO  SIMULATED", rows)


def _plot_beside(width: int, height: int) -> tuple[int, int]:
    """Columns and rows of a plot at the right side; 0 if there is no room."""
    columns = min(width - _LEFT - _BETWEEN, 2 * min(height, width // 4))
    rows = min(height, columns // 2 + 1)
    least_columns, least_rows = sky_plot.LEAST_CELLS
    return (columns, rows) if columns >= least_columns and rows >= least_rows else (0, 0)


def _keys(width: int) -> Iterator[Row]:
    """The meaning of each key, in one row if there is room."""
    line = "   ".join(KEYS)
    narrow = KEYS[0], "Words: park (storm), resume (go on)"
    for text in (line,) if len(line) <= width else narrow:
        yield Row(Text(text, style="bold"), _KEYS)


def _padded(text: Text, width: int) -> Text:
    text = text.copy()
    text.truncate(width, overflow="ellipsis", pad=True)
    return text


def _trouble(text: str, width: int) -> list[Row]:
    """A fault. Its first row names the axis and the fault. On a low terminal the other rows are left out first."""
    first, *more = wrapped(text, width, ALARMS, _MORE)
    return [replace(first, rank=_TROUBLE), *more]


def _cut(text: str, width: int) -> Row:
    """The text in one row, with a sign that it goes on."""
    words = Text(text, style=ALARMS)
    words.truncate(width, overflow="ellipsis")
    return Row(words, _TROUBLE)


def _newest_last(lines: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Each line with its age: the number of newer lines."""
    return ((len(lines) - 1 - at, line) for at, line in enumerate(lines))


def _top(glass: Sequence[str], status: Status, wires: Sequence[WireView], width: int, height: int) -> Iterator[Row]:
    """The activity of the box, its sender and its error; beside the display if there is room."""
    words, style = headline(status)
    mode = f"panel at {status.mode.name}, " if status.mode_switch else ""
    texts = [
        Text(words, style=style),
        Text(f"{mode}{orders_from(status, wires)}"),
        Text(off_target(status), style="bold"),
        Text(pass_starts(status), style="dim"),
    ]
    if width >= WIDE and height >= _GLASS_ROWS:
        yield from _glass_beside(glass, texts)
        return
    for text, rank in zip(texts, (_KEYS, _WHO, _SCALES, _NOTE), strict=True):
        if text:
            yield Row(text, rank)


def _glass_beside(glass: Sequence[str], texts: Sequence[Text]) -> Iterator[Row]:
    """The LCD in its frame, and four rows beside it."""
    display = boxed([Text(f" {row} ", style=_GLASS) for row in glass], _BEZEL)
    for text in beside(display, texts):
        yield Row(text, _ANGLE)


def _lamp_row(drives: Mapping[Axis, Direction], axis: Axis) -> Text:
    one, other = lamps(drives, axis)
    return Text.assemble(one, " " * (8 - one.cell_len), other)


def _links(wires: Sequence[WireView], width: int) -> Iterator[Row]:
    """The table of links. Names and addresses come first; the last bytes get the remaining width."""
    columns = [
        Column("link", [Text(wire.name) for wire in wires]),
        Column("where", [Text(wire.where) for wire in wires], least=16),
        Column("state", [Text(wire.state, style=WARNS if is_out(wire) else "") for wire in wires], least=12),
        Column("last in", [Text(_bytes(wire.last_in)) for wire in wires], width=16, least=8, rank=1, end=True),
        Column("last out", [Text(_bytes(wire.last_out)) for wire in wires], width=18, least=10, rank=2, end=True),
    ]
    yield _BLANK
    yield from table(columns, width, rank=_LINK, head_rank=_HEAD, rule_rank=_RULE)


def _links_line(wires: Sequence[WireView]) -> Row:
    words, style = links(wires)
    return Row(Text(words, style=style), _WHO if any(map(is_out, wires)) else _LINKS_LINE)


def _bytes(data: bytes) -> str:
    """Bytes as text for the operator: printable characters, and escapes for the other bytes."""
    return data.decode("latin-1").encode("unicode_escape").decode("ascii")
