"""Other sensors than the rotor's own: the whole box points by them, and says so when they fail."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource, Axis
from tests.scenario.sensed_box import Box

ONE_TURN = """
[azimuth]
min_deg = 10
max_deg = 350
"""
AS5600_AND_MPU6050 = (
    ONE_TURN
    + """
calibration = [[0.0277778, 10], [0.9722222, 350]]
lowest_reading = 0.02
highest_reading = 0.98
[azimuth.sensor]
kind = "as5600"
[elevation.sensor]
kind = "mpu6050"
forward = "-y"
up = "+z"
"""
)
POTS = (
    ONE_TURN
    + """
[azimuth.sensor]
kind = "pot"
[elevation.sensor]
kind = "pot"
"""
)


def rotor(kind: str) -> str:
    return f'[rotor]\ntype = "{kind}"\n'


def test_a_magnet_for_azimuth_and_gravity_for_elevation() -> None:
    box = Box(rotor("relay-pot") + AS5600_AND_MPU6050)
    assert box.loop.status.azimuth.angle_deg == pytest.approx(40.0, abs=0.5)
    assert box.loop.status.elevation.angle_deg == pytest.approx(20.0, abs=1.0)
    box.aim(200.0, 70.0)
    assert box.world.antenna() == pytest.approx((200.0, 70.0), abs=1.5)
    assert box.loop.status.faults == ()


@pytest.mark.parametrize("kind", ["as5045", "as5048a", "as5048b", "mt6701", "mt6701-ssi"])
def test_any_encoder_under_a_magnet(kind: str) -> None:
    box = Box(rotor("relay-pot") + AS5600_AND_MPU6050.replace("as5600", kind))
    assert box.loop.status.azimuth.angle_deg == pytest.approx(40.0, abs=0.3)
    box.aim(200.0, 20.0)
    assert box.world.antenna()[0] == pytest.approx(200.0, abs=1.5)
    assert box.loop.status.faults == ()
    box.aim(300.0, 20.0, seconds=5.0)
    box.world.inject(f"azimuth-{kind}-gone")
    box.wait(1.0)
    assert box.loop.status.azimuth.fault is not None
    assert box.loop.status.azimuth.fault.name == "sensor silent"
    assert box.world.drives() == (0, 0)


TWO_BUSES = (
    ONE_TURN
    + """
