"""The ADS1115 driver on a simulated chip, against the datasheet (TI SBAS444): registers, times, volts."""

from __future__ import annotations

from functools import partial
from typing import Any

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115 as SimAds1115
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.ads1115 import Ads1115
from hw.ports import HardwareError
from tests.tables import every_row

RATES_SPS = (8, 16, 32, 64, 128, 250, 475, 860)
INPUTS_V = (0.2, 1.1, 2.2, 3.2)


class Bench:
    """One chip, four voltages on its inputs, a bus that takes its time."""

    def __init__(self, oscillator_error: float = 0.0, address: int = 0x48) -> None:
        self.clock = SimClock(10.0)
        self.wire = SimI2CBus(self.clock.sleep)
        self.chip = SimAds1115(self.clock, oscillator_error=oscillator_error)
        self.volts = list(INPUTS_V)
        self.chip.inputs[:] = [partial(self.volts.__getitem__, pin) for pin in range(4)]
        self.clock.add_alarm(self.chip.due_s, lambda _now_s: self.chip.settle())
        self.wire.attach(address, self.chip)

    def driver(self, address: int = 0x48, **settings: float) -> Ads1115:
        return Ads1115(SmbusI2C(self.wire, "bus 1"), address, self.clock.sleep, **settings)  # type: ignore[arg-type]

    def config(self) -> int:
        self.chip.write(b"\x01")
        return int.from_bytes(self.chip.read(2), "big")


# --- the config register, table 8


@pytest.mark.parametrize(
    ("channel", "settings", "config"),
    [
        (0, {"rate_sps": 860, "full_scale_v": 4.096}, 0xC3E3),
        (1, {"rate_sps": 860, "full_scale_v": 4.096}, 0xD3E3),
        (2, {"rate_sps": 128, "full_scale_v": 2.048}, 0xE583),
        (3, {"rate_sps": 8, "full_scale_v": 6.144}, 0xF103),
    ],
)
def test_one_shot_against_ground_with_the_comparator_off(channel: int, settings: dict[str, Any], config: int) -> None:
    bench = Bench()
    bench.driver(**settings).volts(channel)
    assert bench.config() == config  # OS reads 1: the conversion has ended


# --- time: 1 / data rate, the oscillator 10 % fast or slow


@every_row("rate_sps", RATES_SPS)
@every_row("oscillator_error", [-0.1, 0.0, 0.1])
def test_the_result_is_read_when_it_is_there_and_not_much_later(rate_sps: int, oscillator_error: float) -> None:
    bench = Bench(oscillator_error)
    adc = bench.driver(rate_sps=rate_sps)
    started_s = bench.clock()
    for channel in range(4):
        assert adc.volts(channel) == pytest.approx(INPUTS_V[channel], abs=125e-6)
    assert bench.chip.early_reads == 0
    assert bench.clock() - started_s < 4 * (1.1 / rate_sps + 3e-3)


def test_an_oscillator_slower_than_the_datasheet_allows_is_waited_for() -> None:
    bench = Bench(oscillator_error=0.8)
    assert bench.driver(rate_sps=860).volts(1) == pytest.approx(INPUTS_V[1], abs=125e-6)
    assert bench.chip.early_reads == 0


# --- what goes wrong


def test_a_conversion_that_does_not_end() -> None:
    bench = Bench(oscillator_error=1000.0)
    with pytest.raises(HardwareError, match="ADS1115 at 0x48: a conversion does not end"):
        bench.driver().volts(0)
    assert bench.clock() - 10.0 < 0.05, "a dead chip may not hold up the loop"


def test_a_conversion_that_another_program_began_is_not_used() -> None:
    # Section "Conversion modes": a running conversion is completed first; OS written meanwhile has no effect.
    bench = Bench()
    bench.chip.write(b"\x01\x42\xe3")  # continuous, input 0
    bench.clock.sleep(0.01)
    assert bench.driver().volts(2) == pytest.approx(INPUTS_V[2], abs=125e-6)
