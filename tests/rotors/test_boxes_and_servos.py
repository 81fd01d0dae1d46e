"""What control boxes and servos say of themselves beside going to an angle. Their drives have tests of their own."""

from __future__ import annotations

from typing import cast

import pytest

from hw.drives.digipot import DigipotDrive
from hw.drives.servo import ServoDrive
from hw.ports import AngleSource, Axis, Direction, HardwareError
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import Window
from rotator.control.sky.offsets import Offsets
from rotator.rotors.boxes import UNFED, BoxRotor, FollowedBox
from rotator.rotors.servos import ServoRotor
from tests.rotors.journal import Journal

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SHIFT = Offsets(10.0, 0.0)


def ends(axis: Axis) -> frozenset[Direction]:
    return frozenset({Direction.MINUS} if axis is AZ else ())


@pytest.fixture
def drive() -> Journal:
    return Journal()


@pytest.fixture
def box(drive: Journal) -> BoxRotor:
    return BoxRotor(cast(DigipotDrive, drive), {}, SHIFT, ends)


@pytest.fixture
def servos(drive: Journal) -> ServoRotor:
    return ServoRotor(cast(ServoDrive, drive), {}, SHIFT, ends)


def test_a_box_that_turned_away_from_its_angle_is_a_fault_and_the_other_has_no_supply(
    box: BoxRotor, drive: Journal
) -> None:
    drive.barred, drive.turned_deg = True, {AZ: 4.3}
    fault, other = box.condition(AZ).fault, box.condition(EL)
    assert fault is not None
    assert (fault.name, fault.axis, fault.limit, fault.cut) == ("turning with no relay on", AZ, "4°", True)
    assert "it turned 4.3° away from the angle" in fault.measured
    assert other.fault is None
    assert (other.notice, other.settling) == (UNFED, True)
    box.cut()
    box.restore()
    assert drive.said == ["cut", "restore"]


def test_servos_are_let_go_when_the_box_ends_even_after_a_failure(servos: ServoRotor, drive: Journal) -> None:
    servos.close()
    assert drive.said == ["off", "finish"]
    drive.broken = True
    with pytest.raises(HardwareError, match="does not answer"):
        servos.close()
    assert drive.said[-1] == "finish"


FIRST_READINGS, MOVED_READINGS = 5, 20
"""A quarter of a second, and one second."""
BROKEN = 0.0
"""The reading of a broken wire."""
HALF_TURN = Calibration(((0.0, 0.0), (1.0, 180.0)))


class Pot:
    source = AngleSource.MEASURED

    def __init__(self) -> None:
        self.reading: float | None = 0.5

    def read(self) -> float:
        if self.reading is None:
            raise HardwareError("the converter does not answer")
        return self.reading


def followed(drive: Journal, pot: Pot) -> FollowedBox:
    return FollowedBox(cast(DigipotDrive, drive), EL, pot, HALF_TURN, Window(0.02, 0.98))


def test_a_sensor_beside_a_model_corrects_it_and_is_what_is_read(drive: Journal) -> None:
    pot = Pot()
    sensor = followed(drive, pot)
    assert drive.sensors == {EL}
    for _ in range(FIRST_READINGS - 1):
        assert sensor.read() == 0.5
    assert drive.models == {}
    assert sensor.source is AngleSource.MEASURED
    assert sensor.read() == 0.5
    assert drive.models == {EL: 90.0}
    pot.reading = 0.0
    assert sensor.read() == 0.0
    assert drive.models == {EL: 90.0}, "a broken wire shows no place"
    pot.reading = None
    with pytest.raises(HardwareError, match="the converter"):
        sensor.read()
    assert drive.models == {EL: 90.0}


def test_a_model_is_put_elsewhere_only_by_readings_that_stay(drive: Journal) -> None:
    pot = Pot()
    sensor = followed(drive, pot)
    for _ in range(FIRST_READINGS):
        sensor.read()
    for pot.reading in (0.9, 0.1) * 20 + (0.1,) * 7 + (0.9,) * (MOVED_READINGS - 1):
        sensor.read()
    assert drive.models == {EL: 90.0}, "sparks on the wire"
    sensor.read()
    assert drive.models == {EL: pytest.approx(162.0)}, "it has stayed there for a second"
    for pot.reading in (0.86, 0.82, 0.78):
        sensor.read()
    assert drive.models == {EL: pytest.approx(140.4)}, "and turns from there"


@pytest.mark.parametrize(("broken", "believed"), [(7, True), (8, False)])
def test_a_place_further_off_is_believed_when_20_of_the_latest_27_readings_show_it(
    drive: Journal, broken: int, believed: bool
) -> None:
    pot = Pot()
    sensor = followed(drive, pot)
    for _ in range(FIRST_READINGS):
        sensor.read()
    for pot.reading in (0.9,) * 19 + (BROKEN,) * broken + (0.9,):
        assert drive.models == {EL: 90.0}
        sensor.read()
    assert drive.models == {EL: pytest.approx(162.0 if believed else 90.0)}


def test_the_first_place_is_shown_by_five_readings_that_are_more_than_half_of_them(drive: Journal) -> None:
    pot = Pot()
    sensor = followed(drive, pot)
    for pot.reading in (BROKEN,) * 5 + (0.5,) * 5:
        sensor.read()
    assert drive.models == {}
    sensor.read()
    assert drive.models == {EL: 90.0}


@pytest.mark.parametrize("every", [7, 8, 16, 32])
@pytest.mark.parametrize("first", range(8))
def test_a_crackling_wiper_puts_no_model_elsewhere_also_at_the_start(drive: Journal, every: int, first: int) -> None:
    """Else the supply, switched on for the other axis, would turn this one there."""
    pot = Pot()
    sensor = followed(drive, pot)
    for number in range(200):
        pot.reading = 0.3 if number % every == first % every else 0.5
        sensor.read()
        assert drive.models in ({}, {EL: 90.0})
    assert drive.models == {EL: 90.0}


@pytest.mark.parametrize("before", range(1, 5))
def test_a_reading_that_is_near_by_chance_among_others_that_jump_shows_no_place(drive: Journal, before: int) -> None:
    """A box that is to stand takes its place from the first reading that is believed: it would turn there."""
    pot = Pot()
    sensor = followed(drive, pot)
    for _ in range(FIRST_READINGS):
        sensor.read()
    for pot.reading in ((0.8, 0.1, 0.9, 0.2) * 2)[: before + 3]:
        sensor.read()
    pot.reading = 0.54
    sensor.read()
    assert drive.models == {EL: 90.0}
    for _ in range(2):
        sensor.read()
    assert drive.models == {EL: pytest.approx(97.2)}, "three of the latest five agree"
