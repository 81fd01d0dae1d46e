"""What real programs send a GS-232, byte for byte, and what each must hear to be content.

The Hamlib rows were taken off the wire of `rotctl` 4.5.4 (4.3.1 and 5.0 send the same); the others are the format
strings in the programs' sources. The box points at 235 and 25 throughout. Each row is one write of the program and the
replies to it: where there are none, one would be taken for the answer to the next question.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Speed, Stop
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
Transcript = tuple[list[tuple[bytes, list[bytes]]], list[Order]]

UP = Jog(Axis.ELEVATION, Direction.PLUS)
DOWN = Jog(Axis.ELEVATION, Direction.MINUS)
LEFT = Jog(Axis.AZIMUTH, Direction.MINUS)
RIGHT = Jog(Axis.AZIMUTH, Direction.PLUS)
A_HERE, B_HERE = b"+0235+0025\r\n", b"AZ=235  EL=025\r\n"

TRANSCRIPTS_A: dict[str, Transcript] = {
    "Hamlib 601, P 235 25 p S": (
        [(b"W235 025\r", []), (b"C2\r", [A_HERE]), (b"S\r", [])],
        [Aim(235, 25), Stop()],
    ),
    "Hamlib 601, M 2 -1 M 4 1 M 8 100 M 16 67": (
        [(b"U\r", []), (b"X1\r", []), (b"D\r", []), (b"X4\r", []), (b"L\r", []), (b"X3\r", []), (b"R\r", [])],
        [UP, Speed(1), DOWN, Speed(4), LEFT, Speed(3), RIGHT],
    ),
    "Hamlib 602, no pause between": (
        [(b"W235 025\rC2\r", [A_HERE]), (b"S\r", [])],
        [Aim(235, 25), Stop()],
    ),
    "PstRotator, azimuth alone, then both; blanks and empty lines": (
        [(b"M100\r", []), (b"C2\r\n", [A_HERE]), (b"\r\n", []), (b" C2 \r\n", [A_HERE]), (b"S\r", [])],
        [Aim(100, None), Stop()],
    ),
}
TRANSCRIPTS_B: dict[str, Transcript] = {
    "Hamlib 603, a second return after each command": (
        [(b"W235 025\r", []), (b"\r", []), (b"C2\r", [B_HERE]), (b"S\r", []), (b"\r", [])],
        [Aim(235, 25), Stop()],
    ),
    "Hamlib 603, M 16 50": (
        [(b"X2\r", []), (b"\r", []), (b"R\r", []), (b"\r", [])],
        [Speed(2), RIGHT],
    ),
    "OscarWatch, with what it falls back on": (
        [
            (b"C2\r", [B_HERE]),
            (b"C\r", [b"AZ=235\r\n"]),
            (b"B\r", [b"EL=025\r\n"]),
            (b"W005 007\r", []),
            (b"S\r", []),
        ],
        [Aim(5, 7), Stop()],
    ),
    "SDRangel: CR LF is one end, and a second answer would put it out": (
        [(b"W190 045\r\n", []), (b"C2\r\n", [B_HERE]), (b"M190\r\n", []), (b"C2\r\n", [B_HERE])],
        [Aim(190, 45), Aim(190, None)],
    ),
    "WispDDE, for Orbitron and SDR Console: never reads": (
        [(b"W190 045\r", []), (b"W191 045\r", []), (b"W191 046\r", [])],
        [Aim(190, 45), Aim(191, 45), Aim(191, 46)],
    ),
    "Look4Sat over Bluetooth, template W$AZ $EL\\r": (
        [(b"W114.8 9.05\r", []), (b"W115.02 9.4\r", []), (b"W7.0 0.0\r", [])],
        [Aim(114.8, 9.05), Aim(115.02, 9.4), Aim(7, 0)],
    ),
    "SatPC32: W again and again, C2 in between": (
        [(b"W235 025\r", []), (b"C2\r", [B_HERE]), (b"W235 025\n", []), (b"C2\r", [B_HERE])],
        [Aim(235, 25), Aim(235, 25)],
    ),
    "CT: speed and azimuth in one go": (
        [(b"X4\rM100\r", [])],
        [Speed(4), Aim(100, None)],
    ),
    "GS232-Remote: a semicolon before each return": (
        [
            (b"P45;\r", [b"Mode 450 degree\r\n"]),
            (b"X3;\r", []),
            (b"M100;\r", []),
            (b"C;\r", [b"AZ=235\r\n"]),
            (b"R;\r", []),
            (b"S;\r", []),
        ],
        [Speed(3), Aim(100, None), RIGHT, Stop()],
    ),
    "a person in Termite": (
        [(b"w235 25\r\n", []), (b"c2\r\n", [B_HERE]), (b"hello\r\n", [b"?>\r\n"]), (b"s\r\n", [])],
        [Aim(235, 25), Stop()],
    ),
}


@every_row(("wire", "orders"), TRANSCRIPTS_A.values())
def test_with_a_gs232a(
    new_box: type[BenchBox], feed: Feed, wire: list[tuple[bytes, list[bytes]]], orders: list[Order]
) -> None:
    box = new_box(at=(235, 25))
    session = Gs232Session(box, Dialect.A)
    for sent, replies in wire:
        assert feed(session, sent) == replies
    assert box.orders == orders


@every_row(("wire", "orders"), TRANSCRIPTS_B.values())
def test_with_a_gs232b(
    new_box: type[BenchBox], feed: Feed, wire: list[tuple[bytes, list[bytes]]], orders: list[Order]
) -> None:
    box = new_box(at=(235, 25))
    session = Gs232Session(box, Dialect.B)
    for sent, replies in wire:
        assert feed(session, sent) == replies
    assert box.orders == orders


HEARD_BY = {
    "Hamlib 601, anchored, to LF": (Dialect.A, rb"\+0(?P<az>-?\d+)\+0(?P<el>-?\d+)\r\n"),
    "Hamlib 602, fixed columns, 11 characters to CR": (Dialect.A, rb"..(?P<az>\d{3})..(?P<el>\d{3})\r\n"),
    "Hamlib 603, sscanf": (Dialect.B, rb"AZ=\s*(?P<az>-?\d+)\s*EL=\s*(?P<el>-?\d+)\r\n"),
    "a GS-232B on the wire, 14 characters": (Dialect.B, rb"AZ=(?P<az>\d{3})  EL=(?P<el>\d{3})\r\n"),
    "SDRangel, three characters each": (Dialect.B, rb"AZ=(?P<az>[-\d]\d\d) *EL=(?P<el>[-\d]\d\d)\r\n"),
    "remoteRotator": (Dialect.A, rb"\+(?P<az>\d{4})\+(?P<el>\d{4})\r\n"),
}


@every_row(("dialect", "understood"), HEARD_BY.values())
@every_row(("azimuth_deg", "elevation_deg"), [(0, 0), (5, 7), (235.4, 24.6), (359.6, 90), (450, 180)])
def test_each_program_understands_the_position(
    new_box: type[BenchBox], dialect: Dialect, understood: bytes, azimuth_deg: float, elevation_deg: float
) -> None:
    box = new_box(at=(235, 25))
    box.stands_at(azimuth_deg, elevation_deg)
    (reply,) = Gs232Session(box, dialect).receive(b"C2\r")
    heard = re.fullmatch(understood, reply, re.DOTALL)
    assert heard is not None
    assert (int(heard["az"]), int(heard["el"])) == (round(azimuth_deg), round(elevation_deg))
