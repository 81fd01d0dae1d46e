"""What a GS-232 and the sketch's dialect are to do by any bytes: a second reading, written from the protocols'
descriptions by hand, without the program's own parsers; and bytes that nearly are commands.
"""

from __future__ import annotations

import re

from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, LoadTimed, Order, RunTimed
from rotator.protocols.gs232 import Dialect

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
