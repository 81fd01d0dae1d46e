"""The tables of docs/reference/wire.md for telescope programs: LX200 and Stellarium, made as those in wire.py.

Knows a station, a moment, and one example of each command. Does not know what a command does or answers: the protocol's
session is asked.
"""

from __future__ import annotations

import itertools

from docs.wire import Example, shown, table
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.orbits.earth import Site
from rotator.protocols import lx200, stellarium
from rotator.protocols.lx200_session import Lx200Session
from rotator.protocols.stellarium import Goto, StellariumSession

AT_S = 1_798_761_600.0
"""1 January 2027, 00:00 UTC."""
SKY = Sky(Site(52.375, 13.125), lambda: AT_S)
"""The sky over JO62nj."""
STAR = Star(67.5, 37.5, Equinox.J2000)
_TARGET = b":Sr 04:30:00#:Sd +37*30:00#:Sz 235*00#:Sa +25*00#"
"""Sent before the commands that go to a target."""


def lx200_table() -> str:
    """An example of every LX200 command, and its answer."""
    rows: list[tuple[str, ...]] = [("example", "what it does", "answer")]
    for verb in lx200.VERBS:
        session = Lx200Session(Example(), SKY)
        if verb.text in ("MS", "MA"):
            session.receive(_TARGET)
        rows.append(
            (f"`{lx200.encode(verb).decode()}`", verb.help, shown(b"".join(session.receive(lx200.encode(verb)))))
        )
    return table(rows)


def stellarium_table() -> str:
    """A target and a position, in hex, one group for each field."""
    goto = stellarium.encode(Goto(STAR, AT_S))
    (position,) = StellariumSession(Example(), SKY).beat()
    return table(
        [
            ("from", "meaning", "bytes"),
            ("Stellarium", "Go to 4 h 30 min, +37.5°, and follow the sky", _hex(goto)),
            ("the box", "The antenna points to 235/25, sent every 0.5 s", _hex(position)),
        ]
    )


def _hex(frame: bytes) -> str:
    """Length, kind, time, right ascension, declination; a position has the state too."""
    ends = (0, 2, 4, 12, 16, 20, 24)
    fields = (frame[start:end].hex() for start, end in itertools.pairwise(ends))
    return f"`{' '.join(field for field in fields if field)}`"
