"""Hamlib's rotctld, the part that every client uses: `P p S K _ q` and `\\dump_state`, and what real clients send.

Transcripts are of the genuine server 4.5.4, of Hamlib's own network client and of Gpredict 2.3. Where the genuine one
says nothing at all, this one answers: Gpredict's window freezes on silence.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis
from rotator import __version__
from rotator.exchange.orders import Aim, Order, Park, Stop
from rotator.protocols.rotctld_caps import limits
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
OK, INVALID, NOT_IMPLEMENTED, IO_ERROR = b"RPRT 0\n", b"RPRT -1\n", b"RPRT -4\n", b"RPRT -6\n"
HERE = b"235.00\n25.00\n"
INFO = b"gs232-rotator %s\n" % __version__.encode()
HYBRID = (
    b"1\n603\n0.000000\n450.000000\n0.000000\n180.000000\n0\n"  # Hamlib up to 4.5.0 reads four bare numbers
    b"min_az=0.000000\nmax_az=450.000000\nmin_el=0.000000\nmax_el=180.000000\nsouth_zero=0\nrot_type=AzEl\ndone\n"
)

ROWS: list[tuple[bytes, list[bytes], list[Order]]] = [
    (b"p", [HERE], []),
    (b"\\get_pos", [HERE], []),
    (b"  p\t", [HERE], []),
    (b"pp", [HERE, HERE], []),
    (b"P 12 5", [OK], [Aim(12, 5)]),
    (b"\\set_pos 12 5", [OK], [Aim(12, 5)]),
    (b"P20 10", [OK], [Aim(20, 10)]),
    (b"P\t20 \t10 ", [OK], [Aim(20, 10)]),
    (b"P 12,5 3,25", [OK], [Aim(12.5, 3.25)]),
    (b"P +10 1e1", [OK], [Aim(10, 10)]),
    (b"P .5 5.", [OK], [Aim(0.5, 5)]),
    (b"P 1 2 P 3 4", [OK, OK], [Aim(1, 2), Aim(3, 4)]),
    (b"p S p", [HERE, OK, HERE], [Stop()]),
    (b"P -90 20", [OK], [Aim(270, 20)]),
    (b"P -180 20", [OK], [Aim(180, 20)]),
    (b"P 400 20", [OK], [Aim(400, 20)]),
    (b"P 191.72 180.00", [OK], [Aim(191.72, 180)]),  # Gpredict, waiting for a flipped pass
    (b"P 10 -5", [OK], [Aim(10, -5)]),
    (b"S", [OK], [Stop()]),
    (b"\\stop", [OK], [Stop()]),
    (b"K", [OK], [Park()]),
    (b"_", [INFO], []),
    (b"\\get_info", [INFO], []),
    (b"\\dump_state", [HYBRID], []),
    (b"\x8f", [HYBRID], []),
    (b"", [], []),
    (b" \t ", [], []),
    (b"# P 10 20", [], []),
    (b"p # P 10 20", [HERE], []),
    (b"P abc def", [INVALID], []),
    (b"P 10abc 5", [INVALID], []),
    (b"P nan nan", [INVALID], []),
    (b"P inf 10", [INVALID], []),
    (b"P 10 infinity", [INVALID], []),
    (b"P 1_0 20", [INVALID], []),
    (b"P 0x10 20", [INVALID], []),
    (b"P 1e9 20", [INVALID], []),
    (b"P 1000 1000", [INVALID], []),
    (b"P 10 200", [INVALID], []),
    (b"P 12.5", [INVALID], []),
    (b"P", [INVALID], []),
    (b"z", [NOT_IMPLEMENTED], []),
    (b"foo", [NOT_IMPLEMENTED], []),
    (b"\\foo", [NOT_IMPLEMENTED], []),
    (b"\\", [NOT_IMPLEMENTED], []),
    (b"\\chk_vfo", [NOT_IMPLEMENTED], []),
    (b"?", [NOT_IMPLEMENTED], []),
    (b"W235 025", [NOT_IMPLEMENTED], []),
    (b"Z" * 86, [NOT_IMPLEMENTED], []),
    (b"P\xa0235\xa025", [INVALID], []),  # a no-break space separates nothing, here as in C
    (b"P 235\x1c25", [INVALID], []),
    (b"P 235\x8525", [INVALID], []),
    (b"x" * 600, [INVALID], []),
]


@pytest.fixture
def session(box: BenchBox) -> RotctldSession:
    return RotctldSession(box)


@every_row(("line", "replies", "orders"), ROWS)
def test_each_request(new_box: type[BenchBox], line: bytes, replies: list[bytes], orders: list[Order]) -> None:
    whole = [line + end for end in (b"\n", b"\r\n")]
    for pieces in [[each] for each in whole] + [[bytes([byte]) for byte in each] for each in whole]:
        box = new_box(at=(235, 25))
        session = RotctldSession(box)
        assert [reply for piece in pieces for reply in session.receive(piece)] == replies
        assert box.orders == orders


@pytest.mark.parametrize("word", [b"KEEPALIVE", b"Kx", b"KP"])
def test_a_word_that_only_begins_like_a_request_moves_nothing(
    box: BenchBox, session: RotctldSession, word: bytes
) -> None:
    """The genuine server goes through it letter by letter, and parks at the first. A stop may count even so."""
    assert session.receive(word + b"\n") in ([NOT_IMPLEMENTED], [INVALID])
    assert box.motions == []


GPREDICT = [
    (b"p\n", [HERE]),
    (b"P 180.00 45.00\n", [OK]),
    (b"p\n", [HERE]),
    (b"P 191.72 180.00\n", [OK]),
    (b"S\n", [OK]),
    (b"q\n", []),
]
NET_ROTCTL = [
    (b"\\dump_state\n", [HYBRID]),
    (b"P 235.000000 25.000000\n", [OK]),
    (b"p\n", [HERE]),
    (b"_\n", [INFO]),
    (b"K\n", [OK]),
    (b"S\n", [OK]),
    (b"q\n", []),
]


@pytest.mark.parametrize("wire", [GPREDICT, NET_ROTCTL], ids=["Gpredict 2.3", "rotctl -m 2"])
def test_transcripts(session: RotctldSession, feed: Feed, wire: list[tuple[bytes, list[bytes]]]) -> None:
    for sent, replies in wire:
        assert not session.closed
        assert feed(session, sent) == replies
    assert session.closed


@pytest.mark.parametrize("after", [b"p\n", b"P 10 20\n", b"foo\n", b"P x y\n", b"z" * 600 + b"\n"])
def test_after_q_nothing_is_heard_and_nothing_said(box: BenchBox, session: RotctldSession, after: bytes) -> None:
    assert session.receive(b"q\n" + after) == []
    assert session.closed
    assert session.receive(after) == []
    assert box.orders == []


@pytest.mark.parametrize(
    ("sent", "replies"),
    [(b"p", [HERE]), (b"P 180.00 45.00", [OK]), (b"S", [OK]), (b"\\get_pos", [HERE]), (b"P 174,46 0,00", [OK])],
)
def test_a_whole_request_and_then_silence_is_taken_as_sent(
    session: RotctldSession, sent: bytes, replies: list[bytes]
) -> None:
    """Gpredict's Windows builds up to 2018 strip the newline."""
    assert session.idle_s is not None
    assert 0.05 <= session.idle_s <= 0.1
    assert session.receive(sent) == []
    assert session.idle() == replies
    assert session.idle() == []
    assert session.receive(b"\n") == []


