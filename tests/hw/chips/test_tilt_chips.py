"""The ADXL345 and the LSM303DLHC's accelerometer as elevation sensors on simulated chips. What they share with the
MPU6050 is in its file.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.adxl345 import Adxl345 as SimAdxl345
from firmware_sim.chips.as5600 import As5600 as SimAs5600
from firmware_sim.chips.lsm303 import Lsm303Accelerometer as SimLsm303
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.adxl345 import Adxl345
from hw.chips.lsm303 import Lsm303Accelerometer
from hw.ports import HardwareError
from hw.sensors.tilt import AVERAGED_OVER_S, TiltSensor
from rotator.config.sensors import TILTS

PARTS: dict[str, tuple[int, Any, Any]] = {
    "adxl345": (0x53, SimAdxl345, Adxl345),
    "lsm303-accel": (0x19, SimLsm303, Lsm303Accelerometer),
}
every_part = pytest.mark.parametrize("part", PARTS)


class Bench:
    """A boom with the board on it, x forward and z up."""

    def __init__(self, part: str, *, noisy: bool = False) -> None:
        self.address, sim, driver = PARTS[part]
        self.clock = SimClock(10.0)
        self.elevation_deg = 30.0
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip = sim(self.clock, self.feels_g, noisy=noisy)
        self.wire.attach(self.address, self.chip)
        self.sensor = TiltSensor(
            driver(SmbusI2C(self.wire, "bus 1"), self.clock.sleep, self.address), self.clock, averaged=1
        )

    def feels_g(self) -> tuple[float, float, float]:
        elevation = math.radians(self.elevation_deg)
        return math.sin(elevation), 0.0, math.cos(elevation)


@every_part
@pytest.mark.parametrize("elevation_deg", [-30.0, 0.0, 45.0, 90.0, 135.0, 180.0])
def test_the_reading_is_the_elevation(part: str, elevation_deg: float) -> None:
    bench = Bench(part)
    bench.elevation_deg = elevation_deg
    assert bench.sensor.read() == pytest.approx(elevation_deg, abs=0.12), "half a step of 3.9 mg"


@every_part
def test_noise_is_below_half_a_degree(part: str) -> None:
    bench = Bench(part, noisy=True)
    readings = []
    for _ in range(200):
        readings.append(bench.sensor.read())
        bench.clock.sleep(0.05)
    assert math.fsum(readings) / len(readings) == pytest.approx(30.0, abs=0.1)
    assert math.sqrt(math.fsum((reading - 30.0) ** 2 for reading in readings) / len(readings)) < 0.5


@every_part
def test_after_a_dip_in_the_supply_it_is_set_up_again(part: str) -> None:
    bench = Bench(part)
    bench.sensor.read()
    bench.chip.brown_out()
    bench.elevation_deg = 70.0
    bench.clock.sleep(2 * AVERAGED_OVER_S)
    with pytest.raises(HardwareError, match=r"it feels 0\.00 g"):
        bench.sensor.read()
    assert bench.sensor.read() == pytest.approx(70.0, abs=0.12)


@every_part
def test_a_chip_that_is_gone_and_comes_back(part: str) -> None:
    bench = Bench(part)
    bench.sensor.read()
    bench.wire.gone.add(bench.address)
    with pytest.raises(HardwareError, match="does not answer"):
        bench.sensor.read()
    bench.chip.brown_out()
    bench.wire.gone.clear()
    assert bench.sensor.read() == pytest.approx(30.0, abs=0.12)


def test_another_chip_where_an_adxl345_should_be() -> None:
    bench = Bench("adxl345")
    bench.chip.identity = 0x33
    with pytest.raises(HardwareError, match="the chip's identity is 0x33, an ADXL345 has 0xe5"):
        bench.sensor.read()


def test_another_chip_where_an_lsm303_should_be() -> None:
    bench = Bench("lsm303-accel")
    bench.wire.detach(0x19)
    bench.wire.attach(0x19, SimAs5600(lambda: 0.0))
    with pytest.raises(HardwareError, match="LSM303DLHC at 0x19: it does not keep what is written; another chip"):
        bench.sensor.read()


def test_the_box_knows_how_old_a_reading_may_be() -> None:
    """ADXL345: a period of 20 ms at 50 Hz. LSM303DLHC: a period of 10 ms, and a filter of 11 Hz, 14 ms."""
    assert TILTS["adxl345"] >= AVERAGED_OVER_S + 0.020
    assert TILTS["lsm303-accel"] >= AVERAGED_OVER_S + 0.010 + 0.014
