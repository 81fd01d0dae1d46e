"""The MPU6050 as an elevation sensor on a simulated chip: waking, mounting, averaging, and what shaking does to it."""

from __future__ import annotations

import math

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.mpu6050 import Mpu6050 as SimMpu6050
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.mpu6050 import Mpu6050
from hw.ports import HardwareError
from hw.sensors.mounting import Mounting
from hw.sensors.tilt import AVERAGED_OVER_S, TiltSensor
from rotator.config.sensors import TILTS

CYCLE_S = 0.05


class Bench:
    """A boom with the board on it, x forward and z up unless told."""

    def __init__(self, noise_g_per_root_hz: float = 0.0, address: int = 0x68) -> None:
        self.clock = SimClock(10.0)
        self.elevation_deg = 30.0
        self.lean_deg = 0.0
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip = SimMpu6050(self.clock, self.feels_g, noise_g_per_root_hz=noise_g_per_root_hz)
        self.wire.attach(address, self.chip)

    def feels_g(self) -> tuple[float, float, float]:
        # What the table under a board pushes: 1 g upwards, as the tilted board sees it.
        elevation, lean = math.radians(self.elevation_deg), math.radians(self.lean_deg)
        return (
            math.sin(elevation) * math.cos(lean),
            math.sin(lean),
            math.cos(elevation) * math.cos(lean),
        )

    def driver(self, address: int = 0x68, mounting: Mounting | None = None, averaged: int = 4) -> TiltSensor:
        bus = SmbusI2C(self.wire, "bus 1")
        chip = Mpu6050(bus, self.clock.sleep, address)
        return TiltSensor(chip, self.clock, mounting=mounting, averaged=averaged)

    def register(self, at: int) -> int:
        self.chip.write(bytes([at]))
        return self.chip.read(1)[0]


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.mark.parametrize("elevation_deg", [-30.0, 0.0, 10.0, 45.0, 89.0, 90.0, 91.0, 135.0, 179.9, 180.0, 180.1, 200.0])
def test_the_reading_is_the_elevation_over_the_top_and_beyond(bench: Bench, elevation_deg: float) -> None:
    bench.elevation_deg = elevation_deg
    assert bench.driver().read() == pytest.approx(elevation_deg, abs=0.01)


# --- what goes wrong


def jolt(bench: Bench, along_x_g: float) -> None:
    bench.chip.offset_g = (along_x_g, 0.0, 0.0)


def test_a_short_jolt_is_passed_over_and_a_long_one_is_an_error(bench: Bench) -> None:
    sensor = bench.driver()
    sensor.read()
    jolt(bench, 0.8)
    until_s = bench.clock() + AVERAGED_OVER_S - CYCLE_S
    while bench.clock() < until_s:
        bench.clock.sleep(CYCLE_S / 2)
        assert sensor.read() == pytest.approx(30.0, abs=0.01)
    bench.clock.sleep(2 * CYCLE_S)
    with pytest.raises(HardwareError, match=r"MPU6050 at 0x68: it feels 1\.56 g where gravity is 1 g; wait until"):
        sensor.read()
    jolt(bench, 0.0)
    assert sensor.read() == pytest.approx(30.0, abs=0.01)


def test_shaken_from_the_start_there_is_no_angle(bench: Bench) -> None:
    jolt(bench, 0.8)
    with pytest.raises(HardwareError, match="it feels"):
        bench.driver().read()


def test_in_the_wind_the_readings_near_1_g_still_lead_to_the_angle() -> None:
    bench = Bench(noise_g_per_root_hz=400e-6)
    sensor = bench.driver()
    sensor.read()
    bench.chip.shaken_g = 0.1
    readings = []
    for _ in range(200):
        bench.clock.sleep(CYCLE_S)
        readings.append(sensor.read())
    assert math.fsum(readings) / len(readings) == pytest.approx(30.0, abs=1.0)


def test_after_a_dip_in_the_supply_it_is_woken_again(bench: Bench) -> None:
    sensor = bench.driver()
    sensor.read()
    bench.chip.brown_out()
    for _ in range(3):
        bench.clock.sleep(CYCLE_S)
        sensor.read()
    bench.elevation_deg = 70.0
    bench.clock.sleep(AVERAGED_OVER_S + CYCLE_S)
    assert sensor.read() == pytest.approx(70.0, abs=0.01)


def test_another_chip_at_the_address(bench: Bench) -> None:
    bench.chip.identity = 0x70
    with pytest.raises(HardwareError, match="the chip's identity is 0x70, an MPU6050 has 0x68"):
        bench.driver().read()


def test_a_chip_that_is_gone_and_comes_back_from_power_on(bench: Bench) -> None:
    sensor = bench.driver()
    sensor.read()
    bench.wire.gone.add(0x68)
    with pytest.raises(HardwareError, match=r"does not answer; .* \(address 0x68\)"):
        sensor.read()
    bench.chip.brown_out()
    bench.wire.gone.clear()
    assert sensor.read() == pytest.approx(30.0, abs=0.01)


def test_the_box_knows_how_old_a_reading_may_be() -> None:
    """RM-MPU-6000A, register 26: the accelerometers are 13.8 ms late at 10 Hz."""
    assert TILTS["mpu6050"] >= AVERAGED_OVER_S + 0.0138
