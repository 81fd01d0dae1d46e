"""SPID controllers on a box: what moves, what is answered, and transcripts of Hamlib 4.5.4."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Stop
from rotator.protocols.session import Session
from rotator.protocols.spid import Command, Frame, Model, SpidSession, Turn, encode
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
ROT1, ROT2, MD01 = Model.ROT1PROG, Model.ROT2PROG, Model.MD01
STATUS = bytes.fromhex("57 00 00 00 00 00 00 00 00 00 00 1F 20")
STOP = bytes.fromhex("57 00 00 00 00 00 00 00 00 00 00 0F 20")
HERE = {  # 235 and 25
    ROT1: bytes.fromhex("57 05 09 05 20"),
    ROT2: bytes.fromhex("57 05 09 05 00 02 03 08 05 00 02 20"),
    MD01: bytes.fromhex("57 05 09 05 00 0A 03 08 05 00 0A 20"),
}
LEFT, RIGHT = Jog(Axis.AZIMUTH, Direction.MINUS), Jog(Axis.AZIMUTH, Direction.PLUS)
UP, DOWN = Jog(Axis.ELEVATION, Direction.PLUS), Jog(Axis.ELEVATION, Direction.MINUS)


def test_rot1prog(box: BenchBox, feed: Feed) -> None:
    """rotctl -m 902 P 123.7 45 p S: elevation is not for this one."""
    session = SpidSession(box, ROT1)
    assert feed(session, bytes.fromhex("57 34 38 33 30 00 00 00 00 00 00 2F 20")) == []
    assert feed(session, STATUS) == [HERE[ROT1]]
    assert feed(session, STOP) == [HERE[ROT1]]
    assert box.orders == [Aim(123, None), Stop()]


def test_rot2prog(box: BenchBox, feed: Feed) -> None:
    """rotctl -m 901 P 123.5 77 p S: it asks for the pulses first, and wants no answer to the set."""
    session = SpidSession(box, ROT2)
    assert feed(session, STATUS) == [HERE[ROT2]]
    assert feed(session, bytes.fromhex("57 30 39 36 37 02 30 38 37 34 02 2F 20")) == []
    assert feed(session, STATUS) == [HERE[ROT2]]
    assert feed(session, STOP) == [HERE[ROT2]]
    assert box.orders == [Aim(123.5, 77), Stop()]


def test_md_01(box: BenchBox, feed: Feed) -> None:
    """rotctl -m 903 P 123.5 77 M LEFT 50: the set is answered; a move comes behind a stop and with garbage in it."""
    session = SpidSession(box, MD01)
    assert feed(session, bytes.fromhex("57 34 38 33 35 0A 34 33 37 30 0A 2F 20")) == [HERE[MD01]]
    assert feed(session, STOP) == [HERE[MD01]]
    assert feed(session, bytes.fromhex("57 01 00 00 00 7F 00 00 00 00 AC 14 20")) == []
    assert box.orders == [Aim(123.5, 77), Stop(), LEFT]


@every_row(
    ("turn", "jogs"),
    [
        (Turn.LEFT, [LEFT]),
        (Turn.RIGHT, [RIGHT]),
        (Turn.UP, [UP]),
        (Turn.DOWN, [DOWN]),
        (Turn.LEFT | Turn.UP, [LEFT, UP]),
        (Turn.RIGHT | Turn.DOWN, [RIGHT, DOWN]),
    ],
)
def test_md_01_turns_both_axes_at_once(new_box: type[BenchBox], turn: Turn, jogs: list[Order]) -> None:
    box = new_box(at=(235, 25))
    assert SpidSession(box, MD01).receive(encode(Frame(Command.MOVE, turn=turn), MD01, 10)) == []
    assert box.orders == jogs


@pytest.mark.parametrize("pulses", [1, 2, 4, 10])
def test_the_pulses_that_it_says_are_those_that_it_takes(box: BenchBox, pulses: int) -> None:
    session = SpidSession(box, ROT2, pulses)
    (reply,) = session.receive(STATUS)
    assert reply[5] == reply[10] == pulses
    session.receive(encode(Frame(Command.SET, 123.5, 77.25), ROT2, reply[5]))
    (aim,) = box.orders
    assert isinstance(aim, Aim)
    assert aim.azimuth_deg == pytest.approx(123.5, abs=0.5 / pulses + 0.01)
    assert aim.elevation_deg == pytest.approx(77.25, abs=1 / pulses)


@every_row(
    ("azimuth_deg", "elevation_deg", "order"),
    [
        (-90, 20, Aim(270, 20)),
        (400, 20, Aim(400, 20)),
        (540, 20, Aim(540, 20)),
        (10, 170, Aim(10, 170)),
        (10, -20, Aim(10, -20)),
        (541, 20, None),
        (-181, 20, None),
        (10, 181, None),
        (10, -91, None),
    ],
)
def test_how_far_a_set_may_go(
    new_box: type[BenchBox], azimuth_deg: float, elevation_deg: float, order: Order | None
) -> None:
    box = new_box((0, 540))
    SpidSession(box, MD01).receive(encode(Frame(Command.SET, azimuth_deg, elevation_deg), MD01, 10))
    assert box.orders == ([order] if order else [])
