"""The picture at the head of the README: a PC, the Pi and its relays on a table, the rotor and its antennas outside.

Knows where things stand in the picture, and paints from back to front. The shapes come from `solid`. Nothing here is
measured: the wiring pictures show which wire goes where.
"""

from __future__ import annotations

import math

from docs.drawings.solid import Colour, Point, box, cable, flat, polygon, seen, shadow, tube, upright

FILE = "scene"
WIDTH, HEIGHT = 1200, 600
TABLE_TOP = 392
"""Where the table meets the view."""
BOARD = Colour(34, 120, 66)
RELAY_BOARD = Colour(30, 62, 120)
RELAY = Colour(58, 112, 210)
SILVER = Colour(190, 195, 200)
BLACK = Colour(44, 46, 50)
GOLD = Colour(210, 168, 70)
CASE = Colour(128, 134, 142)
METAL = Colour(168, 174, 180)
CAST = Colour(142, 150, 156)
CABLE = Colour(58, 60, 66)
MAST_X, ROTOR_Y = 926, 268
SATELLITE = (560, 66)
RELAYS_AT: Point = (725.0, 486.0)

_GRADIENTS = """\
<defs>
<linearGradient id="sky" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-color="#1d4472"/>\
<stop offset="0.55" stop-color="#6d9cc4"/><stop offset="1" stop-color="#f6d9ae"/></linearGradient>
<linearGradient id="hill" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-color="#5d7f74"/>\
<stop offset="1" stop-color="#33524a"/></linearGradient>
<linearGradient id="near" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-color="#3e5f45"/>\
<stop offset="1" stop-color="#1f3425"/></linearGradient>
<linearGradient id="wood" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-color="#b98654"/>\
<stop offset="1" stop-color="#7c4f2a"/></linearGradient>
<linearGradient id="round" x1="0" y1="0" x2="1" y2="0"><stop offset="0" stop-color="#6f767c"/>\
<stop offset="0.3" stop-color="#dfe4e8"/><stop offset="0.6" stop-color="#a2a9af"/>\
<stop offset="1" stop-color="#4d5358"/></linearGradient>
<linearGradient id="screen" x1="0" y1="0" x2="1" y2="1"><stop offset="0" stop-color="#12303f"/>\
<stop offset="1" stop-color="#07161f"/></linearGradient>
<radialGradient id="sun"><stop offset="0" stop-color="#fff6dd"/>\
<stop offset="1" stop-color="#fff0c8" stop-opacity="0"/></radialGradient>
</defs>"""


def scene_svg() -> str:
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="DejaVu Sans, Verdana,'
        ' Arial, sans-serif">'
    )
    parts = [head, "<title>A PC, the Raspberry Pi and its relays on a table; the rotor on its mast outside</title>"]
    parts += [_GRADIENTS, *_outside(), *_rotor(), *_table(), *_laptop(), *_pi(), *_relays(), *_cables(), *_names()]
    return "\n".join((*parts, "</svg>")) + "\n"


def _outside() -> list[str]:
    x, y = SATELLITE
    return [
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="url(#sky)"/>',
        '<circle cx="300" cy="380" r="260" fill="url(#sun)"/>',
        '<path d="M 170 330 Q 520 -60 978 40" fill="none" stroke="white" stroke-opacity="0.55" stroke-width="2"'
        ' stroke-dasharray="3 9"/>',
        f'<g transform="translate({x} {y}) rotate(-14)">',
        '<rect x="-46" y="-9" width="34" height="18" fill="#22406e" stroke="#9db7dd"/>',
        '<rect x="12" y="-9" width="34" height="18" fill="#22406e" stroke="#9db7dd"/>',
        '<line x1="-12" x2="12" y1="0" y2="0" stroke="#ddd" stroke-width="3"/>',
        '<rect x="-10" y="-12" width="20" height="24" rx="3" fill="url(#round)"/></g>',
        '<path d="M 0 330 Q 160 270 330 318 T 700 300 T 1000 322 T 1200 290 V 420 H 0 Z" fill="url(#hill)"/>',
        '<path d="M 0 372 Q 240 336 470 366 T 900 356 T 1200 366 V 430 H 0 Z" fill="url(#near)"/>',
    ]


