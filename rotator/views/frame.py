"""Rows in a frame, made to fit the terminal: whole rows are left out, and a table's columns, before any is cut.

Knows widths, heights and which rows matter least. Knows nothing of rotors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rich.console import Console, ConsoleOptions, RenderResult
from rich.style import Style
from rich.text import Text

WIDTH = 88
"""Cells, frame included, where the terminal has as many."""
_GAPS = (3, 2)
"""Cells between two columns: the wider where there is room."""


@dataclass(frozen=True, slots=True)
class Row:
    """`rank`: rows of the highest rank are left out first when the terminal is too low, later ones before earlier."""

    text: Text
    rank: int


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a table.

    `least`: how many cells it may shrink to; None: as wide as its text. `rank`: columns of the highest rank above 0 are
    left out first when the terminal is too narrow. `end`: the end of a long text is shown, not its beginning.
    """

    heading: str
    cells: Sequence[Text]
    right: bool = False
    width: int = 0
    least: int | None = None
    rank: int = 0
    end: bool = False

    @property
    def natural(self) -> int:
        """Cells that it takes where there is room; `width` holds it still while its text changes."""
        longest = max((cell.cell_len for cell in self.cells), default=0)
        return max(len(self.heading), self.width or longest)

    def fit(self, text: Text, width: int) -> Text:
        text = text.copy()
        if self.end and text.cell_len > width:
            text = Text("…", style=text.style) + text[-(width - 1) :]
        text.truncate(width, overflow="ellipsis")
        text.align("right" if self.right else "left", width)
        return text


class Framed:
    """Something `rich` can print. `rows` is given the cells between the frame's sides."""

    def __init__(self, title: str, rows: Callable[[int], Iterable[Row]]) -> None:
        self._title = title
        self._rows = rows

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = min(options.max_width, WIDTH)
        rows = list(self._rows(width - 4))
        if console.is_terminal:
            rows = _fewer(rows, options.max_height - 2)
        title = Text(f" {self._title} ")
        title.truncate(max(width - 4, 0), overflow="ellipsis")
        yield Text("╭─") + title + Text("─" * (width - 3 - title.cell_len) + "╮")
        for row in rows:
            text = row.text.copy()
            text.truncate(width - 4, overflow="ellipsis", pad=True)
            yield Text("│ ") + text + Text(" │")
        yield Text("╰" + "─" * (width - 2) + "╯")


def wrapped(text: str, width: int, style: str, rank: int) -> list[Row]:
    """As many rows as it takes; broken between words where that is possible."""
    words = Text(text, style=style)
    return [Row(line, rank) for line in words.wrap(Console(width=width), width)]


def table(columns: Sequence[Column], width: int, *, rank: int, head_rank: int, rule_rank: int) -> list[Row]:
    """A heading, a rule and the rows, in so many cells."""
    columns, gap, widths = _fit(list(columns), width)

    def row(cells: Iterable[Text], row_rank: int) -> Row:
        fitted = [column.fit(cell, cells_wide) for column, cell, cells_wide in zip(columns, cells, widths, strict=True)]
        return Row(Text(" " * gap).join(fitted), row_rank)

    head = row((Text(column.heading, style="bold") for column in columns), head_rank)
    rule = Row(Text("─" * (sum(widths) + gap * (len(widths) - 1)), style="dim"), rule_rank)
    rows = zip(*(column.cells for column in columns), strict=True)
    return [head, rule, *(row(cells, rank) for cells in rows)]


def beside(left: Sequence[Text], right: Sequence[Text], gap: int = 2) -> list[Text]:
    """Two blocks, the shorter filled up with empty rows."""
    width = max(row.cell_len for row in left)
    blank = Text(" " * width)
    height = max(len(left), len(right))
    both = zip([*left, *[blank] * (height - len(left))], [*right, *[Text()] * (height - len(right))], strict=True)
    return [Text.assemble(one, " " * (width - one.cell_len + gap), other) for one, other in both]


def boxed(rows: Sequence[Text], frame: Style) -> list[Text]:
    """Rows of one width in a heavy frame."""
    edge = "━" * rows[0].cell_len
    side = Text("┃", style=frame)
    return [
        Text(f"┏{edge}┓", style=frame),
        *(Text.assemble(side, row, side) for row in rows),
        Text(f"┗{edge}┛", style=frame),
    ]


def _fit(columns: list[Column], width: int) -> tuple[list[Column], int, list[int]]:
    """The columns that remain, the gap between them and their widths.

    First the gaps become narrower, then the columns with a rank; then those are left out; the others shrink last.
    """
    while True:
        widths = [column.natural for column in columns]
        for gap in _GAPS:
            over = sum(widths) + gap * (len(columns) - 1) - width
            if over <= 0:
                return columns, gap, widths
        rank = max(column.rank for column in columns)
        for at in reversed(range(len(columns))):
            least = columns[at].least
            if least is not None and bool(columns[at].rank) is bool(rank):
                less = min(over, max(widths[at] - least, 0))
                widths[at], over = widths[at] - less, over - less
        if over <= 0 or not rank:
            return columns, gap, widths
        columns = [column for column in columns if column.rank < rank]


def _fewer(rows: list[Row], height: int) -> list[Row]:
    keep = sorted(range(len(rows)), key=lambda at: (rows[at].rank, at))[: max(height, 0)]
    return [rows[at] for at in sorted(keep)]
