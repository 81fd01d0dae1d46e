"""Programs, the display and the status need not know which rotor it is: the same words, the same answers."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Jog, LetGo, Stop
from rotator.protocols.rotctld_session import RotctldSession
from tests.rotors.rig import AZ, EL, PERSON, Box

READING_DEG = 1.0
"""A whole degree of the answer, and what the pot trembles."""


def near(box: Box, axis: Axis, angle_deg: float) -> bool:
    return abs(box.boom_deg(axis) - angle_deg) <= box.kind.within_deg + READING_DEG


# --- programs


def test_a_rotctld_program_points_reads_stops_and_parks(box: Box) -> None:
    session = RotctldSession(box.client())
    assert session.receive(b"P 130.5 50.25\n") == [b"RPRT 0\n"]
    box.until_it_stands()
    azimuth, elevation = session.receive(b"p\n")[0].decode("ascii").split()
    assert near(box, AZ, float(azimuth))
    assert near(box, EL, float(elevation))
    assert near(box, AZ, 130.5)
    assert session.receive(b"S\n") == [b"RPRT 0\n"]
    assert session.receive(b"K\n") == [b"RPRT 0\n"]
    box.until_it_stands()
    mount = box.config.mount
    assert near(box, AZ, mount.park_azimuth_deg)
    assert near(box, EL, max(mount.park_elevation_deg, box.kind.short_deg))


def test_what_the_rotor_cannot_reach_is_refused_in_the_program_s_words(box: Box) -> None:
    limits = box.axis(AZ)
    reached = limits.max_deg - limits.min_deg >= 360.0 or box.config.mount.flip != "off"
    answer = RotctldSession(box.client()).receive(b"P 270 20\n")[0]
    assert (answer == b"RPRT 0\n") is reached


# --- what only some can


def test_let_go_latches_and_is_harmless_where_nobody_can(box: Box, caplog: pytest.LogCaptureFixture) -> None:
    box.order(Jog(AZ, Direction.PLUS))
    box.run(0.5)
    box.order(LetGo(), by=PERSON)
    box.run(3.0)
    assert box.status.latched == "console"
    box.until_it_stands()
    box.order(Stop())
    box.run(1.0)
    assert box.status.latched == "console"
    assert "Traceback" not in caplog.text
