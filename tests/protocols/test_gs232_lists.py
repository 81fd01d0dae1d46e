"""Timed lists over GS-232: the long M and W, run by T, counted by N.

The manuals: the first number is the step in seconds, 001 to 999. The antenna goes to the first point at once and waits
there for T, which turns to the next point and then waits. Any new M or W clears the list; M or W alone does only that
and is answered `?>`. S ends a run.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import LoadTimed
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

WRONG = b"?>\r\n"


@pytest.fixture
def session(box: BenchBox) -> Gs232Session:
    box.follows = True  # a motor that stands ends a list
    return Gs232Session(box, Dialect.B)


def wanted(box: BenchBox) -> tuple[float | None, float | None]:
    return box.status().wanted_azimuth_deg, box.status().wanted_elevation_deg


def test_a_list_goes_to_its_first_point_and_waits(box: BenchBox, session: Gs232Session) -> None:
    assert session.receive(b"W010 100 020 120 030 140 040\r") == []
    assert box.motions == [LoadTimed(10, ((100, 20), (120, 30), (140, 40)))]
    assert box.driven == {Axis.AZIMUTH: Direction.MINUS, Axis.ELEVATION: Direction.MINUS}
    box.wait(60)
    assert wanted(box) == (100, 20)
    assert session.receive(b"N\r") == [b"+0001+0003\r\n"]


def test_t_turns_to_the_next_point_at_once_and_stays_at_the_last(box: BenchBox, session: Gs232Session) -> None:
    session.receive(b"W010 100 020 120 030 140 040\r")
    session.receive(b"T\r")
    visited = []
    for point in (2, 3, 3):
        visited.append(wanted(box))
        assert session.receive(b"N\r") == [b"+%04d+0003\r\n" % point]
        box.wait(10)
    assert visited == [(120, 30), (140, 40), (140, 40)]


def test_t_sent_twice_skips_no_point(box: BenchBox, session: Gs232Session) -> None:
    session.receive(b"M010 100 120 140\rT\r")
    box.wait(5)
    session.receive(b"T\r")
    assert session.receive(b"N\r") == [b"+0002+0003\r\n"]
    box.wait(4.9)
    assert session.receive(b"N\r") == [b"+0002+0003\r\n"]
    box.wait(0.2)
    assert session.receive(b"N\r") == [b"+0003+0003\r\n"]


@pytest.mark.parametrize("stop", [b"S\r", b"A\r", b"E\r"])
def test_a_stop_ends_the_run_and_t_goes_on_from_there(box: BenchBox, session: Gs232Session, stop: bytes) -> None:
    session.receive(b"W005 100 020 120 030 140 040\rT\r")
    box.wait(1)
    session.receive(stop)
    box.wait(20)
    assert session.receive(b"N\r") == [b"+0002+0003\r\n"]
    session.receive(b"T\r")
    assert session.receive(b"N\r") == [b"+0003+0003\r\n"]
    assert wanted(box) == (140, 40)


CLEARING = {
    b"M": [WRONG],
    b"W": [WRONG],
    b"M200": [],
    b"W200 010": [],
    b"W000 010 020": [WRONG],  # a new list that is damaged: T must not run the old one
    b"M005 01x 020": [WRONG],
    b"M451": [WRONG],
    b"W200 181": [WRONG],
}


@pytest.mark.long
@pytest.mark.parametrize("load", [b"M005 100 120 140\rT\r", b"W005 100 020 120 030 140 040\rT\r"])
@pytest.mark.parametrize(("line", "replies"), CLEARING.items())
def test_any_new_m_or_w_forgets_the_list(
    box: BenchBox, session: Gs232Session, load: bytes, line: bytes, replies: list[bytes]
) -> None:
    session.receive(load)
    assert session.receive(line + b"\r") == replies
    assert session.receive(b"T\rN\r") == [WRONG, WRONG]
    before = wanted(box)
    box.wait(20)
    assert wanted(box) == before
    assert box.status().timed_points == 0


def test_a_new_list_in_the_same_packet_as_n(new_box: type[BenchBox]) -> None:
    """Orders reach the controller a moment after the link has read them; its status tells of the old list till then."""
    box = new_box(at_once=False)
    box.follows = True
    session = Gs232Session(box, Dialect.B)
    session.receive(b"M005 100 120 140\r")
    box.wait(1)
    session.receive(b"T\r")
    box.wait(6)
    assert session.receive(b"N\r") == [b"+0003+0003\r\n"]
    assert session.receive(b"M005 010 020\rN\r") == [b"+0001+0002\r\n"]


@pytest.mark.parametrize("line", [b"S1", b"X9", b"hello", b"R", b"C2", b"P36"])
def test_other_lines_keep_the_list(session: Gs232Session, line: bytes) -> None:
    session.receive(b"W005 100 020 120 030\r" + line + b"\r")
    assert session.receive(b"N\r") == [b"+0001+0002\r\n"]


def test_a_list_that_another_link_clears_does_not_run_on(box: BenchBox, session: Gs232Session) -> None:
    session.receive(b"M005 100 120 140\rT\r")
    Gs232Session(box, Dialect.A).receive(b"M\r")
    assert session.receive(b"C2\r") != []
    box.wait(20)
    assert wanted(box)[0] == 120
    assert box.status().timed_points == 0
