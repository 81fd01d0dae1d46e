"""The MCP3208 driver through both kinds of SPI, on a simulated chip that sees every edge."""

from __future__ import annotations

from functools import partial

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.spi import SimSpidev, wire_spi
from firmware_sim.chips.mcp3208 import Mcp3208 as SimChip
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioInputs, GpioOutputs
from hw.buses.spi import SCK, SI, SO, KernelSpi, LineSpi, SpiBus
from hw.chips.mcp3208 import SLOWEST_FRAME_S, Mcp3208
from hw.ports import HardwareError

CHIP = "/dev/gpiochip0"
SELECT, SCK_PIN, SI_PIN, SO_PIN = 8, 11, 10, 9
VREF_V = 3.3


def input_v(channel: int) -> float:
    """Another voltage at each input."""
    return (0.05 + 0.1 * channel) * VREF_V


class Bench:
    """A chip with another voltage at each input."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.chip = SimChip(VREF_V)
        self.chip.inputs[:] = [partial(input_v, pin) for pin in range(8)]
        self.gpio = SimGpio(self.clock)
        wire_spi(self.gpio, self.chip, select=SELECT, sck=SCK_PIN, si=SI_PIN, so=SO_PIN)

    def lines(self) -> LineSpi:
        return LineSpi(
            GpioOutputs(self.gpio, CHIP, {"select": SELECT}, consumer="rotator-spi-select", active_low=True),
            GpioOutputs(self.gpio, CHIP, {SCK: SCK_PIN, SI: SI_PIN}, consumer="rotator-spi"),
            GpioInputs(self.gpio, CHIP, {SO: SO_PIN}, consumer="rotator-spi-so"),
        )

    def kernel(self) -> KernelSpi:
        return KernelSpi(SimSpidev({(0, 0): self.chip}), 0, {"select": 0})

    def driver(self, kind: str) -> Mcp3208:
        bus: SpiBus = self.lines() if kind == "lines" else self.kernel()
        return Mcp3208(bus, "select", VREF_V, self.clock if kind == "lines" else None)


@pytest.mark.parametrize("kind", ["lines", "kernel"])
def test_every_input_reads_its_volts(kind: str) -> None:
    bench = Bench()
    driver = bench.driver(kind)
    for channel in range(8):
        assert driver.volts(channel) == pytest.approx(input_v(channel), abs=VREF_V / 4096)
    assert bench.chip.conversions == 8


def test_on_lines_a_chip_that_is_gone_does_not_answer_and_comes_back() -> None:
    bench = Bench()
    driver = bench.driver("lines")
    assert driver.answers()
    bench.chip.gone = True
    assert not driver.answers()
    with pytest.raises(HardwareError, match="MCP3208: does not answer"):
        driver.volts(0)
    bench.chip.gone = False
    assert driver.volts(0) > 0.0


def test_on_the_kernels_spi_a_chip_that_is_gone_reads_nothing_which_no_window_believes() -> None:
    bench = Bench()
    bench.chip.gone = True
    assert bench.driver("kernel").volts(5) == 0.0


@pytest.mark.parametrize(("pauses", "readings"), [(0, 1), (1, 2), (2, 3)])
def test_a_frame_with_a_pause_is_read_again(pauses: int, readings: int) -> None:
    bench = Bench()
    held_s = [2 * SLOWEST_FRAME_S] * pauses

    def interrupted() -> float:
        if held_s:
            bench.clock.sleep(held_s.pop())
        return 1.1

    bench.chip.inputs[0] = interrupted
    assert bench.driver("lines").volts(0) == pytest.approx(1.1, abs=VREF_V / 4096)
    assert bench.chip.conversions == readings


def test_a_computer_that_is_always_too_slow() -> None:
    bench = Bench()
    bench.chip.inputs[0] = lambda: bench.clock.sleep(2 * SLOWEST_FRAME_S) or 1.1  # type: ignore[func-returns-value]
    with pytest.raises(HardwareError, match=r'adc\.spi = "kernel"'):
        bench.driver("lines").volts(0)
