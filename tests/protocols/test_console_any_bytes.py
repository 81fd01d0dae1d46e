"""Any bytes at all, in any pieces, on the console: no crash, one answer to a line, and no order but what a second
reading of the same bytes finds there.

The second reading is written from docs/reference/wire.md, by hand and without the program's own parser.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable
from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Confirm, Home, Jog, LetGo, Order, Park, RelaysChecked, Release, Stop
from rotator.exchange.sources import Refusal
from rotator.protocols.console import COMMANDS, VERBS
from rotator.protocols.console_session import ConsoleSession
from tests.protocols.fed import Notebook, assert_not_kept
from tests.search import examples

WELL_FORMED = re.compile(rb"(?:(?!ok\n|error: )[^\r\n]+\n)*ok\n|error: [^\r\n]+\n")

WORDS = st.sampled_from(
    b"status stop resume home confirm relays-checked let-go park jog point help".split()
    + b"azimuth elevation cw ccw up down Stop stops".split()
)
NUMBERS = st.one_of(
    st.integers(-200, 600).map(lambda n: b"%d" % n),
    st.decimals(-10, 10, places=2).map(lambda n: str(n).encode()),
    st.sampled_from([b"12,5", b".5", b"5.", b"+5", b"1234", b"nan", b"inf", b"1e2", b"1_0", b"\xb2", b"--5"]),
)
BLANKS = st.sampled_from([b" ", b" ", b" ", b"\t", b"  ", b"\xa0", b"\0", b"\x0b"])
ENDS = st.sampled_from([b"\n", b"\n", b"\r\n", b"\r"])
LINES = st.one_of(
    st.builds(lambda *words: b" ".join(words[:-1]) + words[-1], WORDS, WORDS, NUMBERS, ENDS),
    st.builds(lambda az, el, end: b"point " + az + b" " + el + end, NUMBERS, NUMBERS, ENDS),
    st.builds(bytes.__add__, WORDS, ENDS),
)
PIECES = st.lists(st.one_of(st.binary(max_size=6), WORDS, NUMBERS, BLANKS, ENDS, LINES, LINES), max_size=30)

ANGLE = rb"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?,?"
READINGS: dict[re.Pattern[bytes], Callable[..., Order | None]] = {
    re.compile(rb"stop(?: .*)?", re.DOTALL): lambda: Stop(latch=True),
    re.compile(rb"resume"): Release,
    re.compile(rb"relays-checked (azimuth|elevation)"): RelaysChecked,
    re.compile(rb"let-go"): LetGo,
    re.compile(rb"park"): lambda: Park(storm=True),
    re.compile(rb"home (azimuth|elevation)"): lambda axis: Home(Axis(axis.decode())),
    re.compile(rb"confirm (azimuth|elevation) (" + ANGLE + rb")"): lambda axis, angle: confirm(axis, number(angle)),
    re.compile(rb"jog (cw|ccw|up|down) (\d{1,3}(?:[.,]\d{1,3})?)"): lambda way, text: jog(way, number(text)),
    re.compile(rb"point (" + ANGLE + rb") (" + ANGLE + rb")"): lambda az, el: point(number(az), number(el)),
}
WAYS = {
    b"cw": (Axis.AZIMUTH, Direction.PLUS),
    b"ccw": (Axis.AZIMUTH, Direction.MINUS),
    b"up": (Axis.ELEVATION, Direction.PLUS),
    b"down": (Axis.ELEVATION, Direction.MINUS),
}


class Latching(Notebook):
    """A stop, a park and a let-go hold until a resume."""

    def order(self, order: Order) -> Refusal | None:
        match order:
            case Stop() | Park() | LetGo():
                self.shown = replace(self.shown, latched="console")
            case Release():
                self.shown = replace(self.shown, latched="")
        return super().order(order)


def number(text: bytes) -> float:
    return float(re.sub(rb"[.,]$", b"", text).replace(b",", b"."))


def jog(way: bytes, seconds: float) -> Order | None:
    return Jog(*WAYS[way], seconds) if 0 < seconds <= 5 else None


def confirm(axis: bytes, angle: float) -> Order | None:
    low, high = (-360, 720) if axis == b"azimuth" else (-90, 210)
    return Confirm(Axis(axis.decode()), angle) if low <= angle <= high else None


def point(azimuth: float, elevation: float) -> Order | None:
    # A person who names a turn or an elevation beyond this rotor's range gets an error.
    if not (-180 <= azimuth <= 450 and 0 <= elevation <= 180):
        return None
    return Aim(azimuth + 360 if azimuth < 0 else azimuth, elevation)


def orders_in(heard: bytes) -> list[Order]:
    """Everything that the lines order, whether a stop holds or not. A damaged stop is one."""
    orders: list[Order] = []
    for raw in re.split(rb"[\r\n]", heard)[:-1]:
        line = re.sub(rb"[ \t]+", b" ", raw).strip(b" ").lower()
        for form, order in READINGS.items():
            if len(raw) <= 200 and (found := form.fullmatch(line)) and (said := order(*found.groups())) is not None:
                orders.append(said)
        word = line.split(b" ")[0].decode("utf-8", "replace")
        meant = difflib.get_close_matches(word, ["stop"], cutoff=0.7)
        if word not in (*COMMANDS, *(verb.text for verb in VERBS)) and (
            b"stop" in line or meant or word in ("s", "st", "sto")
        ):
            orders.append(Stop(latch=True))
    return orders


def held(orders: list[Order]) -> list[Order]:
    """The orders that remain when a stop, a park or a let-go holds until a resume."""
    left: list[Order] = []
    holds = False
    for order in orders:
        match order:
            case Aim() | Jog() | Home() | Park() if holds:
                continue
            case Stop() | Park() | LetGo():
                holds = True
            case Release():
                holds = False
        left.append(order)
    return left


@settings(max_examples=examples(300), deadline=None)
@given(pieces=PIECES)
def test_every_line_has_one_answer_and_orders_are_what_was_said(pieces: list[bytes]) -> None:
    box, heard = Latching(), b"".join(pieces)
    session = ConsoleSession(box)
    answers = [answer for piece in pieces for answer in session.receive(piece)]
    lines = [line for line in re.split(rb"[\r\n]", heard)[:-1] if line.strip(b" \t")]
    assert len(answers) == len(lines)
    assert all(WELL_FORMED.fullmatch(answer) for answer in answers)
    assert box.orders == held(orders_in(heard))


@settings(max_examples=examples(100), deadline=None)
@given(pieces=PIECES)
def test_pieces_make_no_difference(pieces: list[bytes]) -> None:
    torn, whole = Latching(), Latching()
    in_pieces, at_once = ConsoleSession(torn), ConsoleSession(whole)
    replies = [reply for piece in pieces for reply in in_pieces.receive(piece)]
    assert at_once.receive(b"".join(pieces)) == replies
    assert whole.orders == torn.orders


@settings(max_examples=examples(100), deadline=None)
@given(junk=st.binary(max_size=300))
def test_a_stop_is_obeyed_after_any_bytes(junk: bytes) -> None:
    box = Latching()
    session = ConsoleSession(box)
    session.receive(junk + b"\n")
    assert session.receive(b"stop\n") == [b"ok\n"]
    assert box.orders[-1] == Stop(latch=True)


def test_what_never_ends_is_not_kept() -> None:
    session = ConsoleSession(Latching())
    packet = b"stop " * 800
    assert_not_kept(session, packet)
