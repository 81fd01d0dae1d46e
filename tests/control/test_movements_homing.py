"""Homing beside everything else that may be asked for: parking, stops, another person, a confirmed angle."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.commands import Place
from rotator.exchange.orders import Aim, Home, Park, Release, Stop
from tests.control.conftest import AZ, EL, Desk

CONSOLE, LINK = Desk.CONSOLE, Desk.LINK


@pytest.fixture
def counted() -> Desk:
    """A rotor that counts, at 100° and 30°, idle antennas park after five seconds; 0° and 0° is the park position."""
    desk = Desk(counted=True, at=(100.0, 30.0), park_after_s=5.0)
    desk.step()
    return desk


def until_homed(desk: Desk, axis: Axis, seconds: float = 200.0) -> None:
    for _ in range(round(seconds / 0.05)):
        desk.step()
        if any(errand.axis is axis for errand in desk.controller.errands if isinstance(errand, Place)):
            return
    raise AssertionError(f"{axis.value} is not homed")


def test_both_axes_are_homed_one_after_the_other(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    counted.step(Home(EL), by=CONSOLE)
    assert (counted.status.azimuth.homing, counted.status.elevation.homing) == (True, False)
    until_homed(counted, AZ)
    assert counted.angle_deg[AZ] == pytest.approx(0.0, abs=0.1)
    counted.step()
    assert (counted.status.azimuth.homing, counted.status.elevation.homing) == (False, True)
    until_homed(counted, EL)
    assert counted.angle_deg[EL] == pytest.approx(0.0, abs=0.1)


def test_an_idle_antenna_does_not_park_in_the_middle_of_homing(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    for _ in range(round(15.0 / 0.05)):
        counted.step()
        assert counted.status.azimuth.homing, "it takes 16 s to the stop, and parks after 5"
        assert counted.status.azimuth.target_deg is None
    until_homed(counted, AZ)


def test_after_homing_the_time_until_it_parks_begins_anew(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    until_homed(counted, AZ)
    counted.run(4.5)
    assert counted.status.elevation.target_deg is None
    counted.run(1.0)
    assert counted.status.elevation.target_deg == 0.0, "now it parks"


def test_a_storm_park_ends_the_homing_and_all_that_wait(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    counted.step(Home(EL), by=CONSOLE)
    counted.run(1.0)
    counted.step(Park(storm=True), by=CONSOLE)
    for _ in range(round(60.0 / 0.05)):
        counted.step()
        assert not counted.status.azimuth.homing
        assert not counted.status.elevation.homing
    assert (counted.status.latched, counted.status.storm) == ("console", True)
    assert counted.angle_deg[AZ] == pytest.approx(0.0, abs=4.0)
    assert counted.angle_deg[EL] == pytest.approx(0.0, abs=4.0)
    counted.step(Release(), by=CONSOLE)
    counted.run(1.0)
    assert not counted.status.elevation.homing, "what waited has been forgotten"


def test_another_order_of_the_same_person_ends_the_homing_and_all_that_wait(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    counted.step(Home(EL), by=CONSOLE)
    counted.step(Aim(200.0, 60.0), by=CONSOLE)
    counted.run(4.0)
    assert (counted.status.azimuth.homing, counted.status.elevation.homing) == (False, False)
    assert (counted.status.azimuth.target_deg, counted.status.elevation.target_deg) == (200.0, 60.0)
    assert counted.driven[AZ] is Direction.PLUS


def test_a_stop_ends_homing_and_all_that_wait(counted: Desk) -> None:
    counted.step(Home(AZ), by=CONSOLE)
    counted.step(Home(EL), by=CONSOLE)
    counted.run(1.0)
    counted.step(Stop())
    counted.run(2.0)
    assert counted.at_rest()
    assert not counted.status.azimuth.homing
    assert not counted.status.elevation.homing


def test_a_rotor_that_measures_is_not_homed_and_goes_on(desk: Desk) -> None:
    desk.step(Aim(200.0, 60.0))
    desk.step(Home(AZ), by=CONSOLE)
    assert any("needs no homing" in trouble for trouble in desk.controller.troubles)
    assert desk.status.azimuth.target_deg == 200.0