def _rotor() -> list[str]:
    """The mast, the azimuth rotor, the elevation rotor with its cross boom, and two crossed Yagis."""
    x, y = MAST_X, ROTOR_Y
    away: Point = (-0.60, -0.64)
    """The way the antennas look on the picture: up, and towards the satellite."""
    left, right = (x - 112.0, y - 121.0), (x + 112.0, y - 152.0)
    parts = [
        f'<rect x="{x - 9}" y="{y + 40}" width="18" height="{TABLE_TOP - y}" fill="url(#round)"/>',
        *_yagi(right, away),
        f'<path d="M {x - 34} {y + 44} L {x - 40} {y - 8} Q {x - 40} {y - 40} {x} {y - 42} Q {x + 40} {y - 40}'
        f' {x + 40} {y - 8} L {x + 34} {y + 44} Q {x} {y + 58} {x - 34} {y + 44} Z" fill="url(#round)"/>',
        f'<ellipse cx="{x}" cy="{y - 12}" rx="40" ry="9" fill="none" stroke="#555b60" stroke-width="2"/>',
        f'<rect x="{x - 11}" y="{y - 84}" width="22" height="48" fill="url(#round)"/>',
        *tube(left, right, 13, METAL),
        f'<rect x="{x - 40}" y="{y - 172}" width="80" height="94" rx="14" fill="url(#round)"/>',
        f'<rect x="{x - 40}" y="{y - 172}" width="80" height="94" rx="14" fill="none" stroke="#555b60"/>',
        f'<ellipse cx="{x}" cy="{y - 138}" rx="21" ry="21" fill="{CAST.lit(0.9)}" stroke="#5b6166" stroke-width="3"/>',
        f'<circle cx="{x}" cy="{y - 138}" r="8" fill="#5b6166"/>',
        *tube((x - 40, y - 133), left, 13, METAL),
        *_yagi(left, away),
    ]
    for dx, dy in ((-30, -164), (30, -164), (-30, -86), (30, -86), (-26, 30), (26, 30)):
        parts.append(f'<circle cx="{x + dx}" cy="{y + dy}" r="4" fill="#5b6166"/>')
    return parts


def _yagi(middle: Point, away: Point) -> list[str]:
    """A boom with crossed elements: those behind it first, the boom, those before it."""
    behind: list[str] = []
    before: list[str] = []
    along = [-1.0, -0.72, -0.45, -0.12, 0.22, 0.56, 0.9]
    for place, share in enumerate(along):
        x, y = middle[0] + away[0] * 132 * share, middle[1] + away[1] * 132 * share
        half = 54 - 4 * place
        for tilt_deg, bars in ((-8, behind), (104, before)):
            dx, dy = half * math.cos(math.radians(tilt_deg)), half * math.sin(math.radians(tilt_deg)) * 0.8
            bars.extend(tube((x - dx, y - dy), (x + dx, y + dy), 4, METAL))
    ends = [(middle[0] + away[0] * 142 * share, middle[1] + away[1] * 142 * share) for share in (-1.0, 1.0)]
    return [*behind, *tube(ends[0], ends[1], 8, METAL), *before]


def _table() -> list[str]:
    parts = [f'<rect y="{TABLE_TOP}" width="{WIDTH}" height="{HEIGHT - TABLE_TOP}" fill="url(#wood)"/>']
    for row in range(7):
        y = TABLE_TOP + 8 + row * row * 3.2 + row * 9
        bow = f"M 0 {y:.0f} Q 400 {y + 5:.0f} 760 {y - 2:.0f} T 1200 {y + 3:.0f}"
        parts.append(f'<path d="{bow}" fill="none" stroke="#5f3a1c" stroke-opacity="0.28" stroke-width="2"/>')
    parts.append(f'<rect y="{TABLE_TOP}" width="{WIDTH}" height="4" fill="#e2b98a" opacity="0.7"/>')
    return parts


def _laptop() -> list[str]:
    origin = (36.0, 470.0)
    lean = 0.12
    parts = [shadow(origin, (0, 0, 0), (330, 150, 0)), *box(origin, (0, 0, 0), (330, 150, 9), CASE)]
    for row in range(4):
        for key in range(13):
            parts += [polygon([seen(origin, (24 + key * 22 + a, 62 + row * 18 + b, 9)) for a, b in _KEY], "#2f3338")]
    parts.append(polygon([seen(origin, (118 + a * 5, 12 + b * 2.6, 9)) for a, b in _KEY], "#767d86"))
    # The lid stands at the back edge; its drawing begins at its upper left corner.
    high = 206
    parts += [
        f'<g transform="{upright(origin, (0, 150, 9), high, lean)}">',
        f'<rect x="0" y="0" width="330" height="{high}" rx="9" fill="#3a3f45"/>',
        f'<rect x="10" y="10" width="310" height="{high - 22}" fill="url(#screen)"/>',
        *_tracking(),
        "</g>",
    ]
    return parts


_KEY = ((0, 0), (18, 0), (18, 14), (0, 14))


