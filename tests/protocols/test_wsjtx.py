"""azel.dat as WSJT-X writes it, now and of old; when it is an order, and when it is stale."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.exchange.orders import Aim
from rotator.protocols.wsjtx import DAY_S, BodyDirection, WsjtxSession, encode, parse
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

NOW = (
    b"17:03:22,123.4, 45.6,Moon\n"
    b"17:03:22,200.0,-12.3,Sun\n"
    b"17:03:22, 10.5, -5.3,Source\n"
    b" 144,   -35,Doppler\n"
    b"125,0,fQSO\n"
    b"125,0,fQSO2"
)
WITH_ZEROS = NOW.replace(b", ", b",0")
OF_OLD = (
    b"170:030:220000,123.40000,045.6,Moon\n"
    b"170:030:220000,200.00000,-12.3,Sun\n"
    b"170:030:220000,000.00000,000.0,Sun\n"
    b" 144,   -35,Doppler\n"
)
AT_S = 17 * 3600 + 3 * 60 + 22


def moon(second_of_day: int, azimuth_deg: float, elevation_deg: float) -> bytes:
    return encode("Moon", BodyDirection(second_of_day, azimuth_deg, elevation_deg))


@every_row("text", [NOW, WITH_ZEROS, NOW.replace(b"\n", b"\r\n"), OF_OLD, NOW.replace(b",123", b", 123")])
def test_the_moon(text: bytes) -> None:
    assert parse(text, "Moon") == BodyDirection(AT_S, 123.4, 45.6)


@every_row(
    ("text", "body", "place"),
    [
        (NOW, "Sun", BodyDirection(AT_S, 200.0, -12.3)),
        (NOW, "Source", BodyDirection(AT_S, 10.5, -5.3)),
        (WITH_ZEROS, "Source", BodyDirection(AT_S, 10.5, -5.3)),
        (b"02:59:48,198.9, 61.9,Moon\n", "Moon", BodyDirection(2 * 3600 + 59 * 60 + 48, 198.9, 61.9)),
        (OF_OLD, "Sun", BodyDirection(AT_S, 200.0, -12.3)),
        (OF_OLD, "Source", None),
        (b"", "Moon", None),
    ],
)
def test_bodies(text: bytes, body: str, place: BodyDirection | None) -> None:
    assert parse(text, body) == place


@pytest.mark.parametrize("body", ["Moon", "Sun", "Source"])
def test_half_a_file_says_only_what_is_whole(body: str) -> None:
    whole = parse(NOW, body)
    places = [parse(NOW[:end], body) for end in range(len(NOW) + 1)]
    assert {place for place in places if place} == {whole}
    assert places[NOW.index(b"," + body.encode() + b"\n") + 1 + len(body)] is None, "the line has not ended"


@given(st.integers(0, DAY_S - 1), st.integers(0, 3600), st.integers(-900, 900))
def test_reads_what_it_writes(second_of_day: int, azimuth_tenths: int, elevation_tenths: int) -> None:
    place = BodyDirection(second_of_day, azimuth_tenths / 10, elevation_tenths / 10)
    assert parse(encode("Moon", place), "Moon") == place


@every_row(
    "line",
    [b"17:03:22,1x3.4,045.6,Moon\n", b"17:03:22,,045.6,Moon\n", b"17:03:22,123.4,Moon\n", b"17:03,123.4,045.6,Moon\n",
     b"17:03:22,123.4,0-5-3,Moon\n", b"17:03:22,900.0,045.6,Moon\n", b"17:03:22,123.4,095.6 ,moon\n",
     b"17:03:22,nan,045.6,Moon\n"],
)  # fmt: skip
def test_a_damaged_line_is_none(line: bytes) -> None:
    assert parse(line, "Moon") is None


# --- what is an order


def test_what_it_says_first_is_no_order_and_then_every_second(box: BenchBox) -> None:
    session = WsjtxSession(box, "Moon")
    assert session.receive(moon(100, 120.0, 10.0)) == []
    assert box.orders == []
    session.receive(moon(101, 120.0, 10.0))
    session.receive(moon(102, 120.1, 10.1))
    assert box.orders == [Aim(120.0, 10.0), Aim(120.1, 10.1)]


def test_a_file_that_is_no_longer_written_is_stale(box: BenchBox) -> None:
    """Copied, touched, restored, or written again after a night: the first look only tells that it lives."""
    session = WsjtxSession(box, "Moon")
    session.receive(moon(100, 120.0, 10.0))
    session.receive(moon(100, 130.0, 10.0))  # another place, and the same second
    session.receive(moon(90, 130.0, 10.0))  # an older file
    session.receive(moon(101, 130.0, 10.0))  # eleven seconds on
    assert box.orders == []
    session.receive(moon(111, 140.0, 10.0))
    assert box.orders == [Aim(140.0, 10.0)]


def test_midnight_is_no_pause(box: BenchBox) -> None:
    session = WsjtxSession(box, "Moon")
    session.receive(moon(DAY_S - 1, 120.0, 10.0))
    session.receive(moon(0, 120.0, 10.0))
    assert box.orders == [Aim(120.0, 10.0)]


def test_only_the_body_that_is_wanted(box: BenchBox) -> None:
    session = WsjtxSession(box, "Sun")
    session.receive(NOW)
    session.receive(NOW.replace(b":22,", b":23,"))
    assert box.orders == [Aim(200.0, -12.3)]
    box.wait(0.5)
    assert (box.status().azimuth.target_deg, box.status().elevation.target_deg) == (200, 0), "down: elevation rests"


def test_a_half_written_file_moves_nothing_and_loses_nothing(box: BenchBox) -> None:
    session = WsjtxSession(box, "Moon")
    session.receive(moon(100, 120.0, 10.0))
    session.receive(b"")
    session.receive(moon(101, 220.0, 10.0)[:-3])
    assert box.orders == []
    session.receive(moon(101, 120.0, 10.0))
    assert box.orders == [Aim(120.0, 10.0)]
