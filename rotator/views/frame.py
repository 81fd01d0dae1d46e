"""A frame of rows and tables that fits into the terminal, and the same for a terminal that has only ASCII.

On a small terminal whole rows and whole columns are left out before a text is cut. Knows widths, heights, the ranks by
which rows and columns are left out, and characters: the console of a Raspberry Pi has no dots and no part blocks. Does
not know the content of the rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rich.console import Console, ConsoleOptions, RenderResult
from rich.style import Style
from rich.text import Text

ENDLESS = 10_000
"""The height of an output that is no terminal, in rows."""
_GAPS = (3, 2)
"""Cells between two columns: the first number if the table fits with it, otherwise the second."""


@dataclass(frozen=True, slots=True)
class Row:
    """One row. On a low terminal the rows with the highest `rank` are left out first; among equals, the last row."""

    text: Text
    rank: int


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a table.

    `right`: aligned to the right. `width`: cells of the texts, 0 for as many as the longest text needs. `least`: the
    fewest cells to which the column may shrink; None: it does not shrink. `rank`: on a narrow terminal the columns with
    the highest rank are left out first; rank 0 always stays. `end`: a text that is too long is cut at its beginning.
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
        """The column's cells if there is room. A fixed `width` keeps the column in place while its text changes."""
        longest = max((cell.cell_len for cell in self.cells), default=0)
        return max(len(self.heading), self.width or longest)

    def fit(self, text: Text, width: int) -> Text:
        text = text.copy()
        if self.end and text.cell_len > width:
            text = Text("…", style=text.style) + text[-(width - 1) :]
        text.truncate(width, overflow="ellipsis")
        text.align("right" if self.right else "left", width)
        return text


@dataclass(eq=False)
class Framed:
    """A frame that `rich` can print. `rows` takes the cells and the rows inside the frame, and returns its rows.

    `drawn`: how a row is drawn, for a terminal that has few characters.
    """

    title: str
    rows: Callable[[int, int], Iterable[Row]]
    drawn: Callable[[Text], Text] = lambda text: text

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        width = options.max_width
        height = options.max_height - 2 if console.is_terminal else ENDLESS
        rows = fewer(list(self.rows(width - 4, height)), height)
        title = Text(f" {self.title} ")
        title.truncate(max(width - 4, 0), overflow="ellipsis")
        yield self.drawn(Text("╭─") + title + Text("─" * (width - 3 - title.cell_len) + "╮"))
        for row in rows:
            text = row.text.copy()
            text.truncate(width - 4, overflow="ellipsis", pad=True)
            yield self.drawn(Text("│ ") + text + Text(" │"))
        yield self.drawn(Text("╰" + "─" * (width - 2) + "╯"))


def wrapped(text: str, width: int, style: str, rank: int) -> list[Row]:
    """The text in as many rows as it needs, broken between words if possible."""
    words = Text(text, style=style)
    return [Row(line, rank) for line in words.wrap(Console(width=width), width)]


def table(columns: Sequence[Column], width: int, *, rank: int, head_rank: int, rule_rank: int) -> list[Row]:
    """A heading, a rule and the rows of a table that is `width` cells wide at most."""
    columns, gap, widths = _fit(list(columns), width)

    def row(cells: Iterable[Text], row_rank: int) -> Row:
        fitted = [column.fit(cell, cells_wide) for column, cell, cells_wide in zip(columns, cells, widths, strict=True)]
        return Row(Text(" " * gap).join(fitted), row_rank)

    head = row((Text(column.heading, style="bold") for column in columns), head_rank)
    rule = Row(Text("─" * (sum(widths) + gap * (len(widths) - 1)), style="dim"), rule_rank)
    rows = zip(*(column.cells for column in columns), strict=True)
    return [head, rule, *(row(cells, rank) for cells in rows)]


def beside(left: Sequence[Text], right: Sequence[Text], gap: int = 2) -> list[Text]:
    """Two blocks side by side, with `gap` cells between them. Blank rows fill up the shorter block."""
    width = max(row.cell_len for row in left)
    blank = Text(" " * width)
    height = max(len(left), len(right))
    both = zip([*left, *[blank] * (height - len(left))], [*right, *[Text()] * (height - len(right))], strict=True)
    return [Text.assemble(one, " " * (width - one.cell_len + gap), other) for one, other in both]


def boxed(rows: Sequence[Text], frame: Style) -> list[Text]:
    """A heavy frame around rows of equal width."""
    edge = "━" * rows[0].cell_len
    side = Text("┃", style=frame)
    return [
        Text(f"┏{edge}┓", style=frame),
        *(Text.assemble(side, row, side) for row in rows),
        Text(f"┗{edge}┛", style=frame),
    ]


def _fit(columns: list[Column], width: int) -> tuple[list[Column], int, list[int]]:
    """The columns that are shown, the gap between them, and the width of each, in cells.

    If the table is too wide, the gap becomes narrower first. Then the columns with a rank shrink, then they are left
    out. The columns with rank 0 shrink last.
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


def fewer(rows: list[Row], height: int) -> list[Row]:
    """The rows that fit into this height."""
    keep = sorted(range(len(rows)), key=lambda at: (rows[at].rank, at))[: max(height, 0)]
    return [rows[at] for at in sorted(keep)]


_ASCII = str.maketrans(
    {
        **dict.fromkeys("╭╮╰╯┏┓┗┛", "+"),
        **dict.fromkeys("─━", "-"),
        **dict.fromkeys("│┃▕", "|"),
        **dict.fromkeys("▏▎", "."),
        **dict.fromkeys("▍▌▋", ":"),
        **dict.fromkeys("▊▉█", "#"),
        **dict(zip("░▒●○◆◇◈→…–—✓✗≈", ":x*.#o@>~--vx~", strict=True)),
        **{chr(code): "." for code in range(0x2801, 0x2900)},
    }
)
_NO_UNICODE = frozenset({"linux", "vt100", "vt102", "vt220", "ansi", "cons25", "dumb", "unknown"})
"""Values of TERM. The text mode of Linux has only some hundred characters, with any encoding."""


def ascii_only(encoding: str, term: str) -> bool:
    """Whether a terminal of this name, with this encoding, shows only ASCII."""
    return term in _NO_UNICODE or "utf" not in encoding.lower()


def in_ascii(text: Text) -> Text:
    """The text with the same cells and colours. The degree sign stays: Latin-1 and the Linux console have it."""
    plain = text.copy()
    plain.plain = text.plain.translate(_ASCII)
    return plain
