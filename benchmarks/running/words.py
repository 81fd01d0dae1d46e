"""What a program says on a link of each protocol: a question, its answer, an order; and ways to spoil its bytes.

Knows bytes. Knows no socket and no box. The order's bytes come from the codecs of the protocols.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial

from rotator.orbits.celestial import Equinox, Sky
from rotator.orbits.earth import Site
from rotator.protocols import stellarium
from rotator.protocols.pstrotatoraz import encode as request
from rotator.protocols.spid import Command, Frame, Model, encode
from rotator.protocols.stellarium import Goto
from rotator.protocols.wsjtx import BodyDirection
from rotator.protocols.wsjtx import encode as azel

Order = Callable[[float, float], bytes]
"""From a direction in degrees to the bytes of an order."""
STATION = {"latitude_deg": 52.5, "longitude_deg": 13.4}
ROTOR = "soak"
SKY = Sky(Site(STATION["latitude_deg"], STATION["longitude_deg"]), time.time)


@dataclass(frozen=True, slots=True)
class Words:
    """`place`: the key of a `[[link]]` that says what carries the bytes. `question` empty: the protocol has none."""

    protocol: str
    order: Order
    place: str = "tcp"
    question: bytes = b""
    has: bytes = b""
    more: tuple[bytes, ...] = ()
    """Further commands, for hostile programs to spoil."""
    keys: Mapping[str, str] = field(default_factory=dict)
    lasting: bool = True
    """A connection carries more than one question."""

    @property
    def pieces(self) -> tuple[bytes, ...]:
        return tuple(each for each in (self.question, self.order(235.0, 25.0), *self.more) if each)


def _whole(form: bytes, azimuth_deg: float, elevation_deg: float) -> bytes:
    return form % (int(azimuth_deg), int(elevation_deg))


def _spid(model: Model, pulses: int, azimuth_deg: float, elevation_deg: float) -> bytes:
    return encode(Frame(Command.SET, azimuth_deg, elevation_deg), model, pulses)


def _star(azimuth_deg: float, elevation_deg: float) -> bytes:
    return stellarium.encode(Goto(SKY.star(azimuth_deg, elevation_deg, Equinox.J2000), time.time()))


def _moon(azimuth_deg: float, elevation_deg: float) -> bytes:
    return azel("Moon", BodyDirection(int(time.time()) % 86_400, azimuth_deg, elevation_deg))


def _lines(text: str, end: str = "\n") -> tuple[bytes, ...]:
    return tuple((line + end).encode() for line in text.split("|"))


_W = partial(_whole, b"W%03d %03d\r")
_EASYCOMM: Order = lambda az, el: b"AZ%.1f EL%.1f\n" % (az, el)  # noqa: E731 - a row's own form is a line
_FRAME = "57 00 00 00 00 00 00 00 00 00 00 %s 20"
_STATUS = bytes.fromhex(_FRAME % "1F")
_GS232 = _lines("M100|R|U|S|P45|Z|O|F2|H3|W010 100 020 110 030|T|N|X4|M005 010 020 030", "\r")
_EASYCOMMS = _lines("SA SE |ML|VU0900|PARK|RESET|GS\nGE\nVE")
_ROTCTLD = _lines(
    "+\\set_pos 14 7|;p|S|M CW 50|K|R 1|\\dump_state|C max_az 540|V SPEED 2|L -70.5 42.3 6|w C2|1|B 1 2 3 4"
)
_SPID = (bytes.fromhex(_FRAME % "0F"), bytes.fromhex("57 35 39 35 30 0A 33 38 35 30 0A 2F 20"))
_PROSISTEL = partial(Words, question=b"\x02A?\r", has=b"\x02A,?")

ALL = (
    Words("gs232a", _W, "serial", b"\r\rC2\r", b"+0", _GS232),
    Words("gs232b", _W, "pty", b"\r\rC2\r", b"AZ=", _GS232),
    Words("gs232-f1efw", _W, more=_GS232),
    Words("rotctld", lambda az, el: b"P %.2f %.2f\n" % (az, el), "tcp", b"\np\n", b".", _ROTCTLD),
    Words("rotctld-follow", lambda az, el: b"%.2f\n%.2f\n" % (az, el), "connect", has=b"p"),
    *(Words(f"easycomm{each}", _EASYCOMM, "tcp", b"\nAZ EL \n", b"AZ", _EASYCOMMS) for each in (1, 2, 3)),
    Words("rot1prog", partial(_spid, Model.ROT1PROG, 1), "tcp", _STATUS, b"W", _SPID),
    Words("rot2prog", partial(_spid, Model.ROT2PROG, 2), "tcp", _STATUS, b"W", _SPID),
    Words("md01", partial(_spid, Model.MD01, 10), "tcp", _STATUS, b"W", _SPID),
    Words("dcu1", lambda az, _: b"AP1%03d;AM1;" % int(az), "tcp", b"\rAI1;", b";", _lines("AP1235.0\r|BI1||AS1", ";")),
    _PROSISTEL("prosistel-d", partial(_whole, b"\x02AG%d\r\x02EG%d\r")),
    _PROSISTEL("prosistel-c", lambda az, el: b"\x02AG%d\r\x02BG%d\r" % (int(10 * az), int(10 * el))),
    Words("rc2800", lambda az, el: b"A%.1f\rE%d\r" % (az, int(el)), question=b"A\r", has=b"A P="),
    Words("lx200", partial(_whole, b":Sz%03d*00#:Sa+%02d*00#:MA#"), question=b":GZ#", has=b"#"),
    Words("stellarium", _star, has=bytes((24, 0, 0, 0))),
    Words(
        "pstrotatoraz",
        lambda az, _: request(f"/PstRotatorAz.htm?az={az:.1f}"),
        question=request("/PstRotatorAz.htm"),
        has=b"Bearing",
        lasting=False,
    ),
    Words(
        "pstrotator",
        lambda az, el: b"<PST><AZIMUTH>%.1f</AZIMUTH><ELEVATION>%.1f</ELEVATION></PST>" % (az, el),
        "udp",
        b"<PST>AZ?</PST>",
        b"AZ:",
        (b"<PST><STOP>1</STOP></PST>", b"<PST><PARK>1</PARK></PST>"),
    ),
    Words(
        "n1mm",
        lambda az, _: b"<N1MMRotor><rotor>%b</rotor><goazi>%.1f</goazi></N1MMRotor>" % (ROTOR.encode(), az),
        "udp",
        has=ROTOR.encode(),
        more=(b"<N1MMRotor><stop><rotor>soak</rotor><freqband>21.0</freqband></stop></N1MMRotor>",),
        keys={"rotor_name": ROTOR},
    ),
    Words(
        "macdoppler",
        lambda az, el: b"[AzEl Rotor Report:Azimuth:%.2f, Elevation:%.2f, SatName:XW-2C]" % (az, el),
        "udp",
    ),
    Words("wsjtx", _moon, "file"),
)
"""Every protocol of the box, each on a link of its own."""
STOP = b"\nS\n"
"""On the rotctld link: everything stops, and faults are acknowledged."""
STRANGERS = (
    b"GET / HTTP/1.1\r\nHost: x\r\n\r\n",
    b"\xff\xfd\x01\xff\xfb\x03",
    "W235 025\r".encode("utf-16"),
    b"\0" * 64,
)


def nasty(chance: random.Random, pieces: tuple[bytes, ...]) -> bytes:
    """Good bytes, damaged ones, another protocol's, or bytes of no protocol."""
    match chance.randrange(10):
        case 0:
            return chance.randbytes(chance.randrange(1, 300))
        case 1:
            return chance.choice((*STRANGERS, *chance.choice(ALL).pieces))
        case 2:
            return chance.choice(pieces) * chance.randrange(1, 200)
        case 3:
            return bytes([chance.randrange(256)]) * chance.randrange(1, 40_000)
        case 4 | 5:
            return b"".join(chance.choices(pieces, k=chance.randrange(1, 6)))
    data = bytearray(b"".join(chance.choices(pieces, k=chance.randrange(1, 4))))
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(data) + 1)
        match chance.randrange(4):
            case 0:
                data[at : at + 1] = bytes([chance.randrange(256)])
            case 1:
                del data[at : at + chance.randrange(1, 4)]
            case 2:
                data[at:at] = chance.choice((b" ", b"9", b"-", b".", b",", b"\0", b"\r", b"\n", b"W", b";"))
            case 3:
                data[at:at] = data[: chance.randrange(len(data) + 1)]
    return bytes(data)
