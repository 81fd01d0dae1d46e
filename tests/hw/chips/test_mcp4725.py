"""The MCP4725 driver on a simulated chip: the voltage, and with what it wakes."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.mcp4725 import Mcp4725 as SimChip
from hw.buses.i2c import SmbusI2C
from hw.chips.mcp4725 import Mcp4725

STEP = 1 / 4096


class Bench:
    def __init__(self) -> None:
        self.wire = SimI2CBus()
        self.chip = SimChip()
        self.wire.attach(0x60, self.chip)

    def driver(self, wakes: float = 0.0) -> Mcp4725:
        return Mcp4725(SmbusI2C(self.wire, "bus 1"), 0x60, wakes)


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_the_voltage_is_that_share_of_the_supply(share: float) -> None:
    bench = Bench()
    bench.driver().duty(share)
    assert bench.chip.share == pytest.approx(share, abs=STEP)


@pytest.mark.parametrize(("asked", "given"), [(-1.0, 0.0), (1.5, 1.0 - STEP)])
def test_no_share_goes_round(asked: float, given: float) -> None:
    bench = Bench()
    bench.driver().duty(asked)
    assert bench.chip.share == given


@pytest.mark.parametrize("wakes", [0.0, 0.2, 1.0])
def test_a_chip_as_sold_wakes_in_the_middle_and_from_its_first_start_on_as_it_should(wakes: float) -> None:
    bench = Bench()
    assert bench.chip.share == 0.5
    bench.driver(wakes).duty(0.7)
    bench.chip.power_on()
    assert bench.chip.share == pytest.approx(wakes, abs=STEP)


def test_its_eeprom_which_wears_out_is_written_once() -> None:
    bench = Bench()
    for _ in range(3):
        bench.driver(0.1).duty(0.6)
    assert bench.chip.kept_writes == 1
