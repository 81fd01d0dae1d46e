"""The line after each move, as KO6TH's controller prints it."""

from __future__ import annotations

from dataclasses import replace

from hw.ports import AngleSource
from rotator.exchange.status import AxisStatus
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.move_report import MoveReport
from tests.protocols.fed import Notebook


class Mast(Notebook):
    """A box whose azimuth is set by hand."""

    def turns(self, azimuth_deg: float, *, moving: bool) -> None:
        azimuth = AxisStatus(0, 450, angle_deg=azimuth_deg, source=AngleSource.COUNTED, moving=moving)
        self.shown = replace(self.shown, azimuth=azimuth)


def test_one_line_after_each_move_and_none_without_one() -> None:
    box = Mast()
    session = MoveReport(Gs232Session(box, Dialect.B), box)
    assert session.receive(b"C2\r") == [b"AZ=235  EL=025\r\n"]
    assert session.beat() == []
    for azimuth_deg in (240.4, 359.7):
        box.turns(azimuth_deg - 3.0, moving=True)
        assert session.beat() == session.beat() == []
        box.turns(azimuth_deg, moving=False)
        assert session.beat() == [f"AZ = {round(azimuth_deg)}, EL = 25\r\n".encode()]
        assert session.beat() == []


def test_a_move_before_the_first_bytes_gets_no_line() -> None:
    """On a serial port no program may be listening yet."""
    box = Mast()
    session = MoveReport(Gs232Session(box, Dialect.B), box)
    for moving in (True, False, True):
        box.turns(240.0, moving=moving)
        assert session.beat() == []
    session.receive(b"C2\r")
    assert session.beat() == []
    box.turns(250.0, moving=False)
    assert session.beat() == [b"AZ = 250, EL = 25\r\n"]
