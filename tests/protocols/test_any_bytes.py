"""Any bytes at all, in any pieces, in GS-232 and the sketch's dialect: no crash, no ill-formed answer, bounded memory,
and no motion but what a second reading of the same bytes finds there.

The second readings below are written from the protocols' descriptions, by hand and without the program's own parsers.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, LoadTimed, Order, RunTimed
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.gs232 import INVALID, Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.session import Box, Session
from tests.protocols.fed import assert_not_kept, assert_well_formed
from tests.search import examples

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

SESSIONS: dict[str, Callable[[Box], Session]] = {
    "gs232a": lambda box: Gs232Session(box, Dialect.A),
    "gs232b": lambda box: Gs232Session(box, Dialect.B, ack=b"\r", may_calibrate=True),
    "gs232b, strict": lambda box: Gs232Session(
        box, Dialect.B, ack=b"\r", empty_line=INVALID, strict=True, may_calibrate=True
    ),
    "gs232-f1efw": F1efwSession,
}
GS232_COMMON = rb"\?>\r\n|\+\d{4}\+\d{4}\r\n|-{10} (COMMAND LIST|HELP COMMAND) \d -{10}\r\n([ -~]+\r\n)+"
GS232B_ANGLES = rb"AZ=\d{3}(  EL=\d{3})?\r\n|EL=\d{3}\r\n"
WELL_FORMED = {
    "gs232a": rb"(\+0\d{3}){1,2}\r\n|" + GS232_COMMON,
    "gs232b": rb"\r|Mode \d{3} degree\r\n|[NS] Center\r\n|" + GS232B_ANGLES + rb"|" + GS232_COMMON,
    "gs232b, strict": rb"\r|(AZ=\d{3}(  EL=\d{3})?\r\n)?are you sure\?\r\n|Completed\.\r\n|"
    + GS232B_ANGLES
    + rb"|"
    + GS232_COMMON,
    "gs232-f1efw": rb"(?!)",  # it never answers
}

NUMBERS = st.one_of(
    st.integers(0, 500).map(lambda n: b"%d" % n),
    st.integers(0, 500).map(lambda n: b"%03d" % n),
    st.sampled_from([b"-5", b"12.5", b"12,5", b"1234", b"nan", b"inf", b"1_0", b"1e2", b"010020", b"9.", b".5"]),
)
WORDS = st.sampled_from([
    *(bytes([letter]) for letter in b"RLAMTNSOFHUDEBCWXPZKpqw_#\\ .,;-\t\0\x1c\x85\xa0\xb2\xff"),
    *(b"C2", b"X4", b"P36", b"P45", b"O2", b"F2", b"H3", b"\\set_pos", b"\\park", b"\\dump_state"),
])  # fmt: skip
BLANKS = st.sampled_from([b" ", b"  ", b",", b", ", b"\t"])
ENDS = st.sampled_from([b"\r", b"\n", b"\r\n"])
ALMOST = st.builds(lambda *parts: b"".join(parts), WORDS, NUMBERS, BLANKS, NUMBERS, st.sampled_from([b"", b" ", b"x"]))
LISTS = st.builds(lambda head, numbers: head + b" ".join(numbers), WORDS, st.lists(NUMBERS, min_size=2, max_size=6))
PIECES = st.lists(st.one_of(st.binary(max_size=8), WORDS, NUMBERS, BLANKS, ENDS, ALMOST, LISTS, ENDS), max_size=40)

LETTERS = {
    b"R": Jog(Axis.AZIMUTH, Direction.PLUS),
    b"L": Jog(Axis.AZIMUTH, Direction.MINUS),
    b"U": Jog(Axis.ELEVATION, Direction.PLUS),
    b"D": Jog(Axis.ELEVATION, Direction.MINUS),
}


def decimal(word: bytes, mark: bytes) -> float | None:
    """A sign and an exponent without a sign belong only to a number with a decimal mark: `-35` may be a damaged 135."""
    base, power, exponent = word.lower().partition(b"e")
    whole, point, part = base.removeprefix(b"-").removeprefix(b"+").partition(mark)
    digits = (whole + part).isdigit() and (bool(whole) or (bool(part) and mark == b"."))
    signed = base[:1] in (b"-", b"+")
    good = digits and base.count(b"-") + base.count(b"+") == signed and (bool(point) or not signed)
    if power:
        good = good and exponent.lstrip(b"+-").isdigit() and (bool(point) or exponent[:1] in (b"-", b"+"))
    return float(base.replace(b",", b".") + (power and power + exponent)) if good else None


def either(word: bytes) -> float | None:
    return decimal(word, b"," if b"," in word else b".")


def gs232_aim(letter: bytes, text: bytes) -> list[Aim] | list[LoadTimed]:
    words = text.split(b" ")
    words = [word for word in words if word]
    if all(word.isdigit() and len(word) <= 3 for word in words) and len(words) > (2 if letter == b"W" else 1):
        step, *angles = map(float, words)
        pairs = [(az, None) for az in angles] if letter == b"M" else list(zip(angles[::2], angles[1::2], strict=False))
        paired = len(angles) > 1 and (letter == b"M" or len(angles) % 2 == 0)
        good = paired and step >= 1 and all(az <= 450 and (el or 0) <= 180 for az, el in pairs)
        return [LoadTimed(step, tuple(pairs))] if good else []
    azimuth: float | None
    elevation: float | None
    if letter == b"M":
        azimuth, elevation = (either(words[0]) if len(words) == 1 else None), 0.0
    elif len(words) == 1 and words[0].isdigit() and len(words[0]) == 6:
        azimuth, elevation = float(words[0][:3]), float(words[0][3:])
    elif len(words) == 2 and None not in map(either, words):
        azimuth, elevation = map(either, words)
    elif text.count(b",") == 1:
        azimuth, elevation = (decimal(word.strip(b" "), b".") for word in text.split(b","))
    else:
        return []
    if azimuth is None or elevation is None or azimuth > 450 or azimuth < -180 or not -90 <= elevation <= 180:
        return []
    return [Aim(azimuth % 360 if azimuth < 0 else azimuth, None if letter == b"M" else elevation)]


def gs232_within(line: bytes) -> list[Aim]:
    """A W behind something else, with all six digits at the line's end."""
    at = line.upper().rfind(b"W")
    digits = line[at + 1 :].strip(b" ").rstrip(b" ;\0")
    six = digits[:3] + digits[3:].removeprefix(b" ")
    good = at >= 0 and len(six) == 6 and six.isdigit() and digits[:3].isdigit()
    return [Aim(float(six[:3]), float(six[3:]))] if good and float(six[:3]) <= 450 and float(six[3:]) <= 180 else []


