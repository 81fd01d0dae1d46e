"""What a terminal shows, as an SVG that looks the same with any fixed-width font.

Each word is stretched to its cells. Frames, bars, dots and lamps are drawn as lines and shapes, because each font gives
them another height and width. Knows `rich`, not what the picture says.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from itertools import groupby

from rich.color import Color, blend_rgb
from rich.color_triplet import ColorTriplet
from rich.console import Console, RenderableType
from rich.style import Style
from rich.terminal_theme import SVG_EXPORT_THEME as THEME

CELL_W, CELL_H, MARGIN, BAR_H = 10.0, 21.0, 12.0, 34.0
"""In pixels: a character's cell, the space around the rows, and the window's title bar."""
FONT = "ui-monospace, SFMono-Regular, Menlo, Consolas, 'DejaVu Sans Mono', 'Liberation Mono', monospace"
THIN, THICK = 1.3, 3.0
ARMS = {
    **{text: (arms, THIN) for text, arms in zip("─│╭╮╰╯", ("lr", "ud", "rd", "ld", "ru", "lu"), strict=True)},
    **{text: (arms, THICK) for text, arms in zip("━┃┏┓┗┛", ("lr", "ud", "rd", "ld", "ru", "lu"), strict=True)},
}
"""Which edges of its cell a character's lines reach from the middle, and how wide they are."""

PARTS = "▏▎▍▌▋▊▉█"
SHADES = {"░": 0.25, "▒": 0.5}
SHAPES = f"{PARTS}▕░▒●○◆◇◈"
DOTS = {chr(code) for code in range(0x2801, 0x2900)}
DOT_PLACES = ((0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3))
"""The column and the row of each bit's dot in a cell of two by four."""


@dataclass(frozen=True, slots=True)
class Cell:
    column: int
    row: int
    text: str
    style: Style

    @property
    def kind(self) -> str:
        if self.text in ARMS:
            return "line"
        if self.text in SHAPES or self.text in DOTS:
            return "shape"
        return "space" if self.text == " " else "word"

    @property
    def colour(self) -> str:
        colour = _triplet(self.style.color, foreground=True)
        ground = _triplet(self.style.bgcolor, foreground=False)
        return (blend_rgb(colour, ground, 0.4) if self.style.dim else colour).hex

    @property
    def x(self) -> float:
        return MARGIN + self.column * CELL_W

    @property
    def y(self) -> float:
        return BAR_H + self.row * CELL_H


def screen_svg(picture: RenderableType, title: str, width: int) -> str:
    """`width`: the terminal's, in cells."""
    lines = Console(width=width, file=io.StringIO()).render_lines(picture, pad=False)
    cells = [
        Cell(column, row, character, style)
        for row, line in enumerate(lines)
        for column, (character, style) in enumerate(
            (character, segment.style or Style.null()) for segment in line for character in segment.text
        )
    ]
    wide, high = 2 * MARGIN + width * CELL_W, BAR_H + len(lines) * CELL_H + MARGIN
    back, front = THEME.background_color.hex, THEME.foreground_color.hex
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:g} {high:g}" font-family="{FONT}" font-size="16">',
        f"<title>{escape(title)}</title>",
        f'<rect width="{wide:g}" height="{high:g}" rx="8" fill="{back}"/>',
        *(f'<circle cx="{20 + 20 * at}" cy="17" r="6" fill="{fill}"/>' for at, fill in enumerate(_LIGHTS)),
        f'<text x="{wide / 2:g}" y="22" text-anchor="middle" fill="{front}">{escape(title)}</text>',
    ]
    for _, run in groupby(cells, lambda cell: (cell.row, cell.style, cell.kind)):
        parts += _draw(list(run))
    return "\n".join((*parts, "</svg>")) + "\n"


_LIGHTS = ("#ff5f57", "#febc2e", "#28c840")


