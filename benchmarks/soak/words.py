"""What a program says on each link of the soaked box: a question, its answer, an order, a stop.

Knows bytes. Knows no socket and no box. The order's bytes come from the codecs of the protocols.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from benchmarks.fuzz_words import SPOKEN
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
LATITUDE_DEG, LONGITUDE_DEG = 52.5, 13.4
ROTOR = "soak"
SKY = Sky(Site(LATITUDE_DEG, LONGITUDE_DEG), time.time)


@dataclass(frozen=True, slots=True)
class Words:
    """`place`: the key of a `[[link]]` that says what carries the bytes. `question` empty: the protocol has none."""

    protocol: str
    order: Order
    place: str = "tcp"
    question: bytes = b""
    has: bytes = b""
    keys: str = ""
    lasting: bool = True
    """A connection carries more than one question."""


def _whole(form: bytes, azimuth_deg: float, elevation_deg: float) -> bytes:
    return form % (int(azimuth_deg), int(elevation_deg))


def _spid(model: Model, pulses: int, azimuth_deg: float, elevation_deg: float) -> bytes:
    return encode(Frame(Command.SET, azimuth_deg, elevation_deg), model, pulses)


def _star(azimuth_deg: float, elevation_deg: float) -> bytes:
    return stellarium.encode(Goto(SKY.star(azimuth_deg, elevation_deg, Equinox.J2000), time.time()))


def _moon(azimuth_deg: float, elevation_deg: float) -> bytes:
    return azel("Moon", BodyDirection(int(time.time()) % 86_400, azimuth_deg, elevation_deg))


def _asked(protocol: str, order: Order, place: str = "tcp") -> Words:
    _, question, has = SPOKEN[protocol]
    return Words(protocol, order, place, question, has)


_W = partial(_whole, b"W%03d %03d\r")
_EASYCOMM: Order = lambda az, el: b"AZ%.1f EL%.1f\n" % (az, el)  # noqa: E731 - a row's own form is a line

WORDS = (
    _asked("gs232a", _W, "serial"),
    _asked("gs232b", _W, "pty"),
    Words("gs232-f1efw", _W),
    _asked("rotctld", lambda az, el: b"P %.2f %.2f\n" % (az, el)),
    Words("rotctld-follow", lambda az, el: b"%.2f\n%.2f\n" % (az, el), "connect", has=b"p"),
    _asked("easycomm1", _EASYCOMM),
    _asked("easycomm2", _EASYCOMM),
    _asked("easycomm3", _EASYCOMM),
    _asked("rot1prog", partial(_spid, Model.ROT1PROG, 1)),
    _asked("rot2prog", partial(_spid, Model.ROT2PROG, 2)),
    _asked("md01", partial(_spid, Model.MD01, 10)),
    _asked("dcu1", lambda az, _: b"AP1%03d;AM1;" % int(az)),
    Words("prosistel-d", partial(_whole, b"\x02AG%d\r\x02EG%d\r"), question=b"\x02A?\r", has=b"\x02A,?"),
    Words(
        "prosistel-c",
        lambda az, el: b"\x02AG%d\r\x02BG%d\r" % (int(10 * az), int(10 * el)),
        question=b"\x02A?\r",
        has=b"\x02A,?",
    ),
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
    ),
    Words(
        "n1mm",
        lambda az, _: b"<N1MMRotor><rotor>%b</rotor><goazi>%.1f</goazi></N1MMRotor>" % (ROTOR.encode(), az),
        "udp",
        has=ROTOR.encode(),
        keys=f'rotor_name = "{ROTOR}"\n',
    ),
    Words(
        "macdoppler",
        lambda az, el: b"[AzEl Rotor Report:Azimuth:%.2f, Elevation:%.2f, SatName:XW-2C]" % (az, el),
        "udp",
    ),
    Words("wsjtx", _moon, "file"),
)
"""Every protocol of the box, each on a link of its own."""
STOP = b"S\n"
"""On the rotctld link: everything stops, and faults are acknowledged."""
