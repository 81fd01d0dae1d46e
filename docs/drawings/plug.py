"""The face of the G-5500's EXT CONTROL socket, with what each pin is for. Knows where the pins of an 8-pin DIN sit.

Seven pins stand on a circle, 45° apart, in the order 7 3 5 2 4 1 6, as one looks into the socket with the key on top
(DIN 45326); the eighth is the middle. The plug's soldering side looks the same; its pins, from the front, are mirrored.
Which pin does what is the wiring drawing's own table.
"""

from __future__ import annotations

import math

from docs.drawings.g5500 import AZIMUTH_V, COMMON, DOWN, ELEVATION_V, LEFT, RIGHT, SUPPLY, UP
from docs.drawings.svg import FONT

FILE = "g5500-socket"
WIDTH, HEIGHT = 900, 420
CENTRE, RADIUS = (450, 205), 105
ORDER = (7, 3, 5, 2, 4, 1, 6)
"""From the upper left, down, and round to the upper right."""
USES = {
    RIGHT: ("right (clockwise)", "#2e7d32"),
    LEFT: ("left", "#00838f"),
    UP: ("up", "#795548"),
    DOWN: ("down", "#c2185b"),
    AZIMUTH_V: ("azimuth volts", "#1565c0"),
    ELEVATION_V: ("elevation volts", "#7b1fa2"),
    SUPPLY: ("supply: leave free", "#666"),
    COMMON: ("ground, common", "#222"),
}


def place(pin: int) -> tuple[float, float]:
    if pin == COMMON:
        return CENTRE
    clockwise = math.radians(315 - 45 * ORDER.index(pin))
    return CENTRE[0] + RADIUS * math.sin(clockwise), CENTRE[1] - RADIUS * math.cos(clockwise)


def plug_svg() -> str:
    x, y = CENTRE
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="{FONT}" font-size="20">',
        "<title>EXT CONTROL of a Yaesu G-5500, looking into the socket</title>",
        '<defs><radialGradient id="shell"><stop offset="0.86" stop-color="#8d949b"/><stop offset="0.93"'
        ' stop-color="#eef1f3"/><stop offset="1" stop-color="#6d747a"/></radialGradient></defs>',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<circle cx="{x}" cy="{y}" r="178" fill="url(#shell)"/>',
        f'<circle cx="{x}" cy="{y}" r="155" fill="#33373b"/>',
        f'<rect x="{x - 16}" y="{y - 160}" width="32" height="26" rx="4" fill="#c9ced2"/>',
    ]
    for pin, (use, colour) in USES.items():
        px, py = place(pin)
        if pin == COMMON:
            end_x, end_y, anchor = x + 205.0, y + 44.0, "start"
        else:
            side = 1 if px > x + 1 or pin == RIGHT else -1
            end_x, end_y, anchor = x + side * 205.0, py, "start" if side > 0 else "end"
            if pin == RIGHT:
                end_y = py + 40
            elif abs(py - y) < 1:
                end_y = py - 34 if side > 0 else py
        lead = f"M {px:.0f} {py:.0f} L {end_x - (8 if anchor == 'start' else -8):.0f} {end_y:.0f}"
        parts += [
            f'<path d="{lead}" stroke="white" stroke-width="6" fill="none"/>',
            f'<path d="{lead}" stroke="{colour}" stroke-width="4" fill="none"/>',
            f'<text x="{end_x:.0f}" y="{end_y + 7:.0f}" text-anchor="{anchor}" fill="{colour}">{use}</text>',
        ]
    for pin in USES:
        px, py = place(pin)
        parts += [
            f'<circle cx="{px:.0f}" cy="{py:.0f}" r="19" fill="#f4f1e6" stroke="#c8b56a" stroke-width="4"/>',
            f'<text x="{px:.0f}" y="{py + 7:.0f}" text-anchor="middle" font-weight="bold" fill="#222">{pin}</text>',
        ]
    said = "Looking into the socket, key on top. The soldering side of your plug looks the same."
    parts.append(f'<text x="{x}" y="{HEIGHT - 8}" text-anchor="middle" fill="#222">{said}</text>')
    return "\n".join((*parts, "</svg>")) + "\n"
