"""EasyComm on a box: what moves, what is answered, and transcripts of Hamlib before and since 4.6."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator import __version__
from rotator.exchange.orders import Aim, Jog, Order, Park, Stop
from rotator.protocols.easycomm import VERBS, Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
HERE = b"AZ235.0 EL25.0\n"
VERSION = f"VE{__version__}\n".encode()

ROWS: list[tuple[bytes, list[bytes], list[Order]]] = [
    (b"AZ235.6 EL25.0", [], [Aim(235.6, 25)]),
    (b"EL25.0 AZ235.6", [], [Aim(235.6, 25)]),
    (b"AZ235.6", [], [Aim(235.6, None)]),
    (b"EL25.5", [], [Aim(None, 25.5)]),
    (b"AZ-90.5 EL10", [], [Aim(269.5, 10)]),
    (b"AZ400 EL10", [], [Aim(400, 10)]),
    (b"AZ10 EL170", [], [Aim(10, 170)]),
    (b"AZ10 EL-5", [], [Aim(10, -5)]),
    (b"AZ EL ", [HERE], []),
    (b"EL AZ", [HERE], []),
    (b"AZ", [b"AZ235.0\n"], []),
    (b"EL", [b"EL25.0\n"], []),
    (b"SA SE ", [], [Stop()]),
    (b"SE SA", [], [Stop()]),
    (b"SA", [], [Stop((Axis.AZIMUTH,))]),
    (b"SE", [], [Stop((Axis.ELEVATION,))]),
    (b"SA SE AZ10.0 EL20.0 AZ EL", [HERE], [Stop(), Aim(10, 20)]),
    (b"AZ EL VE", [HERE, VERSION], []),
    (b"PARK", [], [Park()]),
    (b"RESET", [], [Stop()]),
    (b"ML", [], [Jog(Axis.AZIMUTH, Direction.MINUS)]),
    (b"MR", [], [Jog(Axis.AZIMUTH, Direction.PLUS)]),
    (b"MU", [], [Jog(Axis.ELEVATION, Direction.PLUS)]),
    (b"MD", [], [Jog(Axis.ELEVATION, Direction.MINUS)]),
    (b"VL4900", [], [Jog(Axis.AZIMUTH, Direction.MINUS)]),
    (b"VR9900", [], [Jog(Axis.AZIMUTH, Direction.PLUS)]),
    (b"VU0100", [], [Jog(Axis.ELEVATION, Direction.PLUS)]),
    (b"VD1", [], [Jog(Axis.ELEVATION, Direction.MINUS)]),
    (b"VL0000", [], [Stop((Axis.AZIMUTH,))]),  # Hamlib's slowest
    (b"VU0", [], [Stop((Axis.ELEVATION,))]),
    (b"VE", [VERSION], []),
    (b"GS", [b"GS1\n"], []),
    (b"GE", [b"GE0\n"], []),
    (b";", [], []),
    (b"", [], []),
    (b"UP145900000 USB DN435800000 USB", [], []),
    (b"AZ1x0 EL20.0", [], []),
    (b"AZ999 EL20", [], []),
    (b"AZ10 EL200", [], []),
    (b"W235 025", [], []),
    (b"AZ235.0 " * 50, [], []),  # longer than any line
]


@every_row(("line", "replies", "orders"), ROWS)
def test_each_line(new_box: type[BenchBox], line: bytes, replies: list[bytes], orders: list[Order]) -> None:
    whole = [line + end for end in (b"\n", b"\r", b"\r\n")]
    for pieces in [[each] for each in whole] + [[bytes([byte]) for byte in each] for each in whole]:
        box = new_box(at=(235, 25))
        session = EasycommSession(box, Level.III)
        assert [reply for piece in pieces for reply in session.receive(piece)] == replies
        assert box.orders == orders


def test_every_row_of_the_table_is_tried_above() -> None:
    said = b" ".join(line for line, _, _ in ROWS)
    assert [verb.text for verb in VERBS if verb.text.encode() not in said] == []


UNTIL_4_5 = [
    (b"AZ235.6 EL25.0\n", []),
    (b"AZ EL \n", [HERE]),
    (b"SA SE \n", []),
    (b"PARK\nRESET\n", []),
    (b"AZ235.0 EL25.0\nAZ EL \n", [HERE]),  # over TCP two commands come together
]
SINCE_4_6 = [(b"AZ235.6 EL25.0\n", []), (b"AZ\n", [b"AZ235.0\n"]), (b"EL\n", [b"EL25.0\n"]), (b"SA SE \n", [])]
CONFIGURED = [
    (b"GS\n;", [b"GS1\n"]),
    (b"VE\n;", [VERSION]),
    (b"AZ\n", [b"AZ235.0\n"]),
    (b"CR 0\n;", []),
    (b"EL\n", [b"EL25.0\n"]),
]


@every_row("wire", [UNTIL_4_5, SINCE_4_6, CONFIGURED])
def test_hamlib(new_box: type[BenchBox], feed: Feed, wire: list[tuple[bytes, list[bytes]]]) -> None:
    box = new_box(at=(235, 25), at_once=False)
    session = EasycommSession(box, Level.III)
    for sent, replies in wire:
        assert feed(session, sent) == replies


def test_the_first_standard_has_angles_and_stops(box: BenchBox) -> None:
    session = EasycommSession(box, Level.I)
    assert session.receive(b"AZ235.6 EL25.0 UP000 XXX DN000 XXX\nSA SE \nAZ EL\n") == [HERE]
    assert session.receive(b"MR\nPARK\nVE\nAZ999\n") == []
    assert box.orders == [Aim(235.6, 25), Stop()]


def test_pstrotator(box: BenchBox) -> None:
    session = EasycommSession(box, Level.II, pstrotator=True)
    assert session.receive(b"AZ EL\r\n") == [b"+235.0 25.0\n"]
    assert session.receive(b"AZ\r\nEL\r\n") == [b"AZ235.0\n", b"EL25.0\n"]


def test_the_servo_sketchs_line_needs_no_end(box: BenchBox) -> None:
    session = EasycommSession(box, Level.II)
    assert session.receive(b"AZ123.4 EL39.0") == []
    assert box.orders == []
    assert session.idle() == []
    assert box.orders == [Aim(123.4, 39)]
    assert session.receive(b"\r\n") == []
    session.receive(b"AZ12")
    session.idle()
    session.receive(b"3.4\n")
    assert box.orders == [Aim(123.4, 39), Aim(123.4, None)]


@pytest.mark.parametrize("end", [b"\r", b"\n", b"\r\n", b""])
def test_look4sats_bytes_over_bluetooth(box: BenchBox, end: bytes) -> None:
    r"""The template `AZ$AZ EL$EL\r`: numbers without padding, one or two decimals. Without the `\r` silence ends it."""
    session = EasycommSession(box, Level.II)
    for azimuth_deg, elevation_deg in ((114.8, 9.05), (115.03, 10.0), (9.27, 80.4)):
        assert session.receive(f"AZ{azimuth_deg} EL{elevation_deg}".encode() + end) == []
        assert session.idle() == []
        assert box.orders[-1] == Aim(azimuth_deg, elevation_deg)
    assert len(box.orders) == 3


def test_state_and_faults(new_box: type[BenchBox]) -> None:
    box = new_box(at=(235, 25))
    session = EasycommSession(box, Level.III)
    session.receive(b"AZ300 EL60\n")
    assert session.receive(b"GS\n") == [b"GS6\n"]  # moving, and it has a target
    assert box.driven == {Axis.AZIMUTH: Direction.PLUS, Axis.ELEVATION: Direction.PLUS}
    box.wait(10)  # the rotor does not turn, though driven
    assert session.receive(b"GE\n") == [b"GE2\n"]
    (state,) = session.receive(b"GS\n")
    assert int(state[2:]) & 8
    session.receive(b"RESET\n")
    assert session.receive(b"GE\nGS\n") == [b"GE0\n", b"GS1\n"]


def test_a_pot_that_is_out_is_a_sensor_fault(new_box: type[BenchBox]) -> None:
    box = new_box(blind=True)
    box.wait(2)
    assert EasycommSession(box, Level.III).receive(b"GE\n") == [b"GE1\n"]
