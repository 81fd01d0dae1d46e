"""The parts on a sheet: boxes with named pins, and the usual symbols. Knows how each looks and where its pins are.

Knows no wire and no value that matters: what a label says is the drawing's business.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from docs.drawings.header import GPIO_PINS, RAILS
from docs.drawings.shapes import LARGE, PLAIN, SMALL, Anchor, Box, Disc, Place, Shape, Stroke, Words, rectangle

PITCH = 30
HALF = 30
"""Half the length of a symbol with two ends."""
UP, DOWN, LEFT, RIGHT = (0, -1), (0, 1), (-1, 0), (1, 0)
FAINT = "#999"


@dataclass(frozen=True, slots=True)
class Pin:
    at: Place
    out: Place
    """Which way a wire leaves."""


@dataclass(frozen=True, slots=True)
class Part:
    name: str
    body: Box
    """No wire goes through it."""
    pins: Mapping[str, Pin]
    shapes: tuple[Shape, ...]
    labels: tuple[Words, ...] = ()
    """Words outside the body; no wire goes through them either."""


def chip(  # noqa: PLR0917 - a box is a name, a place and two rows of pins
    name: str,
    title: str,
    at: Place,
    width: int,
    left: Sequence[str] = (),
    right: Sequence[str] = (),
    lines: Sequence[str] = (),
) -> Part:
    """A box with pins down its sides; an empty name leaves a gap. `lines` stand below the title."""
    x, y = at
    first = y + 20 * (len(lines) + 1) + 30
    rows = max(len(left), len(right))
    body = Box(x, y, x + width, first + PITCH * max(rows - 1, 0) + 20)
    middle = x + width // 2
    shapes: list[Shape] = [rectangle(body, "#f6f6f2"), Words((middle, y + 20), title, LARGE - 2, "middle", bold=True)]
    shapes += [Words((middle, y + 42 + 20 * row), line, SMALL, "middle") for row, line in enumerate(lines)]
    pins = {}
    sides: tuple[tuple[Sequence[str], int, Place, Anchor, int], ...] = (
        (left, body.left, LEFT, "start", 8),
        (right, body.right, RIGHT, "end", -8),
    )
    for names, edge, out, anchor, inwards in sides:
        for row, pin in enumerate(names):
            if pin:
                place = (edge, first + PITCH * row)
                pins[pin] = Pin(place, out)
                shapes.append(Words((edge + inwards, place[1]), pin, PLAIN, anchor))
    return Part(name, body, pins, tuple(shapes))


def pi_header(at: Place, used: Mapping[int, str], name: str = "pi", rows: tuple[int, int] = (1, 20)) -> Part:
    """The Pi's 40-pin header, or some rows of it; `used` says what stands beside a pin number."""
    width, (x, y) = 240, at
    first = y + 80
    body = Box(x, y, x + width, first + PITCH * (rows[1] - rows[0]) + 25)
    middle = x + width // 2
    shapes: list[Shape] = [
        rectangle(body, "#eef5ea"),
        Words((middle, y + 20), "Raspberry Pi", LARGE - 2, "middle", bold=True),
        Words((middle, y + 44), "40-pin header", SMALL - 1, "middle"),
    ]
    pins = {}
    for number in range(2 * rows[0] - 1, 2 * rows[1] + 1):
        odd = number % 2 == 1
        height = first + PITCH * ((number - 1) // 2 - rows[0] + 1)
        ink = "#222" if number in used else FAINT
        spot = (middle - 16 if odd else middle + 16, height)
        shapes.append(Disc(spot, 13, "#dfe8d8" if number in used else "#f4f8f1"))
        shapes.append(Words(spot, str(number), SMALL - 2, "middle", colour=ink))
        if number in used:
            edge = body.left if odd else body.right
            pins[str(number)] = Pin((edge, height), LEFT if odd else RIGHT)
            inwards = 8 if odd else -8
            shapes.append(Words((edge + inwards, height), used[number], PLAIN, "start" if odd else "end"))
    return Part(name, body, pins, tuple(shapes))


def header_labels(gpios: Sequence[int], rails: Sequence[int]) -> dict[int, str]:
    """What stands beside each used pin of the header."""
    return {GPIO_PINS[gpio]: f"GPIO {gpio}" for gpio in gpios} | {pin: RAILS[pin] for pin in rails}


def _two_ended(name: str, label: str, at: Place, shapes: Sequence[Stroke], *, flat: bool, side: int) -> Part:
    """A symbol drawn upright about (0, 0), its ends at ∓HALF; `at` is its upper or left end."""
    x, y = at

    def put(point: Place) -> Place:
        return (x + HALF + point[1], y + point[0]) if flat else (x + point[0], y + HALF + point[1])

    drawn = tuple(Stroke(tuple(map(put, s.points)), s.width, s.fill, s.closed) for s in shapes)
    body = Box(x, y - 10, x + 2 * HALF, y + 10) if flat else Box(x - 10, y, x + 10, y + 2 * HALF)
    pins = {"a": Pin(at, LEFT if flat else UP), "b": Pin(put((0, HALF)), RIGHT if flat else DOWN)}
    texts = label.split("\n")
    if flat:
        first = y - 24 - 20 * (len(texts) - 1) if side < 0 else y + 24
        labels = [Words((x + HALF, first + 20 * row), text, SMALL, "middle") for row, text in enumerate(texts)]
    else:
        first = y + HALF - 10 * (len(texts) - 1)
        anchor: Anchor = "start" if side > 0 else "end"
        labels = [Words((x + 18 * side, first + 20 * row), text, SMALL, anchor) for row, text in enumerate(texts)]
    return Part(name, body, pins, drawn, tuple(labels) if label else ())


def resistor(name: str, label: str, at: Place, flat: bool = False, side: int = 1) -> Part:
    body = rectangle(Box(-8, -18, 8, 18))
    return _two_ended(name, label, at, (_lead(-30, -18), _lead(18, 30), body), flat=flat, side=side)


def fuse(name: str, label: str, at: Place, flat: bool = False, side: int = 1) -> Part:
    return _two_ended(name, label, at, (rectangle(Box(-8, -18, 8, 18)), _lead(-30, 30)), flat=flat, side=side)


def capacitor(name: str, label: str, at: Place, flat: bool = False, side: int = 1) -> Part:
    plates = (Stroke(((-14, -4), (14, -4)), 4), Stroke(((-14, 4), (14, 4)), 4))
    return _two_ended(name, label, at, (_lead(-30, -4), _lead(4, 30), *plates), flat=flat, side=side)


def diode(name: str, label: str, at: Place, flat: bool = False, side: int = 1) -> Part:
    """Pin a is the cathode, the end with the ring."""
    triangle = Stroke(((-10, 10), (10, 10), (0, -8)), 2.5, "white", closed=True)
    return _two_ended(
        name,
        label,
        at,
        (_lead(-30, -8), _lead(10, 30), triangle, Stroke(((-10, -8), (10, -8)), 4)),
        flat=flat,
        side=side,
    )


def contact(name: str, label: str, at: Place, flat: bool = False, side: int = 1) -> Part:
    """A make contact of a relay, open."""
    return _two_ended(
        name, label, at, (_lead(-30, -12), _lead(14, 30), Stroke(((0, 14), (-10, -12)), 3)), flat=flat, side=side
    )


def _lead(top: int, bottom: int) -> Stroke:
    return Stroke(((0, top), (0, bottom)))


def pot(name: str, label: str, at: Place) -> Part:
    """Upright, wiper to the right: pins high, wiper, low. The label stands to the left."""
    x, y = at
    body = Box(x - 10, y, x + 20, y + 80)
    shapes = (
        Stroke(((x, y), (x, y + 16))),
        Stroke(((x, y + 64), (x, y + 80))),
        rectangle(Box(x - 9, y + 16, x + 9, y + 64)),
        Stroke(((x + 20, y + 40), (x + 11, y + 35), (x + 11, y + 45)), fill="#222", closed=True),
    )
    texts = label.split("\n")
    first = y + 40 - 10 * (len(texts) - 1)
    labels = tuple(Words((x - 18, first + 20 * row), text, SMALL, "end") for row, text in enumerate(texts))
    pins = {"high": Pin(at, UP), "low": Pin((x, y + 80), DOWN), "wiper": Pin((x + 20, y + 40), RIGHT)}
    return Part(name, body, pins, shapes, labels)


def npn(name: str, label: str, at: Place) -> Part:
    """A transistor with its base at the left (`at`), collector up, emitter down; the label to the right."""
    x, y = at
    shapes = (
        Stroke(((x, y), (x + 20, y))),
        Stroke(((x + 20, y - 18), (x + 20, y + 18)), 4),
        Stroke(((x + 20, y - 8), (x + 40, y - 22), (x + 40, y - 30))),
        Stroke(((x + 20, y + 8), (x + 40, y + 22), (x + 40, y + 30))),
        Stroke(((x + 37, y + 20), (x + 26, y + 19), (x + 32, y + 10)), fill="#222", closed=True),
    )
    pins = {
        "base": Pin(at, LEFT),
        "collector": Pin((x + 40, y - 30), UP),
        "emitter": Pin((x + 40, y + 30), DOWN),
    }
    return Part(name, Box(x, y - 30, x + 50, y + 30), pins, shapes, (Words((x + 56, y), label, SMALL),))


def ground(name: str, at: Pin) -> Part:
    """The ground symbol on a pin of another part."""
    (x, y), (dx, dy) = at.at, at.out
    stem = (x + 20 * dx, y + 20 * dy)
    bars = [
        Stroke(
            (
                (stem[0] + 6 * step * dx - half * dy, stem[1] + 6 * step * dy - half * dx),
                (stem[0] + 6 * step * dx + half * dy, stem[1] + 6 * step * dy + half * dx),
            ),
            3,
        )
        for step, half in enumerate((14, 9, 4))
    ]
    return Part(name, _reach(at, 36, 16), {}, (Stroke((at.at, stem)), *bars))


def earth(name: str, at: Place) -> Part:
    """A ground symbol that a wire comes to, from above: pin top."""
    symbol = ground(name, Pin(at, DOWN))
    return Part(name, symbol.body, {"top": Pin(at, UP)}, symbol.shapes)


def rail(name: str, at: Pin, text: str, colour: str) -> Part:
    """A supply, named, on a pin of another part."""
    (x, y), (dx, dy) = at.at, at.out
    width = Words((0, 0), text, SMALL, "middle", bold=True).box
    half = (width.right - width.left) // 2 + 4
    reach = 16 + (half if dx else 14)
    centre = (x + reach * dx, y + reach * dy)
    flag = Box(centre[0] - half, centre[1] - 13, centre[0] + half, centre[1] + 13)
    body = _reach(at, 16 + 2 * (half if dx else 14), half if dy else 14)
    shapes = (
        Stroke((at.at, (x + 16 * dx, y + 16 * dy)), 3, colour=colour),
        rectangle(flag, "white", colour=colour),
        Words(centre, text, SMALL, "middle", bold=True, colour=colour),
    )
    return Part(name, body, {}, shapes)


def tap(name: str, at: Place, text: str, colour: str) -> Part:
    """A supply that a wire comes to, from below: pin bottom."""
    symbol = rail(name, Pin(at, UP), text, colour)
    return Part(name, symbol.body, {"bottom": Pin(at, DOWN)}, symbol.shapes)


def _reach(at: Pin, length: int, half: int) -> Box:
    (x, y), (dx, dy) = at.at, at.out
    ends = [
        (x - half * abs(dy), y - half * abs(dx)),
        (x + length * dx + half * abs(dy), y + length * dy + half * abs(dx)),
    ]
    xs, ys = zip(*ends, strict=True)
    return Box(min(xs), min(ys), max(xs), max(ys))
