"""What a rotctld may do by any bytes: a second reading, written by hand and without the program's own parser; and bytes
that nearly are requests.
"""

from __future__ import annotations

import math
import re

from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Park

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
