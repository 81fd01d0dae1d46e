"""M2's RC2800PX: the bytes that Hamlib sends and reads, and damaged commands."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rotator.exchange.orders import Aim, Order, Stop
from rotator.protocols.rc2800 import Rc2800Session
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
HERE_A, HERE_E = b"A P= 235.0 S=9 S\r", b"E P=  25.0 S=9 S\r"


@every_row(
    ("said", "answers", "orders"),
    [
        (b"A\r", [HERE_A], []),
        (b"E\r", [HERE_E], []),
        (b"A\r\nE\r\n", [HERE_A, HERE_E], []),
        (b"A75.000000\r", [HERE_A], [Aim(75, None)]),
        (b"A75\r", [HERE_A], [Aim(75, None)]),
        (b"E10\r", [HERE_E], [Aim(None, 10)]),
        (b"E25\rA\rS\r", [HERE_E, HERE_A, HERE_A], [Aim(None, 25), Stop()]),
        (b"E200\r", [b"E ERR=05\r"], []),
        (b"\xff\x00A\r", [HERE_A], []),
    ],
)
def test_dialogues(new_box: type[BenchBox], feed: Feed, said: bytes, answers: list[bytes], orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    replies = feed(Rc2800Session(box), said)
    assert [reply.replace(b"=9 M", b"=9 S") for reply in replies] == answers
    assert box.orders == orders


@every_row(
    "said",
    [b"235\r", b"A\r235\r\r", b"A2x5\r", b"A-5\r", b"a235\r", b"AA235\r", b"A1234\r", b"A235", b"A 235\r", b"A235E10\r",
     b"S235\r", b"A" + b"1" * 100 + b"\r", b"\r\r\r"],
)  # fmt: skip
def test_damaged_commands_move_nothing(new_box: type[BenchBox], said: bytes) -> None:
    box = new_box(at=(235, 25))
    Rc2800Session(box).receive(said)
    assert box.orders == []
