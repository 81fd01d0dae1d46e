"""Stellarium's frames, and what they make the box do. The frames here are written by its source, bit by bit."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Stop
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.orbits.earth import Site
from rotator.protocols.session import Session
from rotator.protocols.stellarium import StellariumSession, decode, encode
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
NOW_S = 1.8e9
SKY = Sky(Site(52.5, 13.4), lambda: NOW_S)


def from_stellarium(right_ascension: float, declination: float, micros: int) -> bytes:
    """The bytes of telescopeGoto: radians, each number shifted out from its lowest byte."""
    ra = math.floor(0.5 + right_ascension * (0x80000000 / math.pi))
    dec = math.floor(0.5 + declination * (0x80000000 / math.pi)) & 0xFFFFFFFF
    octets = [20, 0, 0, 0]
    for number, count in ((micros, 8), (ra, 4), (dec, 4)):
        octets += [number >> 8 * at & 0xFF for at in range(count)]
    return bytes(octets)


def read_by_stellarium(frame: bytes) -> tuple[float, float, int]:
    """What performReading makes of a position: right ascension, declination, microseconds."""
    assert frame[:4] == bytes((24, 0, 0, 0))
    ra = sum(octet << 8 * at for at, octet in enumerate(frame[12:16])) * math.pi / 0x80000000
    turned = sum(octet << 8 * at for at, octet in enumerate(frame[16:20]))
    dec = (turned - (1 << 32) if turned >= 0x80000000 else turned) * math.pi / 0x80000000
    assert frame[20:] == bytes(4)
    return ra, dec, sum(octet << 8 * at for at, octet in enumerate(frame[4:12]))


def target(azimuth_deg: float, elevation_deg: float) -> bytes:
    star = SKY.star(azimuth_deg, elevation_deg, Equinox.J2000)
    return from_stellarium(
        math.radians(star.right_ascension_deg), math.radians(star.declination_deg), int(NOW_S * 1_000_000)
    )


@given(ra=st.floats(0, 6.283), dec=st.floats(-math.pi / 2, math.pi / 2), micros=st.integers(0, 1 << 60))
def test_its_targets_are_read(ra: float, dec: float, micros: int) -> None:
    frame = from_stellarium(ra, dec, micros)
    goto = decode(frame)
    assert goto is not None
    assert goto.star.right_ascension_deg == pytest.approx(math.degrees(ra), abs=1e-6)
    assert goto.star.declination_deg == pytest.approx(math.degrees(dec), abs=1e-6)
    assert goto.star.equinox is Equinox.J2000
    again = encode(goto)
    assert again[:4] + again[12:] == frame[:4] + frame[12:]


def test_a_target_is_an_order(box: BenchBox, feed: Feed) -> None:
    assert feed(StellariumSession(box, SKY), target(200, 40) + target(100, 20)) == []
    first, second = box.orders
    assert isinstance(first, Aim)
    assert isinstance(second, Aim)
    assert (first.azimuth_deg, first.elevation_deg) == pytest.approx((200, 40), abs=1e-4)
    assert (second.azimuth_deg, second.elevation_deg) == pytest.approx((100, 20), abs=1e-4)


def test_it_is_sent_where_the_antenna_points(box: BenchBox) -> None:
    (frame,) = StellariumSession(box, SKY).beat()
    ra, dec, micros = read_by_stellarium(frame)
    assert micros == NOW_S * 1_000_000
    seen = SKY.direction(Star(math.degrees(ra), math.degrees(dec), Equinox.J2000))
    assert seen == pytest.approx((235, 25), abs=0.2)


def test_over_the_top_it_is_the_direction(box: BenchBox) -> None:
    box.stands_at(20, 150)
    (frame,) = StellariumSession(box, SKY).beat()
    ra, dec, _ = read_by_stellarium(frame)
    assert SKY.direction(Star(math.degrees(ra), math.degrees(dec), Equinox.J2000)) == pytest.approx((200, 30), abs=0.2)


def test_it_follows(box: BenchBox) -> None:
    session = StellariumSession(box, SKY)
    session.receive(target(200, 40))
    for _ in range(5):
        session.beat()
    assert len(box.motions) == 6
    box.order(Stop())
    for _ in range(5):
        session.beat()
    assert len(box.motions) == 6


def test_below_the_horizon_it_says_so(box: BenchBox) -> None:
    remarks: list[str] = []
    StellariumSession(box, SKY, remarks.append).receive(target(200, -5))
    assert box.orders == []
    assert remarks == ["a target below the horizon is not obeyed"]


@every_row(
    "damaged",
    [
        b"GET / HTTP/1.1\r\n",
        bytes((21, 0, 0, 0)) + bytes(17),
        bytes((20, 0, 1, 0)) + bytes(16),
        bytes((20, 0, 0, 0)) + bytes(12) + b"\x01\x00\x00\x40",
        bytes((20, 0, 0, 0)) + bytes(12) + b"\x00\x00\x00\x80",
    ],
)
def test_a_damaged_frame_ends_the_connection(new_box: type[BenchBox], damaged: bytes) -> None:
    box = new_box(at=(235, 25))
    remarks: list[str] = []
    session = StellariumSession(box, SKY, remarks.append)
    session.receive(damaged + target(200, 40))
    session.receive(target(200, 40))
    assert session.closed
    assert box.orders == []
    assert len(remarks) == 1
    assert session.beat() == []


@given(pieces=st.lists(st.one_of(st.binary(max_size=30), st.just(b"\x14\x00\x00\x00"), st.just(bytes(12))), max_size=8))
def test_any_bytes(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    """Nothing moves but by whole targets, counted from the first byte and until the first that is none."""
    box = new_box()
    session = StellariumSession(box, SKY)
    for piece in pieces:
        assert session.receive(piece) == []
    heard, wanted = b"".join(pieces), 0
    while heard[:4] == b"\x14\0\0\0" and len(heard) >= 20:
        dec = int.from_bytes(heard[16:20], "little", signed=True)
        if abs(dec) > 1 << 30:
            break
        ra_deg, dec_deg = int.from_bytes(heard[12:16], "little") * 360 / (1 << 32), dec * 360 / (1 << 32)
        wanted += SKY.direction(Star(ra_deg, dec_deg, Equinox.J2000))[1] >= 0
        heard = heard[20:]
    assert len(box.motions) == wanted
