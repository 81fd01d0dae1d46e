"""Writes a sheet and its wires as SVG. Knows the format; decides nothing."""

from __future__ import annotations

from html import escape

from docs.drawings.route import Routed
from docs.drawings.shapes import Disc, Place, Shape, Stroke, Words
from docs.drawings.sheet import WIDTH, Sheet

FONT = "DejaVu Sans, Verdana, Arial, sans-serif"


def svg(sheet: Sheet, wires: list[Routed]) -> str:
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {sheet.height}" font-family="{FONT}">',
        f"<title>{escape(sheet.title)}</title>",
        f'<rect width="{WIDTH}" height="{sheet.height}" fill="white"/>',
        '<g fill="none" stroke-linejoin="round" stroke-linecap="round">',
    ]
    for wire in wires:
        # A white edge shows that crossing wires do not touch.
        lines += [f'<polyline points="{_points(path)}" stroke="white" stroke-width="9"/>' for path in wire.paths]
        lines += [
            f'<polyline points="{_points(path)}" stroke="{wire.net.colour}" stroke-width="3"/>' for path in wire.paths
        ]
        lines += [_shape(Disc(joint, 5, wire.net.colour)) for joint in wire.joints]
    lines.append("</g>")
    lines += [_shape(shape) for part in sheet.parts.values() for shape in part.shapes]
    lines += [_shape(words) for words in sheet.words()]
    return "\n".join((*lines, "</svg>")) + "\n"


def _points(places: tuple[Place, ...]) -> str:
    return " ".join(f"{x},{y}" for x, y in places)


def _shape(shape: Shape) -> str:
    match shape:
        case Disc((x, y), radius, fill):
            return f'<circle cx="{x}" cy="{y}" r="{radius:g}" fill="{fill}" stroke="none"/>'
        case Stroke(points, width, fill, closed, colour):
            kind = "polygon" if closed else "polyline"
            return f'<{kind} points="{_points(points)}" fill="{fill}" stroke="{colour}" stroke-width="{width:g}"/>'
        case Words((x, y), text, size, anchor, bold, colour):
            # The baseline lies a third of the height below the middle: dominant-baseline is not drawn alike everywhere.
            weight = ' font-weight="bold"' if bold else ""
            where = f'x="{x}" y="{y + size * 0.35:.0f}" font-size="{size}" text-anchor="{anchor}"'
            return f'<text {where}{weight} fill="{colour}">{escape(text)}</text>'
