"""Any bytes at all, in any pieces, to a rotctld: no crash, no ill-formed answer, bounded memory, and no motion but what
a second reading of the same bytes finds there, written by hand and without the program's own parser.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Park
from rotator.protocols.rotctld_session import RotctldSession
from tests.protocols.fed import assert_not_kept, assert_well_formed
from tests.search import examples

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

WELL_FORMED = b"|".join((
    rb"RPRT (0|-\d+)\n",
    rb"(-?\d+\.\d\d\n){2}",  # p
    rb"gs232-rotator [^\n]+\n",
    rb"1\n603\n([ -~]+\n){11}done\n",  # dump_state
    rb"([A-Z_]+ )*\n",  # s
    rb"[1-4]\n|(SPEED |\(1\.\.4/1\)|)\n(RPRT 0\n)?",  # v, V ?, V SPEED ?, u ?, U ?
    rb"[a-z_]+=[\d.]+\n|([a-z_]+: \"[ -~]+\"\n\tDefault: [ -~]+\n){9}(RPRT 0\n)?",  # get_conf, dump_conf
    rb"Caps dump for model:([ -~\t]*\n)+RPRT 0\n",
    rb"([A-R]{2}([0-9]{2}[A-X]{2})*([0-9]{2})?)\n|(-?\d+(\.\d{6})?\n){1,4}",  # L, and the other sums
    rb"(?s:[a-z0-9_]+:.*RPRT (0|-\d+)\n)",  # the extended protocol
))  # fmt: skip

NUMBERS = st.one_of(
    st.integers(-200, 600).map(lambda n: b"%d" % n),
    st.sampled_from([b"12.5", b"12,5", b"nan", b"inf", b"1_0", b"1e2", b"9.", b".5", b"-1"]),
)
LETTERS = st.sampled_from(
    [bytes([letter]) for letter in b"PpSKRMVvUuXxC_sw13LlDdEeBAaQq?#\\;+|.,-\t\0\x8c\x8f\xad\xa0\xff"]
)
WORDS = st.sampled_from([
    *(b"\\set_pos", b"\\park", b"\\dump_state", b"\\move 4 1", b"M 16 50", b"M UP_LEFT -1", b"M CW", b"M 64"),
    *(b"V SPEED 3", b"v SPEED", b"V ?", b"u ?", b"R 1", b"\\get_conf ?", b"C min_az 0", b"w K", b"\\pause 9"),
    *(b"L 10 50 6", b"l JO01", b"d 12.5", b"B 0 0 10 10", b"A 30", b"a 1", b"D 1 2 3 1", b"e 4", b"W235 025"),
])  # fmt: skip
BLANKS = st.sampled_from([b" ", b"  ", b"\t"])
ENDS = st.sampled_from([b"\r", b"\n", b"\r\n"])
ALMOST = st.builds(
    lambda *parts: b"".join(parts), LETTERS, NUMBERS, BLANKS, NUMBERS, st.sampled_from([b"", b" ", b"x"])
)
PIECES = st.lists(st.one_of(st.binary(max_size=8), LETTERS, WORDS, NUMBERS, BLANKS, ENDS, ALMOST, ENDS), max_size=40)

RIGHT, LEFT = Jog(Axis.AZIMUTH, Direction.PLUS), Jog(Axis.AZIMUTH, Direction.MINUS)
UP, DOWN = Jog(Axis.ELEVATION, Direction.PLUS), Jog(Axis.ELEVATION, Direction.MINUS)
WAYS = {
    **dict.fromkeys((b"2", b"UP"), (UP,)),
    **dict.fromkeys((b"4", b"DOWN"), (DOWN,)),
    **dict.fromkeys((b"8", b"LEFT", b"CCW"), (LEFT,)),
    **dict.fromkeys((b"16", b"RIGHT", b"CW"), (RIGHT,)),
    **dict.fromkeys((b"32", b"UP_LEFT", b"UP_CCW"), (UP, LEFT)),
    **dict.fromkeys((b"64", b"UP_RIGHT", b"UP_CW"), (UP, RIGHT)),
    **dict.fromkeys((b"128", b"DOWN_LEFT", b"DOWN_CCW"), (DOWN, LEFT)),
    **dict.fromkeys((b"256", b"DOWN_RIGHT", b"DOWN_CW"), (DOWN, RIGHT)),
}


def motions_in(heard: bytes) -> list[Order]:
    """Whatever might be meant for a rotctld: P, set_pos and two numbers; M, move, a direction and a number; K, park."""
    motions: list[Order] = []
    for line in heard.replace(b"\r", b"\n").split(b"\n"):
        for head in re.finditer(rb"P|\\set_pos|K|\\park|M|\\move", line):
            words = line[head.end() :].replace(b",", b".").split()[:2]
            match head[0]:
                case b"K" | b"\\park":
                    motions.append(Park())
                case b"M" | b"\\move" if len(words) == 2 and re.fullmatch(rb"[-+]?\d+", words[1]):
                    motions += WAYS.get(words[0], ())
                case b"P" | b"\\set_pos" if len(words) == 2:
                    motions += aims(*words)
    return motions


def aims(*words: bytes) -> list[Order]:
    if not all(re.fullmatch(rb"[-+.\deE]+", word) for word in words):
        return []
    try:
        azimuth, elevation = map(float, words)
    except ValueError:
        return []
    if not (math.isfinite(azimuth) and -180 <= azimuth <= 540 and -90 <= elevation <= 180):
        return []
    return [Aim(azimuth % 360 if azimuth < 0 else azimuth, elevation)]


@settings(max_examples=examples(300), deadline=None)
@given(pieces=PIECES, silences=st.sets(st.integers(0, 40), max_size=5))
def test_nothing_crashes_and_answers_are_well_formed(
    new_box: type[BenchBox], pieces: list[bytes], silences: set[int]
) -> None:
    assert_well_formed(RotctldSession(new_box()), pieces, silences, WELL_FORMED)


@settings(max_examples=examples(300), deadline=None)
@given(pieces=PIECES)
def test_what_moves_is_what_was_said(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    box = new_box()
    session = RotctldSession(box)
    for piece in pieces:
        session.receive(piece)
    possible = iter(motions_in(b"".join(pieces)))
    assert all(motion in possible for motion in box.motions), "in this order"
    if not box.motions:
        box.wait(0.5)
        assert box.turned == set()


@settings(max_examples=examples(100), deadline=None)
@given(pieces=PIECES)
def test_pieces_make_no_difference(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    torn, whole = new_box(), new_box()
    in_pieces, at_once = RotctldSession(torn), RotctldSession(whole)
    replies = [reply for piece in pieces for reply in in_pieces.receive(piece)]
    assert at_once.receive(b"".join(pieces)) == replies
    assert whole.orders == torn.orders


@settings(max_examples=examples(100), deadline=None)
@given(junk=st.binary(max_size=80), az=st.integers(0, 450), el=st.integers(0, 180), end=ENDS)
def test_a_good_order_is_obeyed_after_any_bytes(
    new_box: type[BenchBox], junk: bytes, az: int, el: int, end: bytes
) -> None:
    box = new_box()
    session = RotctldSession(box)
    session.receive(junk.replace(b"q", b"").replace(b"Q", b"") + b"\r")
    box.orders.clear()
    assert session.receive(b"P %d %d" % (az, el) + end) == [b"RPRT 0\n"]
    assert box.orders == [Aim(az, el)]


@pytest.mark.parametrize("junk", [b"Z", b"p ", b"\0", b"P 1 ", b"+", b"w "])
def test_what_never_ends_is_not_kept(new_box: type[BenchBox], junk: bytes) -> None:
    session = RotctldSession(new_box())
    packet = (junk * 4096)[:4096]
    assert_not_kept(session, packet)
