"""A pair of RT-21: each axis has a controller and a port of its own, both with the bytes of a DCU-1."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis
from rotator.config.links import Link
from rotator.exchange.orders import Aim, Stop
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.n1mm import N1mmSession
from rotator.protocols.one_axis import OneAxis
from rotator.protocols.pstrotatoraz import PstRotatorAzSession
from rotator.protocols.spid import Model, SpidSession

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

TRANSCRIPT = [
    # Hamlib's model 405 with two ports; the antenna stands at 235/25.
    (Axis.AZIMUTH, b"BI1;", b"235.0;"),
    (Axis.ELEVATION, b"BI1;", b"25.0;"),
    (Axis.AZIMUTH, b"AP1180.0\r;", b""),
    (Axis.ELEVATION, b"AP1045.5\r;", b""),
    (Axis.ELEVATION, b"AI1;", b";025"),
    (Axis.ELEVATION, b";", b""),
    (Axis.AZIMUTH, b";", b""),
    (Axis.ELEVATION, b"AP1355;AM1;", b""),
]


def test_two_ports_turn_an_axis_each(box: BenchBox) -> None:
    ports = {axis: Dcu1Session(OneAxis(box, axis)) for axis in Axis}
    for axis, said, answer in TRANSCRIPT:
        assert b"".join(ports[axis].receive(said)) == answer, said
        ports[axis].idle()
    assert box.orders == [
        Aim(180, None),
        Aim(None, 45.5),
        Stop((Axis.ELEVATION,)),
        Stop((Axis.AZIMUTH,)),
        Aim(None, -5),
    ]


def test_a_stream_on_each_port_is_no_fight(box: BenchBox) -> None:
    box.follows = True
    ports = {axis: Dcu1Session(OneAxis(box, axis)) for axis in Axis}
    for step in range(8):
        ports[Axis.AZIMUTH].receive(b"AP1%03d\r" % (240 + 5 * step))
        ports[Axis.ELEVATION].receive(b"AP1%03d\r" % (30 + 5 * step))
        box.wait(1)
    status = box.status()
    assert (status.wanted_azimuth_deg, status.wanted_elevation_deg) == (275, 65)


def test_the_other_protocols_with_one_bearing(box: BenchBox) -> None:
    elevation = OneAxis(box, Axis.ELEVATION)
    N1mmSession(elevation).receive(b"<N1MMRotor><rotor>x</rotor><goazi>30.0</goazi></N1MMRotor>")
    PstRotatorAzSession(elevation).receive(b"GET /?az=40 HTTP/1.1\r\nHost: 192.168.1.20\r\n\r\n")
    SpidSession(elevation, Model.ROT1PROG).receive(bytes.fromhex("57 34 31 30 30 00 00 00 00 00 00 2F 20"))
    assert box.orders == [Aim(None, 30), Aim(None, 40), Aim(None, 50)]


def test_what_names_its_axes_has_no_such_key() -> None:
    with pytest.raises(ValueError, match="axis is for dcu1, n1mm, pstrotatoraz, rot1prog"):
        Link.model_validate({"protocol": "rotctld", "tcp": "127.0.0.1:4533", "axis": "elevation"})
