"""Programs, the display and the status need not know which rotor it is: the same words, the same answers."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.exchange.orders import Home, Jog, LetGo, Stop
from rotator.exchange.status import Status
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.views import lcd
from tests.rotors.rig import AZ, EL, PERSON, Box, Kind

NewBox = Callable[..., Box]
READING_DEG = 1.0
"""A whole degree of the answer, and what the pot trembles."""


def near(box: Box, axis: Axis, angle_deg: float) -> bool:
    return abs(box.boom_deg(axis) - angle_deg) <= box.kind.within_deg + READING_DEG


# --- programs


def test_a_gs232_program_points_reads_turns_and_stops(box: Box) -> None:
    session = Gs232Session(box.client(), Dialect.B)
    assert session.receive(b"W130 050\r") == []
    box.until_it_stands()
    answer = session.receive(b"C2\r")[0].decode("ascii")
    said = re.fullmatch(r"AZ=(\d{3})  EL=(\d{3})\r\n", answer)
    assert said, answer
    assert near(box, AZ, float(said[1]))
    assert near(box, EL, float(said[2]))
    assert near(box, AZ, 130.0)
    assert near(box, EL, 50.0)

    session.receive(b"L\r")
    box.run(1.0)
    session.receive(b"S\r")
    box.until_it_stands()
    assert box.boom_deg(AZ) < 130.0 - 1.0
    stood_deg = box.boom_deg(AZ)
    box.run(5.0)
    assert box.boom_deg(AZ) == pytest.approx(stood_deg, abs=max(0.01, box.kind.trembles_deg))


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


# --- the display


def test_the_display_shows_what_the_status_says(kind: Kind, new_box: NewBox) -> None:
    box = new_box(kind, lcd={"kind": "gpio"}, servo={"enable": 16} if kind.profile == "servos" else {})
    assert box.station.display is not None
    assert box.world.lcd is not None
    box.station.display.reset()

    def shown() -> list[str]:
        assert box.station.display is not None
        assert box.world.lcd is not None
        box.station.display.show(lcd.rows(box.status, 0.0))
        return [row.rstrip() for row in box.world.lcd.text()]

    box.run(1.0)
    assert shown() == ["SAT A:--- E:---", f"SIM A:090 E:{kind.start_deg[1]:03.0f}"]
    box.client().order(Jog(AZ, Direction.PLUS, 0.5))
    Gs232Session(box.client(), Dialect.B).receive(b"W130 050\r")
    box.until_it_stands()
    upper, lower = shown()
    assert upper == "SAT A:130 E:050"
    said = re.fullmatch(r"SIM A:(\d{3}) E:(\d{3})", lower)
    assert said, lower
    assert near(box, AZ, float(said[1]))
    assert near(box, EL, float(said[2]))


# --- the status


def test_the_status_has_the_same_shape_for_all(box: Box) -> None:
    box.order(Jog(AZ, Direction.PLUS), Jog(EL, Direction.MINUS))
    box.until(lambda: box.status.moving)
    status: Status = box.status
    assert status.simulated
    for axis in Axis:
        each = status.axis(axis)
        assert each.angle_deg is not None
        assert each.min_deg - 5.0 <= each.angle_deg <= each.max_deg + 5.0
        assert (each.fault, each.notices, each.uncalibrated) == (None, (), "")


# --- what only some can


def test_homing_is_for_those_that_count(box: Box) -> None:
    refused = box.client(PERSON).order(Home(AZ))
    assert (refused is None) is (box.kind.source is AngleSource.COUNTED)
    if refused is not None:
        assert "it needs no homing" in refused.reason


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
