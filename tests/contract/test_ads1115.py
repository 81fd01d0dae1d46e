"""The converter's driver on a bus: each input, and a chip that goes, comes back or never ends its conversion."""

from __future__ import annotations

import time

import pytest

from hw.chips.ads1115 import Ads1115
from hw.ports import HardwareError
from tests.contract.bench import EMPTY_ADDRESS, Bench

INPUTS_V = (0.2, 1.1, 2.2, 3.2)
STEP_V = 125e-6


@pytest.fixture
def adc(bench: Bench) -> Ads1115:
    return Ads1115(bench.bus, bench.adc_address, time.sleep)


@pytest.fixture
def _volts(bench: Bench) -> None:
    for channel, volts in enumerate(INPUTS_V):
        bench.set_volts(channel, volts)


@pytest.mark.usefixtures("_volts")
def test_each_channel_reads_its_own_input_in_any_order(adc: Ads1115) -> None:
    for channel in (0, 1, 0, 3, 2, 1, 1, 3, 0):
        assert adc.volts(channel) == pytest.approx(INPUTS_V[channel], abs=STEP_V)


def test_a_reading_lies_between_the_rails(adc: Ads1115) -> None:
    for channel in range(4):
        assert -0.3 <= adc.volts(channel) <= 4.096


def test_a_voltage_that_changes_is_followed(bench: Bench, adc: Ads1115) -> None:
    for hundredths in range(0, 330, 30):
        bench.set_volts(0, hundredths / 100)
        assert adc.volts(0) == pytest.approx(hundredths / 100, abs=STEP_V)


def test_a_chip_that_is_not_there(bench: Bench) -> None:
    with pytest.raises(HardwareError, match=r"the device does not answer.*\(address 0x35\)"):
        Ads1115(bench.bus, EMPTY_ADDRESS, time.sleep).volts(0)


@pytest.mark.usefixtures("_volts")
def test_a_chip_that_goes_and_comes_back(bench: Bench, adc: Ads1115) -> None:
    for _ in range(3):
        assert adc.volts(1) == pytest.approx(INPUTS_V[1], abs=STEP_V)
        bench.unplug(bench.adc_address)
        with pytest.raises(HardwareError, match="does not answer"):
            adc.volts(1)
        bench.replug(bench.adc_address)


@pytest.mark.usefixtures("_volts")
def test_a_bus_that_hangs_is_a_sentence_and_then_it_reads_again(bench: Bench, adc: Ads1115) -> None:
    bench.hang()
    with pytest.raises(HardwareError, match="something holds SDA or SCL low"):
        adc.volts(2)
    bench.release()
    assert adc.volts(2) == pytest.approx(INPUTS_V[2], abs=STEP_V)
