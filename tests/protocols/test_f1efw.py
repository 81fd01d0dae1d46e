"""The F1EFW dialect: what the Arduino firmware that this box replaces makes of its serial line.

Its author's description: `W` or `w` found anywhere in the received string, then azimuth and elevation; every other
command ignored; no replies; both motors stopped at zero or negative elevation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.session import Session

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
AT_REST = {Axis.AZIMUTH: Direction.OFF, Axis.ELEVATION: Direction.OFF}

HEARD = [
    (b"W235 025\r", [(235, 25)]),  # OscarWatch, PstRotator, WispDDE
    (b"W235 025\r\n", [(235, 25)]),  # SDRangel
    (b"W235 025\n", [(235, 25)]),
    (b"w235 025\r", [(235, 25)]),
    (b"W5 7\r", [(5, 7)]),
    (b"W005   007\r", [(5, 7)]),
    (b"W235,025\r", [(235, 25)]),
    (b"W235\t025\r", [(235, 25)]),
    (b"W235 , 025\r", [(235, 25)]),
    (b"W450 180\r", [(450, 180)]),
    (b"xyzW235 025\r", [(235, 25)]),  # anywhere
    (b"\0\xffWWW235 025 ;", [(235, 25)]),
    (b"C2\rS\rW235 025\rC2\r", [(235, 25)]),
    (b"W100 010W200 020\r", [(100, 10), (200, 20)]),
    (b"W100 010\rW200 020\rW300 030\r", [(100, 10), (200, 20), (300, 30)]),
    (b"W12 W235 025\r", [(235, 25)]),
    (b"W235 025.7\r", [(235, 25)]),
    (b"W235025\r", [(235, 25)]),
    (b"w 235 25\r", [(235, 25)]),
    (b"W  235025;", [(235, 25)]),
]
IGNORED = [
    b"W\r",
    b"Z" * 86 + b"\r",
    b"W1x0 020\r",
    b"W200 181\r",
    b"W451 020\r",
    b"W235\r",
    b"W2355 025\r",
    b"W235 0255\r",
    b"W-10 025\r",
    b"W235 x025\r",
    b"W235\r025\r",
    b"W235\n025\r",
    b"W235.0 025\r",
    b"235 025\r",
    b"M235\rR\rL\rU\rD\rS\rA\rE\rC\rC2\rH\rO\rF\r",
    b"AZ235.0 EL25.0\n",
    b"W\xb2\xb35 025\r",
]


@pytest.fixture
def session(box: BenchBox) -> F1efwSession:
    return F1efwSession(box)


@pytest.mark.parametrize(("sent", "aims"), HEARD)
def test_finds_its_orders_anywhere_and_answers_nothing(
    box: BenchBox, session: F1efwSession, feed: Feed, sent: bytes, aims: list[tuple[int, int]]
) -> None:
    assert feed(session, sent) == []
    assert box.orders == [Aim(*aim) for aim in aims]


@pytest.mark.parametrize("sent", IGNORED)
def test_ignores_everything_else(box: BenchBox, session: F1efwSession, feed: Feed, sent: bytes) -> None:
    assert feed(session, sent) == []
    assert session.idle() == []
    assert box.orders == []
    assert box.turned == set()


@pytest.mark.parametrize("cut", range(1, 17))
def test_an_order_may_cross_a_packets_border_anywhere(box: BenchBox, session: F1efwSession, cut: int) -> None:
    longest = b"W235        -025"
    session.receive(b"rubbish " * 20 + longest[:cut])
    assert box.orders == []
    session.receive(longest[cut:])
    assert box.orders == [], "another digit may still come"
    session.receive(b"\r")
    assert box.orders == [Aim(235, -25, engaged=False)]
    session.receive(b"\r\r")
    assert len(box.orders) == 1


def test_without_a_line_end_it_waits_as_long_as_an_arduino(box: BenchBox, session: F1efwSession) -> None:
    """By hand from Termite, which may be set to append nothing: `Serial.readString` gives up after a second."""
    assert session.idle_s == 1.0
    session.receive(b"W235 025")
    assert box.orders == []
    assert session.idle() == []
    assert box.orders == [Aim(235, 25)]
    session.idle()
    session.receive(b"\r")
    assert len(box.orders) == 1, "what was taken for whole is not taken again"


def test_what_silence_has_cut_off_is_not_put_together_again(box: BenchBox, session: F1efwSession) -> None:
    session.receive(b"W235")
    session.idle()
    session.receive(b" 025\r")
    assert box.orders == []


@pytest.mark.long
@pytest.mark.parametrize("order", [b"W100 000\r", b"W100 -01\r", b"W100 -5\r", b"W100 -90\r"])
def test_at_zero_or_negative_elevation_both_motors_stop(box: BenchBox, session: F1efwSession, order: bytes) -> None:
    session.receive(b"W300 090\r")
    assert box.driven == {Axis.AZIMUTH: Direction.PLUS, Axis.ELEVATION: Direction.PLUS}
    session.receive(order)
    assert box.driven == AT_REST
    box.wait(60)
    assert box.driven == AT_REST
    assert box.status().wanted_azimuth_deg == 100, "shown all the same"
