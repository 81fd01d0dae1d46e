"""Any datagrams at all for PstRotator, N1MM and MacDoppler, and any file for WSJT-X: no crash, no ill-formed answer, no
memory of what came before, and no motion but what a second reading of the same bytes finds there.

The second readings below are written from the protocols' descriptions, by hand and without the program's own parsers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Order, Park
from rotator.protocols.macdoppler import MacDopplerSession
from rotator.protocols.n1mm import N1mmSession
from rotator.protocols.pstrotator import PstRotatorSession
from rotator.protocols.session import Box, Session
from rotator.protocols.wsjtx import WsjtxSession
from tests.search import examples
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

SESSIONS: dict[str, Callable[[Box], Session]] = {
    "pstrotator": PstRotatorSession,
    "n1mm": N1mmSession,
    "macdoppler": MacDopplerSession,
    "wsjtx": lambda box: WsjtxSession(box, "Moon"),
}
WELL_FORMED = rb"AZ:\d{3}\.\d\r|EL:-?\d+\.\d\r|TGA:\d{3}\r|TGE:-?\d+\r|MODE:0\r"

NUMBERS = st.one_of(
    st.integers(-200, 600).map(lambda n: b"%d" % n),
    st.decimals(-200, 600, places=1).map(lambda n: str(n).encode()),
    st.decimals(-20, 400, places=6).map(lambda n: str(n).encode() + b".2"),
    st.sampled_from([b"", b"-", b"12,5", b".5", b"9.", b"1234", b"nan", b"1e2", b"005.5", b"1_0", b"\xb2", b"1", b"0"]),
)
NAMES = st.sampled_from(b"AZIMUTH AZIMUTH ELEVATION ELEVATION STOP PARK HOME TRACK SATSELECT goazi rotor stop".split())
TAGS = st.builds(lambda name, value, end: b"<%b>%b</%b>" % (name, value, end or name), NAMES, NUMBERS, st.just(b""))
TORN = st.sampled_from(
    [b"<PST>", b"</PST>", b"<AZIMUTH>", b"</AZIMUTH>", b"AZ?", b"MODE?", b"<stop>", b"</stop>", b" ", b"\r\n", b"\xff"]
)
INNER = st.lists(st.one_of(TAGS, TAGS, TAGS, TORN, st.binary(max_size=3)), max_size=5).map(b"".join)
REPORTS = st.builds(lambda az, el: b"1 Mac [AzEl Rotor Report:Azimuth:%b, Elevation:%b]" % (az, el), NUMBERS, NUMBERS)
FILES = st.builds(
    lambda second, az, el, body: b"12:00:%02d,%b,%b,%b\n" % (second, az, el, body),
    st.integers(0, 59),
    NUMBERS,
    NUMBERS,
    st.sampled_from([b"Moon", b"Moon", b"Sun"]),
)
DATAGRAMS = st.lists(
    st.one_of(
        INNER,
        INNER.map(lambda inner: b"<PST>" + inner + b"</PST>"),
        INNER.map(lambda inner: b"<PST>" + inner + b"</PST>"),
        INNER.map(lambda inner: b"<N1MMRotor>" + inner + b"</N1MMRotor>"),
        REPORTS,
        FILES,
        st.binary(max_size=40),
    ),
    max_size=8,
)


def number(text: bytes) -> float | None:
    good = re.fullmatch(rb"\s*([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d+)?),?\s*", text, re.ASCII)
    return float(good[1].replace(b",", b".")) if good else None


def direction(azimuth: float | None, elevation: float | None) -> Iterator[Order]:
    if (azimuth is None or -180 <= azimuth <= 540) and (elevation is None or -90 <= elevation <= 180):
        yield Aim(azimuth if azimuth is None or azimuth >= 0 else azimuth + 360, elevation)


def pstrotator_motions(datagram: bytes) -> Iterator[Order]:
    """Whatever might be meant: each pair of angles between the tags, and each park."""
    if not re.fullmatch(rb"\s*<PST>.*</PST>[\s\0]*", datagram.strip(b"\0"), re.DOTALL | re.IGNORECASE):
        return
    azimuths: list[float | None] = [None]
    elevations: list[float | None] = [None]
    for tag, value in re.findall(rb"<(\w+)>([^<>]*)</\1>", re.sub(rb"(\d\.\d{6})\.2", rb"\1", datagram.upper())):
        if tag in (b"AZIMUTH", b"ELEVATION") and number(value) is not None:
            (azimuths if tag == b"AZIMUTH" else elevations).append(number(value))
            for azimuth in azimuths:
                for elevation in elevations:
                    if (azimuth, elevation) != (None, None):
                        yield from direction(azimuth, elevation)
        if tag in (b"PARK", b"HOME") and value.strip() == b"1":
            yield Park()


def n1mm_motions(datagram: bytes) -> Iterator[Order]:
    if b"<N1MMRotor>" in datagram and b"</N1MMRotor>" in datagram:
        for value in re.findall(rb"<goazi>([^<>]*)</goazi>", datagram):
            azimuth = number(value)
            if azimuth is not None and 0 <= azimuth <= 360:
                yield Aim(azimuth, None)


def macdoppler_motions(datagram: bytes) -> Iterator[Order]:
    report = re.search(rb"\[AzEl Rotor Report:Azimuth:([^\]]*), Elevation:([^\]]*)\]\s*$", datagram)
    if report and number(report[1]) is not None and number(report[2]) is not None:
        yield from direction(number(report[1]), number(report[2]))


def wsjtx_motions(datagram: bytes) -> Iterator[Order]:
    for azimuth, elevation in re.findall(rb"\d,([^,\n]*),([^,\n]*),Moon\n", datagram):
        if number(azimuth) is not None and number(elevation) is not None:
            yield from direction(number(azimuth), number(elevation))


POSSIBLE = {
    "pstrotator": pstrotator_motions,
    "n1mm": n1mm_motions,
    "macdoppler": macdoppler_motions,
    "wsjtx": wsjtx_motions,
}


@pytest.mark.parametrize("protocol", SESSIONS)
@settings(max_examples=examples(200), deadline=None)
@given(datagrams=DATAGRAMS)
def test_what_moves_is_what_was_said(new_box: type[BenchBox], protocol: str, datagrams: list[bytes]) -> None:
    box = new_box((0, 540))
    session = SESSIONS[protocol](box)
    for datagram in datagrams:
        before = len(box.motions)
        replies = session.receive(datagram)
        assert all(re.fullmatch(WELL_FORMED, reply) for reply in replies)
        assert session.idle() == []
        possible = iter(list(POSSIBLE[protocol](datagram)))
        assert all(motion in possible for motion in box.motions[before:]), "in this order"
    if not box.motions:
        box.wait(0.5)
        assert box.turned == set()


@pytest.mark.parametrize("protocol", ["pstrotator", "n1mm", "macdoppler"])
@settings(max_examples=examples(50), deadline=None)
@given(datagrams=DATAGRAMS)
def test_a_datagram_stands_for_itself(new_box: type[BenchBox], protocol: str, datagrams: list[bytes]) -> None:
    """What came before it makes no difference to it."""
    one, many = new_box(at_once=False), new_box(at_once=False)
    session = SESSIONS[protocol](one)
    replies = [session.receive(datagram) for datagram in datagrams]
    assert [SESSIONS[protocol](many).receive(datagram) for datagram in datagrams] == replies
    assert many.orders == one.orders


@every_row(
    "piece",
    [b"<PST>", b"<AZIMUTH>", b"</PST><PST>", b"AZ?", b"<stop>", b"<a></a>", b"[AzEl Rotor Report:", b"12:", b" "],
)
@every_row("protocol", SESSIONS)
def test_the_longest_datagram_costs_next_to_nothing(new_box: type[BenchBox], protocol: str, piece: bytes) -> None:
    """Tags without end must not make the reading slow: a pattern that tries every way would take minutes."""
    session = SESSIONS[protocol](new_box())
    for head, tail in ((b"", b""), (b"<PST>", b"</PST>"), (b"<N1MMRotor>", b"</N1MMRotor>")):
        session.receive(head + (piece * 4096)[:4000] + tail)
