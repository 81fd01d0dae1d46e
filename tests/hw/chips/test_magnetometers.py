"""QMC5883L, HMC5883L and LSM303DLHC on simulated chips: µT from registers, and what each says when it cannot."""

from __future__ import annotations

from typing import Any

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.hmc5883l import Hmc5883l as SimHmc5883l
from firmware_sim.chips.qmc5883l import Qmc5883l as SimQmc5883l
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.hmc5883l import LSM303DLHC, Hmc5883l
from hw.chips.qmc5883l import Qmc5883l
from hw.ports import HardwareError, Magnetometer

FIELD_UT = (20.0, -5.0, -44.0)
PARTS = ("QMC5883L", "HMC5883L", "LSM303DLHC")
every_part = pytest.mark.parametrize("part", PARTS)


class Bench:
    def __init__(self, part: str) -> None:
        self.clock = SimClock(10.0)
        self.feels_ut = FIELD_UT
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip: Any
        bus, sleep = SmbusI2C(self.wire, "bus 1"), self.clock.sleep
        self.driver: Magnetometer
        if part == "QMC5883L":
            self.address, self.driver = 0x0D, Qmc5883l(bus, self.clock, sleep)
            self.chip = SimQmc5883l(self.clock, self.field_ut, noise_ut=0.0)
        else:
            lsm303 = part == "LSM303DLHC"
            self.chip = SimHmc5883l(self.clock, self.field_ut, lsm303=lsm303, noise_ut=0.0)
            self.address = 0x1E
            self.driver = Hmc5883l(bus, sleep, part=LSM303DLHC) if lsm303 else Hmc5883l(bus, sleep)
        self.wire.attach(self.address, self.chip)

    def field_ut(self) -> tuple[float, float, float]:
        return self.feels_ut


@every_part
def test_the_field_along_x_y_and_z(part: str) -> None:
    bench = Bench(part)
    assert bench.driver.field_ut() == pytest.approx(FIELD_UT, abs=0.06)
    bench.feels_ut = (-20.0, 12.0, 50.0)
    bench.clock.sleep(0.05)
    assert bench.driver.field_ut() == pytest.approx((-20.0, 12.0, 50.0), abs=0.06)


@every_part
def test_a_magnet_is_told_from_the_earth(part: str) -> None:
    bench = Bench(part)
    bench.driver.field_ut()
    bench.feels_ut = (0.0, 600.0, 0.0)
    bench.clock.sleep(0.05)
    with pytest.raises(HardwareError, match=f"{part} at 0x..: the field is above .* a magnet or a motor is too near"):
        bench.driver.field_ut()
    bench.feels_ut = FIELD_UT
    bench.clock.sleep(0.05)
    assert bench.driver.field_ut() == pytest.approx(FIELD_UT, abs=0.06)


@every_part
def test_after_a_dip_in_the_supply_it_is_set_up_again(part: str) -> None:
    bench = Bench(part)
    bench.driver.field_ut()
    bench.chip.brown_out()
    bench.feels_ut = (-20.0, 12.0, 50.0)
    bench.clock.sleep(0.2)
    if part == "QMC5883L":  # it shows by its missing results that it has lost its settings
        with pytest.raises(HardwareError, match="it measures nothing"):
            bench.driver.field_ut()
    assert bench.driver.field_ut() == pytest.approx((-20.0, 12.0, 50.0), abs=0.06)


def test_a_qmc_read_oftener_than_it_measures_keeps_its_latest_result() -> None:
    bench = Bench("QMC5883L")
    bench.driver.field_ut()
    for _ in range(20):
        bench.clock.sleep(0.005)
        assert bench.driver.field_ut() == pytest.approx(FIELD_UT, abs=0.06)


@every_part
def test_another_chip_at_the_address(part: str) -> None:
    bench = Bench(part)
    bench.chip.identity = 0x80 if part == "QMC5883L" else b"\x00\x00\x00"
    with pytest.raises(
        HardwareError, match=r"identity is 0x80, a QMC5883L has 0xff|calls itself .*, this one is b'H43'"
    ):
        bench.driver.field_ut()
