"""Whatever a link sends, in any protocol: the box's limits and its calibration stay as they are.

Only O, F, O2 and F2 on a link that `may_calibrate` may change a calibration, and nothing a limit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hw.ports import Axis
from rotator.config.links import FOLLOW, ProtocolName
from rotator.exchange.orders import Calibrate
from rotator.protocols.rotctld_follow import RotctldFollower
from rotator.protocols.session import NotUnderstood
from tests.protocols.fed import connected
from tests.search import examples

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

PROTOCOLS = sorted(set(get_args(ProtocolName)) - {FOLLOW})
TEMPTING = st.sampled_from([
    *(b"O\r", b"F\r", b"O2\r", b"F2\r", b"P36\r", b"P45\r", b"Z\r", b"W450 180\r", b"M450\r", b"S\r", b"X1\r"),
    *(b"C min_az -180\n", b"C max_az 540\n", b"C max_el 210\n", b"C south_zero 1\n", b"\\set_conf max_az 540\n"),
    *(b"\\set_conf min_el -90\nC min_az=-180,max_az=540 1\n", b"R 1\n", b"P 540 180\n", b"V SPEED 4\n", b"w O\n"),
    *(b"AZ540 EL180\n", b"RESET\n", b"CW1,540\n", b"CR1\n", b"PARK\n", b"AP1360;AM1;", b"E;J;O;S1;V;"),
    *(b"W9999\x0a9999\x0a\x2f ", b"W0000\x020000\x02\x2f ", b"W" + bytes(10) + b"\xf8 ", b"W" + bytes(10) + b"\x0f "),
    *(b"<PST><AZIMUTH>540</AZIMUTH><ELEVATION>180</ELEVATION></PST>", b"<PST><PARK>1</PARK></PST>"),
    b"<N1MMRotor><rotor>x</rotor><goazi>540.0</goazi><offset>90.0</offset></N1MMRotor>",
    b"[AzEl Rotor Report:Azimuth:540.00, Elevation:180.00, SatName:X]",
    b"12:00:00,540.0,180.0,Moon\n",
    *(b":So-90#:Sh90#", b":Sz 540*00#:Sa+90*00#:MA#", b":St+10*00#:CM#", b"\x02AG540\r", b"\x02BG1800\r\x02AG5400\r"),
    *(b"A540\rE180\r", b"GET /?az=540 HTTP/1.1\r\nHost: pi\r\n\r\n", b"\x14\0\0\0" + bytes(12) + b"\0\0\0\x30"),
])  # fmt: skip
PIECES = st.lists(st.one_of(TEMPTING, TEMPTING, st.binary(max_size=16)), max_size=20)


def fixed(box: BenchBox) -> list[tuple[object, ...]]:
    """What no link may change."""
    axes = [box.status().axis(axis) for axis in Axis]
    return [(axis.min_deg, axis.max_deg, axis.calibration, axis.uncalibrated) for axis in axes]


@pytest.mark.parametrize("protocol", PROTOCOLS)
@settings(max_examples=examples(100), deadline=None)
@given(pieces=PIECES)
def test_no_bytes_change_limits_or_calibration(new_box: type[BenchBox], protocol: str, pieces: list[bytes]) -> None:
    box = new_box((0.0, 360.0), (0.0, 90.0), at=(100, 20))
    before, session = fixed(box), connected(protocol, box)
    for piece in pieces:
        session.receive(piece)
        session.idle()
    box.wait(0.2)
    assert fixed(box) == before
    assert not [order for order in box.orders if isinstance(order, Calibrate)]


@pytest.mark.parametrize("protocol", ["gs232a", "gs232b"])
@settings(max_examples=examples(100), deadline=None)
@given(pieces=PIECES)
def test_may_calibrate_changes_no_limit_either(new_box: type[BenchBox], protocol: str, pieces: list[bytes]) -> None:
    box = new_box((0.0, 360.0), (0.0, 90.0))
    session = connected(protocol, box, may_calibrate=True)
    for piece in pieces:
        session.receive(piece)
    box.wait(0.2)
    assert [limits[:2] for limits in fixed(box)] == [(0.0, 360.0), (0.0, 90.0)]


@settings(max_examples=examples(100), deadline=None)
@given(pieces=st.lists(st.one_of(st.sampled_from([b"400.0\n", b"120.0\n", b"RPRT 0\n"]), st.binary(max_size=16))))
def test_nor_does_a_server_that_is_followed(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    box = new_box((0.0, 360.0), (0.0, 90.0))
    before, follower = fixed(box), RotctldFollower(box, 0.1)
    for piece in pieces:
        follower.ask()
        try:
            follower.receive(piece)
        except NotUnderstood:
            follower = RotctldFollower(box, 0.1)
    box.wait(0.2)
    assert fixed(box) == before


def test_p45_is_one_connection_s_and_reaches_no_further_than_the_rotor(new_box: type[BenchBox]) -> None:
    box = new_box((0.0, 360.0), (0.0, 180.0))
    wide, other = (connected("gs232b", box) for _ in range(2))
    assert wide.receive(b"P45\rM400\r") == [b"Mode 450 degree\r\n"]
    assert box.status().azimuth.target_deg == pytest.approx(40), "the direction, within the range"
    assert other.receive(b"M400\r") == [b"?>\r\n"]


@pytest.mark.parametrize("command", [b"O\r", b"F\r", b"O2\r", b"F2\r"])
def test_may_calibrate_is_what_it_takes(new_box: type[BenchBox], command: bytes) -> None:
    for may, answer in ((False, [b"?>\r\n"]), (True, [])):
        box = new_box()
        box.stands_at(10, 10)
        assert connected("gs232b", box, may_calibrate=may).receive(command) == answer
        assert [type(order) for order in box.orders] == [Calibrate] * may