def is_stop(line: bytes) -> bool:
    """The word, or a line with an S in front: alone, or without a digit."""
    letters = re.sub(rb"^[^A-Z0-9]*", b"", line.upper())
    rest = letters[1:]
    alone = not rest or not rest[:1].isalnum()
    cut_off = re.search(rb"<S(T|TO)?(?![A-Z0-9])", line.upper()) is not None
    return b"STOP" in line.upper() or cut_off or (letters[:1] == b"S" and (alone or not re.search(rb"[0-9]", rest)))


def gs232_motions(heard: bytes, dialect: Dialect, *, strict: bool) -> list[Order]:
    """Exactly what a GS-232 is to do."""
    motions: list[Order] = []
    top_deg, listed = 450, False
    for raw in heard.replace(b"\n", b"\r").split(b"\r")[:-1]:
        line = raw.replace(b"\t", b" ").rstrip(b" ")
        while line and not 0x21 <= line[0] <= 0x7E:
            line = line[1:]
        ended = len(line)
        while line and line[-1:] in (b" ", b";", b"\0"):
            line = line[:-1]
        doubtful = len(line) < ended and not set(map(len, line[1:].split())) <= {3, 6}
        letter, rest = line[:1].upper(), line[1:]
        orders = gs232_aim(letter, rest.strip(b" ")) if letter in (b"M", b"W") and not doubtful else []
        if line and is_stop(raw):
            continue
        if not strict and not orders and len(line) > 1:
            orders = gs232_within(raw)
        if line.upper() in (b"P36", b"P45") and dialect is Dialect.B:
            top_deg = 360 if rest == b"36" else 450
        elif not rest:
            motions += [LETTERS[letter]] if letter in LETTERS else []
            motions += [RunTimed()] if letter == b"T" and listed else []
            listed = listed and letter not in b"MW"
        elif letter in (b"M", b"W") or orders:
            listed = False
            for order in orders:
                points = order.points if isinstance(order, LoadTimed) else ((order.azimuth_deg or 0.0, None),)
                if max(azimuth for azimuth, _ in points) <= top_deg:
                    listed = isinstance(order, LoadTimed)
                    motions.append(order)
    return motions


