"""The MCP41010 driver through both kinds of SPI, on simulated chips that see every edge."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.mcp41010 import Mcp41010 as SimChip
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.buses.spi import SCK, SI, KernelSpi, LineSpi, SpiBus
from hw.chips.mcp41010 import Mcp41010
from hw.ports import HardwareError

SELECTS = {"azimuth": 8, "elevation": 7}
SCK_PIN, SI_PIN = 11, 10


class Bench:
    """Two chips on common wires."""

    def __init__(self) -> None:
        self.chips = {name: SimChip() for name in SELECTS}
        self.gpio = SimGpio(SimClock())
        self.gpio.on_edges.append(self._edges)

    def _edges(self, _at_s: float, _changes: Mapping[int, bool]) -> None:
        for name, chip in self.chips.items():
            chip.pins(cs=self.gpio.level(SELECTS[name]), sck=self.gpio.level(SCK_PIN), si=self.gpio.level(SI_PIN))

    def lines(self) -> LineSpi:
        return LineSpi(
            GpioOutputs(self.gpio, "/dev/gpiochip0", SELECTS, consumer="rotator-spi", active_low=True),
            GpioOutputs(self.gpio, "/dev/gpiochip0", {SCK: SCK_PIN, SI: SI_PIN}, consumer="rotator-spi"),
        )

    def kernel(self) -> KernelSpi:
        chips = {(0, 0): self.chips["azimuth"], (0, 1): self.chips["elevation"]}
        return KernelSpi(SimSpidev(chips), 0, {"azimuth": 0, "elevation": 1})

    def bus(self, kind: str) -> SpiBus:
        return self.lines() if kind == "lines" else self.kernel()


@pytest.mark.parametrize("kind", ["lines", "kernel"])
def test_every_step_arrives_at_its_chip_and_at_no_other(kind: str) -> None:
    bench = Bench()
    bus = bench.bus(kind)
    azimuth, elevation = Mcp41010(bus, "azimuth"), Mcp41010(bus, "elevation")
    elevation.write(7)
    for step in range(256):
        azimuth.write(step)
        assert (bench.chips["azimuth"].step, bench.chips["elevation"].step) == (step, 7)
    assert bench.chips["elevation"].frames == 1


def test_taking_the_lines_moves_no_wiper() -> None:
    bench = Bench()
    bench.lines()
    assert [chip.frames for chip in bench.chips.values()] == [0, 0]
    assert bench.gpio.level(SELECTS["azimuth"])


def test_a_kernel_without_spi() -> None:
    with pytest.raises(HardwareError, match=r"there is no /dev/spidev0.0: switch SPI on"):
        KernelSpi(SimSpidev({}), 0, {"azimuth": 0})