calibration = [[0.0277778, 10], [0.9722222, 350]]
[azimuth.sensor]
kind = "as5600"
[elevation]
calibration = [[0.1, 0], [0.6, 180]]
[elevation.sensor]
kind = "as5600"
bus = 3
zero_turn = 0.9
"""
)


def test_two_chips_with_the_one_address_that_they_know_are_on_two_buses() -> None:
    box = Box(rotor("relay-pot") + TWO_BUSES)
    box.aim(200.0, 70.0)
    assert box.world.antenna() == pytest.approx((200.0, 70.0), abs=1.5)
    box.world.inject("elevation-as5600-gone")
    box.wait(1.0)
    assert (box.loop.status.azimuth.fault, box.loop.status.elevation.fault is None) == (None, False)


SHARED_SPI = """
[rotor]
type = "relay-pot"
[azimuth]
min_deg = 10
max_deg = 350
calibration = [[0.0277778, 10], [0.9722222, 350]]
[azimuth.sensor]
kind = "as5045"
select = 7
[adc]
kind = "mcp3208"
spi = "kernel"
"""


def test_an_encoder_and_the_converter_share_the_pis_own_spi_each_in_its_mode() -> None:
    box = Box(SHARED_SPI)
    box.aim(200.0, 70.0)
    assert box.world.antenna() == pytest.approx((200.0, 70.0), abs=2.5)
    assert box.loop.status.faults == ()
    box.world.inject("adc-gone")
    box.wait(1.0)
    assert (box.loop.status.azimuth.fault, box.loop.status.elevation.fault is None) == (None, False)


@pytest.mark.parametrize(
    ("fault", "axis"),
    [
        ("azimuth-magnet-missing", Axis.AZIMUTH),
        ("azimuth-as5600-gone", Axis.AZIMUTH),
        ("elevation-shaken", Axis.ELEVATION),
        ("mpu6050-gone", Axis.ELEVATION),
    ],
)
def test_a_sensor_that_fails_stops_its_axis(fault: str, axis: Axis) -> None:
    box = Box(rotor("relay-pot") + AS5600_AND_MPU6050)
    box.aim(300.0, 170.0, seconds=5.0)
    assert box.world.drives() == (1, 1)
    box.world.inject(fault)
    box.wait(1.0)
    told = box.loop.status.axis(axis).fault
    assert told is not None
    assert told.name == "sensor silent"
    assert box.world.drives()[list(Axis).index(axis)] == 0
    assert box.world.drives() != (0, 0), "the other axis goes on"


RELAY = "[digipot]\nenable = 16\n"
"""In the supply of the control boxes: without it they turn at power-on, which is a fault where a pot sees it."""


@pytest.mark.long
@pytest.mark.parametrize("kind", ["digipot", "relay-pulse", "servo"])
def test_pots_on_a_rotor_that_brings_none(kind: str) -> None:
    limits = POTS + (f"[{kind}.azimuth]\nstart_deg = 40\n" if kind != "relay-pulse" else "")
    if kind == "servo":
        limits = limits.replace("max_deg = 350", "max_deg = 170")
    box = Box(rotor(kind) + limits + (RELAY if kind == "digipot" else ""))
    assert {box.loop.status.axis(axis).source for axis in Axis} == {AngleSource.MEASURED}
    box.aim(160.0, 70.0)
    assert box.world.antenna() == pytest.approx((160.0, 70.0), abs=3.0)
    assert box.loop.status.azimuth.angle_deg == pytest.approx(box.world.shafts()[0], abs=0.5)
    box.world.inject("azimuth-pot-open")
    box.wait(1.0)
    assert box.loop.status.azimuth.fault is not None
    assert box.loop.status.azimuth.fault.name == "pot open or shorted"


# --- a compass for the azimuth, and other chips that feel gravity

COMPASS = """
[azimuth]
min_deg = 5
max_deg = 355
tolerance_deg = 2
[azimuth.sensor]
kind = "{azimuth}"
forward = "-y"
up = "-z"
radius_ut = [20, 20]
[elevation.sensor]
kind = "{elevation}"
forward = "+y"
[mount]
north = "magnetic"
declination_deg = 4.1
"""


def felt(kind: str, azimuth: str, elevation: str) -> Box:
    """Its compass is 0.1 s late, and its noise is 1° rms: twice of what its data sheet says."""
    return Box(rotor(kind) + COMPASS.format(azimuth=azimuth, elevation=elevation))


@pytest.mark.parametrize(
    ("kind", "azimuth", "elevation"),
    [
        ("relay-pot", "qmc5883l", "adxl345"),
        ("relay-timed", "lsm303-mag", "lsm303-accel"),
        pytest.param("relay-pulse", "hmc5883l", "adxl345", marks=pytest.mark.long),
    ],
)
def test_a_compass_shows_true_north_and_does_not_hunt(kind: str, azimuth: str, elevation: str) -> None:
    box = felt(kind, azimuth, elevation)
    for azimuth_deg, elevation_deg in ((200.0, 50.0), (12.0, 10.0)):
        box.aim(azimuth_deg, elevation_deg, seconds=45.0)
        at_deg, up_deg = box.world.antenna()
        assert at_deg + 4.1 == pytest.approx(azimuth_deg, abs=2.5)
        assert up_deg == pytest.approx(elevation_deg, abs=2.0)
    starts = box.world.relay_starts
    box.wait(30.0)
    assert box.world.relay_starts == starts
    assert box.loop.status.faults == ()


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        ("azimuth-magnet-near", "the field is above 200 µT"),
        ("azimuth-iron-near", "something of iron, a magnet or a motor's current is near"),
        ("qmc5883l-gone", "does not answer"),
        ("azimuth-motor-stalled", "motor runs and compass stands still"),
    ],
)
def test_a_compass_that_is_pulled_or_gone_stops_the_azimuth(fault: str, told: str) -> None:
    box = felt("relay-pot", "qmc5883l", "adxl345")
    box.aim(300.0, 20.0, seconds=5.0)
    assert box.world.drives() == (1, 0)
    box.world.inject(fault)
    box.wait(3.5)
    assert told in str(box.loop.status.azimuth.fault)
    assert box.world.drives() == (0, 0)