@pytest.mark.parametrize(
    "begun", [b"P", b"P 180.00", b"P 180.00 ", b"P 180.00 -", b"\\set_p", b"P 10 4e", b"foo", b" "]
)
def test_silence_does_not_end_what_is_only_begun(box: BenchBox, session: RotctldSession, begun: bytes) -> None:
    session.receive(begun)
    assert session.idle() == []
    assert box.orders == []


def test_what_silence_left_alone_can_still_be_completed(box: BenchBox, session: RotctldSession) -> None:
    session.receive(b"P 180.00")
    session.idle()
    assert session.receive(b" 45.00\n") == [OK]
    assert box.orders == [Aim(180, 45)]


def test_positions_have_two_decimals(new_box: type[BenchBox]) -> None:
    box = new_box()
    box.stands_at(123.456, 7.004)
    assert RotctldSession(box).receive(b"p\n") == [b"123.46\n7.00\n"]


@every_row(
    ("azimuth", "elevation", "told"),
    [
        ((0, 450), (0, 180), (0, 450, 0, 180)),
        ((0, 360), (0, 90), (0, 360, 0, 180)),  # a direction past the zenith is turned into one before it
        ((-180, 180), (0, 180), (-180, 360, 0, 180)),
        ((-5, 500), (-5, 210), (-5, 500, -5, 210)),
        ((180, 540), (-10, 90), (0, 540, -10, 180)),  # below zero only if need be: CQRLOG would shift its scale
    ],
)
def test_dump_state_tells_what_the_box_accepts(
    new_box: type[BenchBox], azimuth: tuple[float, float], elevation: tuple[float, float], told: tuple[float, ...]
) -> None:
    (state,) = RotctldSession(new_box(azimuth, elevation)).receive(b"\\dump_state\n")
    rows = state.decode().split("\n")
    assert rows[:2] == ["1", "603"]
    assert tuple(map(float, rows[2:6])) == told
    assert tuple(float(row.partition("=")[2]) for row in rows[7:11]) == told
    assert all(len(row) <= 62 for row in rows)


def test_a_rotor_without_elevation_reports_the_sky_too(box: BenchBox) -> None:
    """With 0 to 0 a client of Hamlib sends nothing while a satellite is up."""
    status = box.status()
    level = replace(status, elevation=replace(status.elevation, min_deg=0.0, max_deg=0.0, fitted=False))
    assert (limits(level)["min_el"], limits(level)["max_el"]) == (0.0, 180.0)


# --- faults


@pytest.mark.parametrize("line", [b"P 100 20", b"K", b"M CW -1", b"M UP_LEFT -1"])
def test_an_order_that_no_axis_can_carry_out_is_rejected(new_box: type[BenchBox], line: bytes) -> None:
    box = new_box(blind=True)
    box.wait(1.0)
    assert len(box.status().faults) == 2
    session = RotctldSession(box)
    assert session.receive(line + b"\n") == [b"RPRT -9\n"]
    assert session.receive(b"S\n") == [OK], "a stop is always carried out"


def test_an_order_that_one_of_its_axes_cannot_carry_out_is_rejected_whole(new_box: type[BenchBox]) -> None:
    box = new_box(at=(235, 25))
    box.breaks(Axis.ELEVATION)
    assert [fault.axis for fault in box.status().faults] == [Axis.ELEVATION]
    session = RotctldSession(box)
    assert session.receive(b"P 100 20\nM UP -1\nM UP_LEFT -1\n") == [b"RPRT -9\n"] * 3
    assert box.orders == []
    assert session.receive(b"M CW -1\n") == [OK], "the other axis alone obeys"
