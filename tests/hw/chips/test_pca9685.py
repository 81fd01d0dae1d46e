"""The PCA9685 driver on a simulated chip, against the datasheet (NXP, rev. 4)."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.pca9685 import Pca9685 as SimPca9685
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.pca9685 import Pca9685
from hw.ports import HardwareError
from tests.tables import every_row


class Bench:
    def __init__(self, osc_hz: float = 25e6) -> None:
        self.clock = SimClock(10.0)
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip = SimPca9685(self.clock, osc_hz=osc_hz)
        self.wire.attach(0x40, self.chip)

    def driver(self, **settings: float) -> Pca9685:
        chip = Pca9685(SmbusI2C(self.wire, "bus 1"), 0x40, self.clock.sleep, **settings)
        chip.start()
        return chip


def test_start_sets_50_hz_and_wakes_the_chip_with_every_output_off() -> None:
    bench = Bench()
    bench.driver()
    assert bench.chip.register(0xFE) == 0x79
    assert bench.chip.register(0x00) == 0x20
    assert 1 / bench.chip.period_s() == pytest.approx(50.03, abs=0.01)
    assert [bench.chip.high_share(output) for output in range(16)] == [0.0] * 16


def test_start_ends_what_another_program_left_running() -> None:
    bench = Bench()
    bench.driver().pulse(3, 1500)
    bench.driver(frequency_hz=60).pulse(0, 1500)
    assert bench.chip.high_share(3) == 0.0
    assert 1 / bench.chip.period_s() == pytest.approx(60, abs=0.3)


@every_row(("width_us", "ticks"), [(500, 102), (1000, 205), (1500, 307), (2000, 410), (2500, 512)])
def test_a_pulse_at_once_after_the_start(width_us: float, ticks: int) -> None:
    bench = Bench()
    bench.driver().pulse(15, width_us)
    assert bench.chip.high_share(15) == ticks / 4096
    assert bench.chip.early_writes == 0


# --- what goes wrong


def test_a_chip_that_was_reset_is_noticed() -> None:
    bench = Bench()
    driver = bench.driver()
    driver.check()
    bench.chip.supply = False
    with pytest.raises(HardwareError, match="does not answer"):
        driver.check()
    bench.chip.supply = True
    with pytest.raises(HardwareError, match="PCA9685 at 0x40: it has been reset"):
        driver.check()
