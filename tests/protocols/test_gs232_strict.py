"""A link that answers as Yaesu's manuals say (`strict`), and the parts of that which can be had alone.

The manuals: a CR after every command, with an LF where data came; `?>` after what is no command. GS-232B, page 8: O is
answered `are you sure?`, then Y stores and is answered `Completed.`; F shows the angle first, ENTER leaves it. Page 16:
Z changes the centre, and is ignored in the 450° mode. Page 20: H3 shows both modes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Calibrate, Order, Stop
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

WRONG, SURE, STORED = b"?>\r\n", b"are you sure?\r\n", b"Completed.\r\n"


@pytest.fixture
def strict(box: BenchBox) -> Gs232Session:
    return Gs232Session(box, Dialect.B, ack=b"\r", empty_line=WRONG, strict=True, may_calibrate=True)


@every_row("dialect", Dialect)
@every_row("line", [b"", b"  ", b"\0", b"\xff", b";"])
def test_an_empty_line_is_a_mistake_where_asked_for(new_box: type[BenchBox], dialect: Dialect, line: bytes) -> None:
    box = new_box(at=(235, 25))
    session = Gs232Session(box, dialect, empty_line=WRONG)
    assert session.receive(line + b"\n" + line + b"\n") == [WRONG, WRONG]
    assert session.receive(line + b"\r" + line + b"\r") == [WRONG, WRONG]


def test_cr_lf_is_one_end_and_its_lf_no_mistake(box: BenchBox) -> None:
    session = Gs232Session(box, Dialect.B, empty_line=WRONG)
    assert session.receive(b"C\r\n\r\n") == [b"AZ=235\r\n", WRONG]
    assert session.receive(b"C\r") == [b"AZ=235\r\n"]
    assert session.receive(b"\n") == []


COMMANDS = [b"R", b"L", b"A", b"U", b"D", b"E", b"S", b"X1", b"X4", b"M100", b"W100 020", b"M005 010 020", b"T"]
"""They ask for no data."""


@pytest.mark.parametrize("command", [*COMMANDS, b"P36", b"P45", b"Z"])
def test_every_command_without_data_is_answered_by_a_cr(strict: Gs232Session, command: bytes) -> None:
    strict.receive(b"M005 010 020\r")
    assert strict.receive(command + b"\r") == [b"\r"]


@pytest.mark.parametrize(
    ("command", "order", "shown"),
    [
        (b"O", Calibrate(Axis.AZIMUTH, high_end=False), b""),
        (b"O2", Calibrate(Axis.ELEVATION, high_end=False), b""),
        (b"F", Calibrate(Axis.AZIMUTH, high_end=True), b"AZ=235\r\n"),
        (b"F2", Calibrate(Axis.ELEVATION, high_end=True), b"AZ=235  EL=025\r\n"),
    ],
)
@pytest.mark.parametrize("yes", [b"Y\r", b"y\r", b"Y\r\n", b"y\n"])
def test_o_and_f_store_after_y(  # noqa: PLR0917
    box: BenchBox, strict: Gs232Session, command: bytes, order: Order, shown: bytes, yes: bytes
) -> None:
    assert strict.receive(command + b"\r") == [shown + SURE]
    assert box.orders == []
    assert strict.receive(yes) == [STORED]
    assert box.orders == [order]
    assert strict.receive(yes) == [WRONG], "asked once, stored once"
    assert len(box.orders) == 1


@pytest.mark.parametrize("command", [b"O", b"F", b"O2", b"F2"])
@pytest.mark.parametrize(
    ("instead", "reply", "orders"),
    [
        (b"", b"\r", []),  # ENTER leaves the routine
        (b"N", WRONG, []),
        (b"YES", WRONG, []),
        (b"\0Y", WRONG, []),
        (b"S", b"\r", [Stop()]),
        (b"STOP;", b"\r", [Stop()]),
        (b"W100 020", b"\r", [Aim(100, 20)]),
        (b"C", b"AZ=235\r\n", []),
    ],
)
def test_anything_but_y_leaves_the_calibration_as_it_was_and_is_obeyed(  # noqa: PLR0917
    box: BenchBox, strict: Gs232Session, command: bytes, instead: bytes, reply: bytes, orders: list[Order]
) -> None:
    strict.receive(command + b"\r")
    assert strict.receive(instead + b"\r") == [reply]
    strict.receive(b"Y\r")
    assert [order for order in box.orders if isinstance(order, Calibrate)] == []
    assert box.orders == orders


def test_y_after_another_link_has_moved_the_antenna_stores_nothing(box: BenchBox, strict: Gs232Session) -> None:
    strict.receive(b"O\r")
    Gs232Session(box, Dialect.A).receive(b"R\r")
    assert box.driven[Axis.AZIMUTH] is Direction.PLUS
    assert strict.receive(b"Y\r") == [WRONG]


def test_without_the_right_to_calibrate_nothing_is_asked(box: BenchBox) -> None:
    session = Gs232Session(box, Dialect.B, strict=True)
    assert session.receive(b"O\rY\r") == [WRONG, WRONG]
    assert box.orders == []


def test_a_gs232a_has_no_y(box: BenchBox) -> None:
    """Its manual has trimmers and a power switch in place of the question; this box has neither, and stores at once."""
    session = Gs232Session(box, Dialect.A, ack=b"\r", strict=True, may_calibrate=True)
    assert session.receive(b"O\rY\r") == [b"\r", WRONG]


def test_z_changes_the_centre_in_360_degrees_only(strict: Gs232Session) -> None:
    def modes() -> list[bytes]:
        return strict.receive(b"H3\r")[0].split(b"\r\n")[-3:-1]

    assert modes() == [b"mode 450 Degree", b"S Center"]
    assert strict.receive(b"Z\r") == [b"\r"]
    assert modes() == [b"mode 450 Degree", b"S Center"]
    assert strict.receive(b"P36\rZ\r") == [b"\r", b"\r"]
    assert modes() == [b"mode 360 Degree", b"N Center"]
    strict.receive(b"Z\r")
    assert modes() == [b"mode 360 Degree", b"S Center"]


class Cosmos:
    """HSFL COSMOS's gs232b_lib: how it reads and what makes it give up, on a port without delay."""

    def __init__(self, session: Gs232Session) -> None:
        self._session = session
        self._heard = b""

    def _write(self, data: bytes) -> None:
        self._heard += b"".join(self._session.receive(data))

    def _line(self) -> bytes:
        """Up to a line feed, or what half a second brings."""
        line, end, self._heard = self._heard.partition(b"\n")
        return line + end

    def send(self, command: bytes) -> bool:
        self._write(b"\r")
        if not self._line().startswith(b"?>"):
            return False
        self._write(command)
        return True

    def connect(self) -> bool:
        return self.send(b"\r") and self._line() == WRONG and self.send(b"\r") and self._line() == WRONG

    def where(self) -> bytes:
        return self._line() if self.send(b"C2\r") else b""


def test_cosmos_connects_points_asks_and_stops_where_an_empty_line_is_a_mistake(box: BenchBox) -> None:
    cosmos = Cosmos(Gs232Session(box, Dialect.B, empty_line=WRONG))
    assert cosmos.connect()
    assert cosmos.where() == b"AZ=235  EL=025\r\n"
    assert cosmos.send(b"X2\r")
    assert cosmos.send(b"W100 020\r")
    assert cosmos.where() == b"AZ=235  EL=025\r\n"
    assert box.driven == {Axis.AZIMUTH: Direction.MINUS, Axis.ELEVATION: Direction.MINUS}
    assert cosmos.send(b"S\r")
    assert set(box.driven.values()) == {Direction.OFF}


def test_a_cr_after_commands_costs_cosmos_the_next_one(box: BenchBox) -> None:
    """Why docs/reference/wire.md names `empty_line` for it, and not `strict`: after each order one command is lost."""
    cosmos = Cosmos(Gs232Session(box, Dialect.B, ack=b"\r", empty_line=WRONG))
    assert cosmos.connect()
    assert cosmos.send(b"W100 020\r")
    assert not cosmos.send(b"S\r")
    assert cosmos.send(b"S\r")
