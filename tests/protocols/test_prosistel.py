"""Prosistel's boxes: the bytes that Hamlib sends and reads, and damaged commands."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from hw.ports import Axis
from rotator.exchange.orders import Aim, Order, Stop
from rotator.protocols.prosistel import Model, ProsistelSession
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]


@every_row(
    ("model", "said", "answers", "orders"),
    [
        (Model.D, b"\x02A?\r", [b"\x02A,?,235,R\r"], []),
        (Model.D, b"\x02E?\r", [b"\x02E,?,025,R\r"], []),
        (Model.D, b"\x02AS\r\x02ES\r", [b"\x02A,S,R\r", b"\x02E,S,R\r"], []),
        (Model.D, b"\x02AG75\r", [b"\x02A,G,R\r"], [Aim(75, None)]),
        (Model.D, b"\x02AG005\r", [b"\x02A,G,R\r"], [Aim(5, None)]),
        (Model.D, b"\x02EG10\r", [b"\x02E,G,R\r"], [Aim(None, 10)]),
        (Model.D, b"\x02AG997\r", [b"\x02A,G,R\r"], [Stop((Axis.AZIMUTH,))]),
        (Model.D, b"\x02EG999\r", [b"\x02E,G,R\r"], [Stop((Axis.ELEVATION,))]),
        (Model.D, b"\x02AG999\r\x02EG999\r", [b"\x02A,G,R\r", b"\x02E,G,R\r"], [Stop((Axis.AZIMUTH,)), Stop()]),
        (Model.D, b"\x02BG10\r\x02B?\r", [], []),
        (Model.D, b"\x02AG600\r", [b"\x02A,G,E,00003\r"], []),
        (Model.COMBI_TRACK, b"\x02A?\r\x02B?\r", [b"\x02A,?,2350,R\r", b"\x02B,?,0250,R\r"], []),
        (
            Model.COMBI_TRACK,
            b"\x02AG755\r\x02BG105\r",
            [b"\x02A,G,R\r", b"\x02B,G,R\r"],
            [Aim(75.5, None), Aim(None, 10.5)],
        ),
        (
            Model.COMBI_TRACK,
            b"\x02AG9777\r\x02BG9777\r",
            [b"\x02A,G,R\r", b"\x02B,G,R\r"],
            [Stop((Axis.AZIMUTH,)), Stop()],
        ),
        (Model.COMBI_TRACK, b"\x02EG10\r", [], []),
    ],
)
def test_dialogues(  # noqa: PLR0917 - a table
    new_box: type[BenchBox], feed: Feed, model: Model, said: bytes, answers: list[bytes], orders: list[Order]
) -> None:
    box = new_box(at=(235, 25))
    assert feed(ProsistelSession(box, model), said) == answers
    assert box.orders == orders


def test_it_says_that_it_turns(box: BenchBox) -> None:
    session = ProsistelSession(box, Model.D)
    session.receive(b"\x02AG75\r")
    box.wait(1)
    assert session.receive(b"\x02A?\r\x02E?\r") == [b"\x02A,?,235,B\r", b"\x02E,?,025,R\r"]


@every_row(
    "said",
    [b"AG75\r", b"\x02AG7x\r", b"\x02A G75\r", b"\x02AG-5\r", b"\x02AG\r", b"\x02ag75\r", b"\x02AG75", b"\x02AG75\n",
     b"\x02AG00075\r", b"\x02AG7.5\r", b"\x02\x02\r", b"\x02A\x02G75\r", b"\x02" + b"A" * 100 + b"G75\r"],
)  # fmt: skip
def test_damaged_commands_move_nothing(new_box: type[BenchBox], said: bytes) -> None:
    box = new_box(at=(235, 25))
    ProsistelSession(box, Model.D).receive(said)
    assert box.orders == []