def f1efw_motions(heard: bytes) -> list[Order]:
    """Exactly what the sketch's dialect is to do; more than eight separators are none."""
    motions: list[Order] = []

    def run_of(these: bytes, at: int) -> bytes:
        end = at
        while end < len(heard) and heard[end] in these:
            end += 1
        return heard[at:end]

    for start in (at for at, byte in enumerate(heard) if byte in b"Ww"):
        begin = start + 1 + len(run_of(b" \t", start + 1))
        azimuth = run_of(b"0123456789", begin)
        six = len(azimuth) == 6
        azimuth = azimuth[:3] if six else azimuth
        gap = b"" if six else run_of(b" ,;\t", begin + len(azimuth))
        at = begin + len(azimuth) + len(gap)
        minus = heard[at : at + 1] == b"-"
        elevation = run_of(b"0123456789", at + minus)
        complete = at + minus + len(elevation) < len(heard)
        apart = six or 1 <= len(gap) <= 8
        if begin - start <= 9 and complete and 1 <= len(azimuth) <= 3 and apart and 1 <= len(elevation) <= 3:
            elevation_deg = -float(elevation) if minus else float(elevation)
            if float(azimuth) <= 450 and elevation_deg <= 180:
                motions.append(Aim(float(azimuth), elevation_deg, engaged=elevation_deg > 0))
    return motions


@pytest.mark.parametrize("protocol", SESSIONS)
@settings(max_examples=examples(200), deadline=None)
@given(pieces=PIECES, silences=st.sets(st.integers(0, 40), max_size=5))
def test_nothing_crashes_and_answers_are_well_formed(
    new_box: type[BenchBox], protocol: str, pieces: list[bytes], silences: set[int]
) -> None:
    assert_well_formed(SESSIONS[protocol](new_box()), pieces, silences, WELL_FORMED[protocol])


@pytest.mark.parametrize("protocol", SESSIONS)
@settings(max_examples=examples(200), deadline=None)
@given(pieces=PIECES)
def test_what_moves_is_what_was_said(new_box: type[BenchBox], protocol: str, pieces: list[bytes]) -> None:
    box, heard = new_box(), b"".join(pieces)
    session = SESSIONS[protocol](box)
    for piece in pieces:
        session.receive(piece)
    match protocol:
        case "gs232a" | "gs232b" | "gs232b, strict":
            dialect = Dialect.A if protocol == "gs232a" else Dialect.B
            assert box.motions == gs232_motions(heard, dialect, strict="strict" in protocol)
        case "gs232-f1efw":
            assert box.motions == f1efw_motions(heard)
    if not box.motions:
        box.wait(0.5)
        assert box.turned == set()


@pytest.mark.parametrize("protocol", SESSIONS)
@settings(max_examples=examples(100), deadline=None)
@given(pieces=PIECES)
def test_pieces_make_no_difference(new_box: type[BenchBox], protocol: str, pieces: list[bytes]) -> None:
    torn, whole = new_box(), new_box()
    in_pieces, at_once = SESSIONS[protocol](torn), SESSIONS[protocol](whole)
    replies = [reply for piece in pieces for reply in in_pieces.receive(piece)]
    assert at_once.receive(b"".join(pieces)) == replies
    assert whole.orders == torn.orders


@pytest.mark.parametrize("protocol", SESSIONS)
@settings(max_examples=examples(100), deadline=None)
@given(
    st.binary(max_size=80), st.integers(0, 450), st.integers(1, 180), st.sampled_from([b"%d %d", b"%03d %03d"]), ENDS
)
def test_a_good_order_is_obeyed_after_any_bytes(  # noqa: PLR0917
    new_box: type[BenchBox], protocol: str, junk: bytes, az: int, el: int, form: bytes, end: bytes
) -> None:
    box = new_box()
    session = SESSIONS[protocol](box)
    session.receive(junk + b"\r")
    box.orders.clear()
    session.receive(b"W" + form % (az, el) + end)
    assert box.orders == [Aim(az, el)] or (az > 360 and b"36" in junk)


@pytest.mark.parametrize("end", [b"\r", b"\n", b"\r\n"])
@pytest.mark.parametrize("line", [b"W", b"Z" * 86, b"W1x0 020", b"W200 181"])
@pytest.mark.parametrize("protocol", SESSIONS)
def test_these_move_nothing(new_box: type[BenchBox], protocol: str, line: bytes, end: bytes) -> None:
    box = new_box()
    session = SESSIONS[protocol](box)
    session.receive(line + end)
    session.idle()
    box.wait(5)
    assert box.orders == []
    assert box.turned == set()


@pytest.mark.parametrize("junk", [b"Z", b"W235 ", b"\0", b"P 1 "])
@pytest.mark.parametrize("protocol", SESSIONS)
def test_what_never_ends_is_not_kept(new_box: type[BenchBox], protocol: str, junk: bytes) -> None:
    session = SESSIONS[protocol](new_box())
    packet = (junk * 4096)[:4096]
    assert_not_kept(session, packet)
