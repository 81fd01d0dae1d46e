"""What a watcher is told: every piece both ways, where the antenna is; and nothing that costs while nobody watches."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta

import pytest

from docs.wire import Example
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.links.wire import Wire
from rotator.monitor.tap import Tap, TappedInquiry, TappedSession
from rotator.monitor.transcript import HEADS, Way
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_follow import RotctldFollower
from rotator.protocols.rotctld_session import RotctldSession

GS232, ROTCTLD = Source("gs232b", 1), Source("rotctld", 3)


class Room:
    """A tap, what is told, and the hands of the clock."""

    def __init__(self) -> None:
        self.now = datetime(2026, 11, 21, 23, 59, 58)
        self.status: Status = Example().status()
        self.asked = 0
        self.told: list[str] = []
        self.tap = Tap(lambda: self.now, self._status)
        self.wire = Wire("gs232b", "gs232b", "run/gs232")
        self.tap.link(self.wire, {"protocol": "gs232b", "pty": "run/gs232"})

    def _status(self) -> Status:
        self.asked += 1
        return self.status

    def turn_to(self, azimuth_deg: float) -> None:
        self.status = replace(self.status, azimuth=replace(self.status.azimuth, angle_deg=azimuth_deg))

    def wait(self, seconds: float) -> None:
        self.now += timedelta(seconds=seconds)


@pytest.fixture
def room() -> Room:
    return Room()


def listen(room: Room) -> None:
    room.told += room.tap.greeting()
    room.tap.listeners.append(room.told.append)


def test_every_piece_with_its_time_and_source(room: Room) -> None:
    listen(room)
    session = TappedSession(Gs232Session(Example(), Dialect.B), room.tap, GS232)
    assert session.receive(b"C") == []
    assert session.receive(b"2\rB\r") == [b"AZ=235  EL=025\r\n", b"EL=025\r\n"]
    assert room.told[1:] == [
        '# link gs232b {"protocol": "gs232b", "pty": "run/gs232"}',
        *HEADS,
        "# at 235.00 25.00",
        "23:59:58.000 gs232b#1 > C",
        r"23:59:58.000 gs232b#1 > 2\rB\r",
        r"23:59:58.000 gs232b#1 < AZ=235  EL=025\r\n",
        r"23:59:58.000 gs232b#1 < EL=025\r\n",
    ]
    assert room.told[0].endswith(", 2026-11-21")


def test_the_wire_shows_what_came_and_went_without_a_listener_too(room: Room) -> None:
    session = TappedSession(Gs232Session(Example(), Dialect.B), room.tap, GS232)
    session.receive(b"C")
    session.receive(b"2\rB\r")
    assert (room.wire.last_in, room.wire.last_out) == (b"C2\rB\r", b"AZ=235  EL=025\r\nEL=025\r\n")
    TappedSession(RotctldSession(Example()), room.tap, ROTCTLD).receive(b"p\n")
    assert room.wire.last_in == b"C2\rB\r", "another link's bytes are not shown here"


def test_an_answer_to_silence_and_a_connection_that_ends(room: Room) -> None:
    listen(room)
    session = TappedSession(RotctldSession(Example()), room.tap, ROTCTLD)
    assert session.idle_s == RotctldSession.idle_s
    session.receive(b"p")
    assert session.idle() == [b"235.00\n25.00\n"]
    assert not session.closed
    session.receive(b"q\n")
    assert session.closed
    assert room.told[-3:] == [
        "23:59:58.000 rotctld#3 > p",
        r"23:59:58.000 rotctld#3 < 235.00\n25.00\n",
        r"23:59:58.000 rotctld#3 > q\n",
    ]


def test_where_the_box_asks_it_speaks_first(room: Room) -> None:
    listen(room)
    inquiry = TappedInquiry(RotctldFollower(Example(), 0.1), room.tap, Source("follow", 1))
    assert inquiry.ask() == b"p\n"
    assert inquiry.receive(b"RPRT -6\n")
    assert inquiry.trouble == "answers 'RPRT -6' for a position"
    assert room.told[-2:] == [r"23:59:58.000 follow#1 < p\n", r"23:59:58.000 follow#1 > RPRT -6\n"]


def test_who_moves_it_and_where_it_is_while_it_turns(room: Room) -> None:
    listen(room)
    room.told.clear()

    def poll() -> None:
        room.tap.note(GS232, Way.IN, b"C2\r", text=True)

    for _ in range(20):
        poll()
    assert not [line for line in room.told if line.startswith("# at")], "nothing has changed"
    room.status = replace(room.status, controlled_by="gs232b#1")
    poll()
    for tenths in range(30):
        room.turn_to(235 + tenths / 2)
        room.wait(0.1)
        poll()
    assert [line for line in room.told if line.startswith("# at")] == [
        "# at 235.00 25.00, under gs232b#1",
        "# at 239.50 25.00, under gs232b#1",
        "# at 244.50 25.00, under gs232b#1",
        "# at 249.50 25.00, under gs232b#1",
    ]


def test_a_new_day_is_said(room: Room) -> None:
    listen(room)
    room.tap.note(GS232, Way.IN, b"C2\r", text=True)
    room.wait(3)
    room.tap.note(GS232, Way.IN, b"C2\r", text=True)
    assert room.told[-2:] == ["# 2026-11-22", r"00:00:01.000 gs232b#1 > C2\r"]


def test_nobody_listens_and_nothing_is_asked(room: Room) -> None:
    session = TappedSession(Gs232Session(Example(), Dialect.B), room.tap, GS232)
    session.receive(b"C2\r")
    assert room.asked == 0


def test_the_machine_of_a_connection_is_told_as_it_comes_and_to_later_listeners_while_it_stays(room: Room) -> None:
    listen(room)
    session = TappedSession(RotctldSession(Example()), room.tap, ROTCTLD)
    session.comes_from("192.168.1.20")
    assert room.told[-1] == "# rotctld#3 comes from 192.168.1.20"
    assert "# rotctld#3 comes from 192.168.1.20" in room.tap.greeting()
    session.ended()
    assert "# rotctld#3 comes from 192.168.1.20" not in room.tap.greeting()