def _draw(run: list[Cell]) -> Iterator[str]:
    """Neighbours of one style and one kind."""
    first, long = run[0], len(run) * CELL_W
    if first.style.bgcolor:
        ground = _triplet(first.style.bgcolor, foreground=False).hex
        # A little higher than the row: else a seam shows between two rows.
        yield f'<rect x="{first.x:g}" y="{first.y:g}" width="{long:g}" height="{CELL_H + 0.5:g}" fill="{ground}"/>'
    match first.kind:
        case "line":
            yield from _lines(run)
        case "shape":
            yield from map(_shape, run)
        case "word":
            text = escape("".join(cell.text for cell in run))
            bold = ' font-weight="bold"' if first.style.bold else ""
            yield (
                f'<text x="{first.x:g}" y="{first.y + 16:g}" textLength="{long:g}" lengthAdjust="spacingAndGlyphs"'
                f'{bold} fill="{first.colour}">{text}</text>'
            )


def _lines(run: list[Cell]) -> Iterator[str]:
    for text, same in groupby(run, lambda cell: cell.text):
        cells = list(same)
        first, (arms, wide) = cells[0], ARMS[text]
        x, y, right = first.x + CELL_W / 2, first.y + CELL_H / 2, first.x + len(cells) * CELL_W
        ends = {"l": (first.x, y), "r": (right, y), "u": (x, first.y), "d": (x, first.y + CELL_H)}
        (x1, y1), (x2, y2) = (ends[arm] for arm in arms)
        way = f"L{x:g} {y:g} L" if wide is THICK else f"Q{x:g} {y:g} "
        path = f"M{x1:g} {y1:g} {way if arms not in ('lr', 'ud') else 'L'}{x2:g} {y2:g}"
        yield f'<path d="{path}" fill="none" stroke="{first.colour}" stroke-width="{wide:g}"/>'


def _shape(cell: Cell) -> str:
    x, y, colour = cell.x + CELL_W / 2, cell.y + CELL_H / 2, cell.colour
    half = CELL_W / 2
    diamond = f"M{x:g} {y - half:g} L{x + half:g} {y:g} L{x:g} {y + half:g} L{x - half:g} {y:g} Z"
    match cell.text:
        case "▕":
            return _block(cell, CELL_W - 1.0, 1.0)
        case "░" | "▒":
            return _block(cell, 0.0, CELL_W, SHADES[cell.text])
        case text if text in PARTS:
            # A little wider than the part: else a seam shows between two cells.
            return _block(cell, 0.0, CELL_W * (PARTS.index(text) + 1) / 8 + 0.4)
        case "●":
            return f'<circle cx="{x:g}" cy="{y:g}" r="4.5" fill="{colour}"/>'
        case "○":
            return f'<circle cx="{x:g}" cy="{y:g}" r="4" fill="none" stroke="{colour}"/>'
        case "◆" | "◈":
            return f'<path d="{diamond}" fill="{colour}"/>'
        case "◇":
            return f'<path d="{diamond}" fill="none" stroke="{colour}" stroke-width="1.5"/>'
        case _:
            return "".join(_dots(cell))


def _block(cell: Cell, left: float, wide: float, opacity: float = 1.0) -> str:
    at, size = f'x="{cell.x + left:g}" y="{cell.y + 2:g}"', f'width="{wide:g}" height="{CELL_H - 4:g}"'
    seen = f' opacity="{opacity:g}"' if opacity < 1.0 else ""
    return f'<rect {at} {size} fill="{cell.colour}"{seen}/>'


def _dots(cell: Cell) -> Iterator[str]:
    bits = ord(cell.text) - 0x2800
    for bit, (column, row) in enumerate(DOT_PLACES):
        if bits >> bit & 1:
            x, y = cell.x + CELL_W * (column + 0.5) / 2, cell.y + CELL_H * (row + 0.5) / 4
            yield f'<circle cx="{x:g}" cy="{y:g}" r="1.3" fill="{cell.colour}"/>'


def _triplet(colour: Color | None, *, foreground: bool) -> ColorTriplet:
    plain = THEME.foreground_color if foreground else THEME.background_color
    return colour.get_truecolor(THEME, foreground) if colour and not colour.is_default else plain