def _tracking() -> list[str]:
    """What the PC shows: a polar plot with a pass, and the angles."""
    ring = 'fill="none" stroke="#2f7f8f"'
    return [
        *(f'<circle cx="106" cy="101" r="{radius}" {ring}/>' for radius in (26, 52, 78)),
        '<path d="M 28 101 H 184 M 106 23 V 179" stroke="#2f7f8f"/>',
        '<path d="M 60 164 Q 84 70 172 60" fill="none" stroke="#ffd24a" stroke-width="3"/>',
        '<circle cx="96" cy="99" r="6" fill="#ff6a4d"/>',
        *(
            f'<text x="200" y="{y}" font-size="{size}" fill="{colour}" font-family="monospace">{words}</text>'
            for y, size, colour, words in (
                (48, 17, "#bfe9ef", "ISS"),
                (84, 20, "#ffffff", "AZ 235.0°"),
                (114, 20, "#ffffff", "EL  25.0°"),
                (152, 15, "#7fd08a", "tracking"),
            )
        ),
    ]


def _pi() -> list[str]:
    o = (455.0, 500.0)
    parts = [shadow(o, (0, 0, 0), (170, 112, 0)), *box(o, (0, 0, 8), (170, 112, 5), BOARD)]
    parts += box(o, (8, 96, 13), (112, 12, 5), BLACK)
    for column in range(20):
        for row in (97, 103):
            parts += box(o, (10 + column * 5.5, row, 18), (1.6, 1.6, 7), GOLD)
    parts += [*box(o, (52, 40, 13), (34, 34, 4), SILVER), *box(o, (96, 46, 13), (24, 24, 3), BLACK)]
    parts += [*box(o, (134, 74, 13), (38, 30, 22), SILVER), *box(o, (134, 38, 13), (38, 30, 22), SILVER)]
    parts += [*box(o, (130, 4, 13), (42, 28, 20), SILVER), *box(o, (16, -3, 11), (18, 12, 6), SILVER)]
    parts += [*box(o, (52, -2, 11), (16, 10, 6), SILVER), *box(o, (10, 20, 13), (10, 14, 3), BLACK)]
    parts.append(f'<circle cx="{seen(o, (10, 6, 13))[0]}" cy="{seen(o, (10, 6, 13))[1]}" r="3" fill="#ff4030"/>')
    parts.append(f'<g transform="{flat(o, (46, 20, 13))}"><text font-size="12" fill="#d7f0dc">Raspberry Pi</text></g>')
    return parts


def _relays() -> list[str]:
    o = RELAYS_AT
    parts = [shadow(o, (0, 0, 0), (180, 96, 0)), *box(o, (0, 0, 7), (180, 96, 5), RELAY_BOARD)]
    for relay in range(4):
        parts += box(o, (10 + relay * 43, 66, 12), (30, 22, 12), Colour(40, 140, 90))
    for relay in range(4):
        parts += box(o, (8 + relay * 43, 24, 12), (34, 34, 32), RELAY)
    for relay in range(4):
        lit = "#ff5a48" if relay == 0 else "#5b2a26"
        x, y = seen(o, (24 + relay * 43, 10, 12))
        parts.append(f'<circle cx="{x}" cy="{y}" r="4" fill="{lit}"/>')
    return parts


def _cables() -> list[str]:
    """PC to Pi by USB; a ribbon from the header to the relays; the rotor's cable over the edge of the table."""
    parts = cable("M 346 552 C 392 596, 474 580, 481 497", 7, CABLE)
    for wire, colour in enumerate(
        (Colour(200, 60, 50), Colour(225, 190, 60), Colour(60, 150, 80), Colour(70, 110, 200))
    ):
        x, y = 588 + wire * 9, 457 + wire * 2
        inputs = seen(RELAYS_AT, (6 + wire * 9, 4, 14))
        parts += cable(
            f"M {x} {y} C {x + 40} {y - 46}, {inputs[0] - 60} {inputs[1] - 60}, {inputs[0]} {inputs[1]}", 4, colour
        )
    parts += cable(f"M 906 468 C 960 440, {MAST_X + 6} 440, {MAST_X + 6} {TABLE_TOP + 2}", 8, CABLE)
    parts += cable(f"M {MAST_X + 12} {TABLE_TOP} L {MAST_X + 12} {ROTOR_Y + 46}", 5, CABLE)[1:]
    return parts


def _names() -> list[str]:
    """Each name with a dark edge of its own below it, so that every viewer shows it."""
    named = (
        (190, 592, "your tracking program"),
        (545, 592, "Raspberry Pi: a Yaesu GS-232 to the PC"),
        (845, 592, "four relays"),
        (1046, 250, "the rotor"),
    )
    edge = 'fill="none" stroke="#1a120b" stroke-opacity="0.75" stroke-width="4" stroke-linejoin="round"'
    return [
        f'<text x="{x}" y="{y}" font-size="19" text-anchor="middle" {paint}>{words}</text>'
        for x, y, words in named
        for paint in (edge, 'fill="white"')
    ]
