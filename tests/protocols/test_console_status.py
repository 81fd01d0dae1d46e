"""What a person at the console is told of the box: its status, a stop that only a person takes back, a storm park."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hw.ports import Axis
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal, Source
from rotator.exchange.status import Status
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.session import Session

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox


# --- status


def told(session: Session) -> list[str]:
    (answer,) = session.receive(b"status\n")
    *lines, ok = answer.decode().splitlines()
    assert ok == "ok"
    return lines


def test_status_at_rest(box: BenchBox) -> None:
    assert told(ConsoleSession(box)) == ["azimuth: 235.0° measured", "elevation: 25.0° measured", "moved by: nobody"]


def test_status_on_the_way(box: BenchBox) -> None:
    session = ConsoleSession(box)
    session.receive(b"point 300 25\n")
    box.wait(0.5)
    assert told(session) == [
        "azimuth: 235.0° measured, to 300.0°, turns cw",
        "elevation: 25.0° measured, to 25.0°",
        "wanted: 300.0° 25.0°",
        "moving: azimuth",
        "moved by: link",
    ]


def test_status_when_stopped_and_faulty(new_box: type[BenchBox]) -> None:
    box = new_box(missing=(Missing.LIMITS,), blind=True)
    session = ConsoleSession(box)
    session.receive(b"stop\n")
    assert told(session) == [
        "azimuth: not known",
        "elevation: not known",
        "moved by: nobody",
        "stopped by: link; nothing moves until resume",
        *(f"fault: {fault}" for fault in box.status().faults),
        "missing: azimuth needs limits",
        "missing: elevation needs limits",
    ]
    assert len(box.status().faults) == 2


# --- the stop that only a person takes back


class AtTheBox:
    """The box as the console's connection sees it; the bench's own `order` is a link's."""

    def __init__(self, box: BenchBox) -> None:
        self._box = box

    def status(self) -> Status:
        return self._box.status()

    def note_refused(self, _refused: Refusal | bytes) -> None:
        """Nobody reads the log here."""

    def order(self, order: Order) -> Refusal | None:
        return self._box.order(order, Source("console", 1))


def test_transcript_of_a_stop_at_the_box(box: BenchBox) -> None:
    person, link = ConsoleSession(AtTheBox(box)), Gs232Session(box, Dialect.B)

    def turns_within(seconds: float) -> bool:
        box.turned.clear()
        box.wait(seconds)
        return bool(box.turned)

    assert person.receive(b"stop\n") == [b"ok\n"]
    assert link.receive(b"W300 025\r") == []  # admitted, as ever
    assert link.receive(b"S\r") == []
    assert link.receive(b"W300 025\r") == []
    assert link.receive(b"C2\r") == [b"AZ=235  EL=025\r\n"]
    assert not turns_within(20)
    assert person.receive(b"point 300 25\n") == [b"error: stopped by a rotator command: nothing moves until resume\n"]
    assert person.receive(b"jog cw 1\n") == [b"error: stopped by a rotator command: nothing moves until resume\n"]
    assert person.receive(b"home azimuth\n") == [b"error: stopped by a rotator command: nothing moves until resume\n"]
    assert person.receive(b"park\n") == [b"error: stopped by a rotator command: nothing moves until resume\n"]
    assert not turns_within(20)
    assert person.receive(b"resume\n") == [b"ok\n"]
    assert not turns_within(20)
    assert link.receive(b"W300 025\r") == []
    assert turns_within(1)
    assert "moved by: link" in told(person)


def test_what_follows_resume_need_not_wait_for_the_status(new_box: type[BenchBox]) -> None:
    box = new_box(at_once=False)
    session = ConsoleSession(AtTheBox(box))
    session.receive(b"stop\n")
    box.wait(0.5)
    assert session.receive(b"resume\npoint 100 20\n") == [b"ok\n", b"ok\n"]
    box.wait(1)
    assert box.turned == set(Axis)


def test_a_later_stop_by_another_command_is_told_too(box: BenchBox) -> None:
    session = ConsoleSession(AtTheBox(box))
    assert session.receive(b"stop\nresume\n") == [b"ok\n"] * 2
    box.wait(0.5)
    assert ConsoleSession(AtTheBox(box)).receive(b"stop\n") == [b"ok\n"]
    assert session.receive(b"park\n") == [b"error: stopped by a rotator command: nothing moves until resume\n"]


def test_a_storm_park_holds_like_a_stop(box: BenchBox) -> None:
    session = ConsoleSession(AtTheBox(box))
    assert session.receive(b"park\n") == [b"ok\n"]
    why = b"error: storm park by a rotator command: nothing else moves it until resume\n"
    assert session.receive(b"point 300 25\n") == [why]
