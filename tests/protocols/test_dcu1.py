"""The DCU-1 protocol as Hy-Gain, Idiom Press and Green Heron have it, and transcripts of Hamlib 4.5.4."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rotator.exchange.orders import Aim, Order, Stop
from rotator.protocols.dcu1 import VERBS, Dcu1Session, azimuth_reply, tenths_reply
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
HERE, TENTHS = b";235", b"235.0;"

ROWS: list[tuple[bytes, list[bytes], list[Order]]] = [
    (b"AP1123;AM1;", [], [Aim(123, None)]),
    (b"AP1123;", [], []),
    (b"AM1;", [], []),
    (b"AP1123;AM1;AM1;", [], [Aim(123, None), Aim(123, None)]),
    (b"AP1123;;AM1;", [], [Stop()]),  # what is stopped goes nowhere without a new target
    (b"AP1123\r", [], [Aim(123, None)]),
    (b"AP1123\r\n", [], [Aim(123, None)]),
    (b"AP1123\r;", [], [Aim(123, None), Stop()]),
    (b"AP1123.4\r;", [], [Aim(123.4, None)]),
    (b"AP1123.4\r;;", [], [Aim(123.4, None), Stop()]),
    (b"AP1123.4;AM1;", [], [Aim(123.4, None)]),
    (b"AP1000;AM1;", [], [Aim(0, None)]),
    (b"AP1360;AM1;", [], [Aim(360, None)]),
    (b"AI1;", [HERE], []),
    (b"AI1\r", [HERE], []),
    (b"\r\nAI1;\r\nAI1;", [HERE, HERE], []),
    (b"BI1;", [TENTHS], []),
    (b";", [], [Stop()]),
    (b"AS1;", [], [Stop()]),
    (b"\r", [], []),
    (b"\r\n\r\n", [], []),
    (b"\xe0\x00 ;", [], [Stop()]),
    (b"\0" * 100 + b";", [], [Stop()]),
    (b"\xe0AP1123\r", [], [Aim(123, None)]),
    (b"AP1361;AM1;", [], []),
    (b"AP1400\r", [], []),
    (b"AP123;AM1;", [], []),
    (b"AP19;AM1;", [], []),
    (b"AP1x23;AM1;", [], []),
    (b"AP1 23;AM1;", [], []),
    (b"AP11234;AM1;", [], []),
    (b"AP1-10;AM1;", [], []),
    (b"AP1\xb223;AM1;", [], []),
    (b"AP1\n123;AM1;", [], []),
    (b"ap1123;am1;", [], []),
    (b"ai1;", [], []),
    (b"AP1;AM1;", [], []),
    (b"AM;AI;XX1;AI10;", [], []),
    (b"Z" * 100 + b"AM1;", [], []),
    (b"AP1123;" + b"Z" * 17 + b";AM1;", [], [Aim(123, None)]),
]


def test_every_row_of_the_table_is_tried_above() -> None:
    said = {command for sent, _, _ in ROWS for command in sent.split(b";")}
    assert [verb.text for verb in VERBS if not any(command[:3] == verb.text.encode() for command in said)] == []


def test_each_line(new_box: type[BenchBox], feed: Feed) -> None:
    for sent, replies, orders in ROWS:
        box = new_box(at=(235, 25))
        assert feed(Dcu1Session(box), sent) == replies, sent
        assert box.orders == orders, sent


@every_row(
    ("wire", "orders"),
    [
        # 401 Rotor-EZ and 402 RotorCard
        ([(b"AP1123;", []), (b"AM1;", []), (b"AI1;", [HERE]), (b";", [])], [Aim(123, None), Stop()]),
        # 403 DCU-1: no position
        ([(b"AP1123;", []), (b"AM1;", []), (b"AS1;", [])], [Aim(123, None), Stop()]),
        # 404 ERC and 406 YRC-1
        ([(b"AP1123;", []), (b"AM1;", []), (b"AI1;", [HERE]), (b"AS1;", [])], [Aim(123, None), Stop()]),
        # 405 RT-21
        ([(b"AP1123.0\r;", []), (b"BI1;", [TENTHS]), (b";", [])], [Aim(123, None), Stop()]),
    ],
)
def test_hamlib(
    new_box: type[BenchBox], feed: Feed, wire: list[tuple[bytes, list[bytes]]], orders: list[Order]
) -> None:
    box = new_box(at=(235, 25))
    session = Dcu1Session(box)
    for sent, replies in wire:
        assert feed(session, sent) == replies
    assert box.orders == orders


def test_a_semicolon_that_comes_later_is_a_stop(box: BenchBox) -> None:
    session = Dcu1Session(box)
    session.receive(b"AP1123.4\r")
    session.idle()
    session.receive(b";")
    assert box.orders == [Aim(123.4, None), Stop()]


@every_row(
    ("azimuth_deg", "whole", "tenths"),
    [
        (235.04, b";235", b"235.0;"),
        (5.0, b";005", b" 5.0;"),
        (0.0, b";000", b" 0.0;"),
        (359.96, b";000", b" 0.0;"),
        (360.0, b";000", b" 0.0;"),
        (400.5, b";041", b"40.5;"),
        (-10.0, b";350", b"350.0;"),
    ],
)
def test_positions(azimuth_deg: float, whole: bytes, tenths: bytes) -> None:
    assert azimuth_reply(azimuth_deg) == whole
    assert tenths_reply(azimuth_deg) == tenths
