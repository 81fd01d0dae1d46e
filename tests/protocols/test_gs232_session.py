"""A conversation in GS-232 with a box that points at 235 and 25: what each command orders and what comes back.

The manual: a command ends with a carriage return and is not echoed, an unknown one is answered `?>`. Silence after a
command that asks nothing, and for an empty line, is what Hamlib needs at every speed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Calibrate, Jog, Order, Speed, Stop
from rotator.protocols.gs232 import MAX_LINE, Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
AZIMUTH, ELEVATION = Axis.AZIMUTH, Axis.ELEVATION
WRONG = b"?>\r\n"


class Row(NamedTuple):
    line: bytes
    replies: list[bytes]
    orders: list[Order]


ROWS = [
    Row(b"C", [b"AZ=235\r\n"], []),
    Row(b"B", [b"EL=025\r\n"], []),
    Row(b"C2", [b"AZ=235  EL=025\r\n"], []),
    Row(b"c2", [b"AZ=235  EL=025\r\n"], []),
    Row(b"", [], []),
    Row(b"  ", [], []),
    Row(b"\0", [], []),
    Row(b"R", [], [Jog(AZIMUTH, Direction.PLUS)]),
    Row(b"L", [], [Jog(AZIMUTH, Direction.MINUS)]),
    Row(b"U", [], [Jog(ELEVATION, Direction.PLUS)]),
    Row(b"D", [], [Jog(ELEVATION, Direction.MINUS)]),
    Row(b"A", [], [Stop((AZIMUTH,))]),
    Row(b"E", [], [Stop((ELEVATION,))]),
    Row(b"W100 045", [], [Aim(100, 45)]),
    Row(b"w100 45", [], [Aim(100, 45)]),
    Row(b"W100.5,45", [], [Aim(100.5, 45)]),
    Row(b"M100", [], [Aim(100, None)]),
    Row(b"M", [WRONG], []),
    Row(b"W", [WRONG], []),
    Row(b"W1x0 020", [WRONG], []),
    Row(b"W200 181", [WRONG], []),
    Row(b"Z" * 86, [WRONG], []),
    Row(b"T", [WRONG], []),  # no list to run
    Row(b"N", [WRONG], []),
    Row(b"X1", [], [Speed(1)]),
    Row(b"X2", [], [Speed(2)]),
    Row(b"X3", [], [Speed(3)]),
    Row(b"X4", [], [Speed(4)]),
    Row(b"O", [WRONG], []),  # calibration over a link is off unless allowed
    Row(b"O2", [WRONG], []),
    Row(b"F", [WRONG], []),
    Row(b"F2", [WRONG], []),
    Row(b"Z", [b"S Center\r\n"], []),
    Row(b"P36", [b"Mode 360 degree\r\n"], []),
    Row(b"P45", [b"Mode 450 degree\r\n"], []),
    Row(b"S", [], [Stop()]),
    Row(b"S;", [], [Stop()]),
    Row(b"STOP", [], [Stop()]),
    Row(b"M100;", [], [Aim(100, None)]),
]
ENDS = [b"\r", b"\n", b"\r\n", b"\r\r"]


@pytest.fixture
def session(box: BenchBox) -> Gs232Session:
    return Gs232Session(box, Dialect.B)


@every_row("end", ENDS)
def test_each_command(new_box: type[BenchBox], feed: Feed, end: bytes) -> None:
    for line, replies, orders in ROWS:
        box = new_box(at=(235, 25))
        session = Gs232Session(box, Dialect.B)
        assert feed(session, line) == [], "nothing happens before the line ends"
        assert box.orders == []
        assert feed(session, end) == replies, line
        assert box.orders == orders, line


def test_a_line_too_long_is_one_mistake_and_the_next_is_good(box: BenchBox, session: Gs232Session, feed: Feed) -> None:
    too_long = b"W100 045" + b" " * MAX_LINE
    assert feed(session, too_long + b"\rC2\r") == [WRONG, b"AZ=235  EL=025\r\n"]
    assert box.orders == []


def test_a_gs232a_answers_in_its_own_form(box: BenchBox, feed: Feed) -> None:
    session = Gs232Session(box, Dialect.A)
    assert feed(session, b"C\rB\rC2\r") == [b"+0235\r\n", b"+0025\r\n", b"+0235+0025\r\n"]
    assert feed(session, b"P36\rP45\rZ\rH3\r") == [WRONG] * 4


def test_with_the_option_a_carriage_return_acknowledges(box: BenchBox, feed: Feed) -> None:
    """Hamlib before 4.0 waits for it. Answers carry their own, mistakes too, and an empty line is no command."""
    session = Gs232Session(box, Dialect.B, ack=b"\r")
    assert feed(session, b"W100 045\rR\rA\rX2\rM100\rM005 010 020\rT\rS\r") == [b"\r"] * 8
    assert feed(session, b"C2\r\rW\r") == [b"AZ=235  EL=025\r\n", WRONG]


@pytest.mark.parametrize(
    ("azimuth_deg", "in_450", "in_360"),
    [
        (0, b"000", b"000"),
        (-0.6, b"000", b"000"),
        (360, b"360", b"360"),
        (400.4, b"400", b"040"),
        (450, b"450", b"090"),
    ],
)
def test_p36_and_p45_say_how_the_overlap_is_counted(
    box: BenchBox, session: Gs232Session, azimuth_deg: float, in_450: bytes, in_360: bytes
) -> None:
    box.stands_at(azimuth_deg, 0)
    assert session.receive(b"C\rP36\rC\rP45\rC\r")[::2] == [
        b"AZ=" + shown + b"\r\n" for shown in (in_450, in_360, in_450)
    ]


def test_only_a_450_degree_unit_takes_azimuths_above_360(box: BenchBox, session: Gs232Session) -> None:
    assert session.receive(b"W400 010\rM450\r") == []
    assert session.receive(b"P36\rW400 010\rM450\rM005 010 361\r")[1:] == [WRONG] * 3
    assert session.receive(b"W360 010\r") == []
    assert box.motions == [Aim(400, 10), Aim(450, None), Aim(360, 10)]


@pytest.mark.parametrize(
    ("travel", "highest", "centre"),
    [
        ((0, 450), 450, b"S Center\r\n"),
        ((0, 360), 360, b"S Center\r\n"),
        ((180, 540), 360, b"N Center\r\n"),
        ((-180, 180), 360, b"N Center\r\n"),
    ],
)
def test_the_rotors_travel_chooses_the_mode(
    new_box: type[BenchBox], travel: tuple[float, float], highest: int, centre: bytes
) -> None:
    session = Gs232Session(new_box(travel), Dialect.B)
    assert session.receive(b"M%03d\r" % highest) == []
    assert session.receive(b"M%03d\r" % (highest + 1)) == [WRONG]
    assert session.receive(b"Z\r") == [centre]


def test_calibration_where_allowed(box: BenchBox) -> None:
    session = Gs232Session(box, Dialect.B, may_calibrate=True)
    box.stands_at(3, 178)
    assert session.receive(b"O\rF2\r") == []
    box.wait(0.1)
    assert session.receive(b"C2\r") == [b"AZ=000  EL=180\r\n"]
    assert box.orders == [Calibrate(AZIMUTH, high_end=False), Calibrate(ELEVATION, high_end=True)]


@pytest.mark.parametrize("command", [b"O", b"O2", b"F", b"F2"])
def test_no_calibration_while_moving_and_it_blocks_nothing(box: BenchBox, command: bytes) -> None:
    session = Gs232Session(box, Dialect.B, may_calibrate=True)
    assert session.receive(b"R\r" + command + b"\rC2\r") == [WRONG, b"AZ=235  EL=025\r\n"]
    session.receive(b"S\r")
    assert session.receive(command + b"\r") == [WRONG], "it still coasts"
    box.wait(1.5)
    assert session.receive(command + b"\rC2\r")[0].startswith(b"AZ=")
