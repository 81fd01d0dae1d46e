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
