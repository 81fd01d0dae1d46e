"""What controllers of EasyComm, SPID and Hy-Gain are to do by any bytes: a second reading, written from the protocols'
descriptions by hand, without the program's own parsers; and bytes that nearly are commands.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Park

_EASYCOMM = rb"AZ-?\d+\.\d( EL-?\d+\.\d)?\n|EL-?\d+\.\d\n|"
WELL_FORMED = {
    "easycomm1": _EASYCOMM[:-1],
    "easycomm2": _EASYCOMM + rb"\+\d+\.\d -?\d+\.\d\n|AL[ -~]+\n|VE[ -~]+\n",
    "easycomm3": _EASYCOMM + rb"AL[ -~]+\n|VE[ -~]+\n|G[SE]\d+\n",
    "rot1prog": rb"W[\0-\x09]{3} ",
    "rot2prog": rb"W[\0-\x09]{4}\x02[\0-\x09]{4}\x02 ",
    "md01": rb"W[\0-\x09]{4}\x0a[\0-\x09]{4}\x0a ",
    "dcu1": rb";\d{3}|[ \d]\d?\d\.\d;",
    "rc2800": rb"[AE] (P= *\d+\.\d S=9 [MS]|ERR=05)\r",
    "prosistel": rb"\x02[AEB],[G?S],(R|E,00003|\d{3,4},[RB])\r",
}

NUMBERS = st.one_of(
    st.integers(-200, 600).map(lambda n: b"%d" % n),
    st.decimals(-200, 600, places=1).map(lambda n: str(n).encode()),
    st.sampled_from([b"", b"-", b"12,5", b".5", b"9.", b"1234", b"nan", b"1e2", b"000", b"005.5", b"1_0", b"\xb2"]),
)
WORDS = st.builds(
    bytes.__add__,
    st.sampled_from(
        [
            *b"AZ EL AZ EL AZ EL SA SE ML MR MU MD VE VL VR VU VD GS GE PARK RESET UP DN X az el".split(),
            *b"AP1 AP1 AM1 AI1 BI1 AS1".split(),
        ]
    ),
    NUMBERS,
)
FRAMES = st.builds(
    lambda azimuth, ph, elevation, pv, command, end: b"W" + azimuth + ph + elevation + pv + command + end,
    st.one_of(st.integers(0, 9999).map(lambda n: b"%04d" % n), st.binary(min_size=4, max_size=4)),
    st.binary(min_size=1, max_size=1),
    st.one_of(st.integers(0, 9999).map(lambda n: b"%04d" % n), st.sampled_from([b"\0\0\0\0", b"WWWW"])),
    st.binary(min_size=1, max_size=1),
    st.sampled_from([b"\x0f", b"\x1f", b"\x2f", b"\x2f", b"\x2f", b"\x14", b"\x3f"]),
    st.sampled_from([b" ", b" ", b" ", b"", b"!"]),
)
GAPS = st.sampled_from([b" ", b" ", b"\n", b"\r", b"\r\n", b";", b";", b"\r;", b"\t", b"\xff", b"\0"])
PIECES = st.lists(st.one_of(st.binary(max_size=6), WORDS, WORDS, FRAMES, GAPS, GAPS, GAPS), max_size=40)

TURNS = {
    b"L": Jog(Axis.AZIMUTH, Direction.MINUS),
    b"R": Jog(Axis.AZIMUTH, Direction.PLUS),
    b"U": Jog(Axis.ELEVATION, Direction.PLUS),
    b"D": Jog(Axis.ELEVATION, Direction.MINUS),
}


def direction(azimuth: float | None, elevation: float | None) -> Iterator[Order]:
    if (azimuth is None or -180 <= azimuth <= 540) and (elevation is None or -90 <= elevation <= 180):
        yield Aim(azimuth if azimuth is None or azimuth >= 0 else azimuth + 360, elevation)


def easycomm_motions(heard: bytes, level: int) -> list[Order]:
    """Whatever might be meant: in each line every angle, every pair, every turn and every park, in order.

    A single angle, a turn and a park stand between blanks. Of a pair each may be joined to anything but a letter before
    it, and with another order between them the two are orders of their own.
    """
    motions: list[Order] = []
    for line in re.split(rb"[\r\n]", heard.upper())[:-1]:
        azimuths, elevations = angles(b"AZ", line), angles(b"EL", line)
        both = [(azimuth, elevation) for azimuth in azimuths for elevation in elevations]
        apart = [each for azimuth, elevation in both for each in ((azimuth, None), (None, elevation))]
        pairs = [aim for pair in both + apart for aim in direction(*pair)]
        for word in re.split(rb"[ ;\t]", line):
            bare = word.lstrip(bytes(range(0x20)) + bytes(range(0x7F, 0x100)))
            try:
                number = float(bare[2:].replace(b",", b"."))
            except ValueError:
                number = None
            if number is not None and bare[:2] == b"AZ":
                motions += direction(number, None)
            if number is not None and bare[:2] == b"EL":
                motions += direction(None, number)
            if level >= 2 and bare[:1] == b"M" and len(bare) == 2 and bare[1:] in TURNS:
                motions.append(TURNS[bare[1:]])
            if level >= 3 and bare[:1] == b"V" and bare[1:2] in TURNS and number:
                motions.append(TURNS[bare[1:2]])
            if level >= 2 and bare == b"PARK":
                motions.append(Park())
            motions += [aim for azimuth in azimuths for aim in direction(azimuth, None)]
            motions += [aim for elevation in elevations for aim in direction(None, elevation)]
            motions += pairs
    return motions


def angles(name: bytes, line: bytes) -> list[float]:
    """The numbers behind this name, wherever it is not the end of a word."""
    numbers = re.findall(rb"(?<![A-Z])" + name + rb" *([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:E[-+]?\d+)?)", line)
    return [float(number.replace(b",", b".")) for number in numbers]


def spid_motions(heard: bytes, protocol: str) -> list[Order]:
    """Exactly what a SPID controller is to do."""
    # A stop may have another last byte, or nothing but zeros and a command byte of lower bits.
    stands = rb".{10}(?:\x0f.|\x1f )|\0{10}[\0-\x0f] "
    moves = rb"|(?P<turn>[\x01\x02\x04\x05\x06\x08\x09\x0a]).{9}\x14 " if protocol == "md01" else b""
    elevation = rb".{6}" if protocol == "rot1prog" else rb".(?P<el>\d{4})."
    motions: list[Order] = []
    for frame in re.finditer(rb"W(?:(?P<az>\d{4})" + elevation + rb"/ |" + stands + moves + rb")", heard, re.DOTALL):
        found = frame.groupdict()
        if found["az"] and protocol == "rot1prog":
            motions += direction(int(found["az"]) // 10 - 360, None)
        elif found["az"]:
            pulses = 2 if protocol == "rot2prog" else 10
            motions += direction(int(found["az"]) / pulses - 360, int(found["el"]) / pulses - 360)
        elif found.get("turn"):
            turn = found["turn"][0]
            motions += [jog for bit, jog in zip((1, 2, 4, 8), TURNS.values(), strict=True) if turn & bit]
    return motions


def dcu1_motions(heard: bytes) -> list[Order]:
    """Exactly what a DCU-1 is to do."""
    motions: list[Order] = []
    target: float | None = None
    for command in re.finditer(rb"([^;\r]*)([;\r])", re.sub(rb"(\.[^;\r]*\r);", rb"\1", heard)):
        text = command[1].lstrip(bytes(range(0x21)) + bytes(range(0x7F, 0x100)))
        good = re.fullmatch(rb"AP1(\d\d\d)(\.\d*)?", text)
        if text.startswith(b"AP"):
            target = None
        if good and float(text[3:]) <= 360:
            target = float(text[3:])
        if target is not None and ((good and float(text[3:]) <= 360 and command[2] == b"\r") or text == b"AM1"):
            motions.append(Aim(target, None))
        stops = re.match(rb"AS|[^A-Z0-9]*S([^A-Z0-9]|[^0-9]*$)", text.upper()) or b"STOP" in text.upper()
        if stops or (not text and command[2] == b";"):
            target = None
    return motions


RC2800_PIECES = st.lists(
    st.one_of(
        st.binary(max_size=5),
        st.sampled_from([b"A", b"E", b"S", b"75", b"75.5", b"10", b"\r", b"\r", b"\n", b"A20\r", b"E20.000000\r"]),
    ),
    max_size=16,
)
PROSISTEL_PIECES = st.lists(
    st.one_of(
        st.binary(max_size=5),
        st.sampled_from([b"\x02A", b"\x02E", b"\x02B", b"G75", b"G999", b"?", b"S", b"\r", b"\r", b"\x02AG10\r"]),
    ),
    max_size=16,
)


def rc2800_motions(heard: bytes) -> list[Order]:
    """Every whole line with an angle."""
    found = re.findall(rb"(?:^|[\r\n])[^!-~]*([AE])(\d{1,3}(?:\.\d{0,6})?)(?=[\r\n])", heard)
    return [Aim(float(number), None) if letter == b"A" else Aim(None, float(number)) for letter, number in found]


def prosistel_motions(heard: bytes, elevation: bytes, per_degree: int) -> list[Order]:
    """Every whole command that goes somewhere. `elevation`: the letter of this axis."""
    found = re.findall(rb"\x02([A" + elevation + rb"])G(\d{1,4})(?=\r)", heard)
    angles = [(letter, int(number) / per_degree) for letter, number in found]
    return [Aim(deg, None) if letter == b"A" else Aim(None, deg) for letter, deg in angles]
