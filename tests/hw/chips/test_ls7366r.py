"""An LS7366R on simulated SPI: it counts for any speed and without the program; without supply its count is lost."""

from __future__ import annotations

import pytest

from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.ls7366r import Ls7366r as SimChip
from firmware_sim.clock import SimClock
from hw.buses.spi import KernelSpi
from hw.chips.ls7366r import Ls7366r, Mode
from hw.ports import HardwareError
from hw.sensors.chip_count import ChipCounter

CLOCKWISE = ((0, True), (1, True), (0, False), (1, False))


class Bench:
    def __init__(self) -> None:
        self.sim = SimChip()
        self.spidev = SimSpidev({(0, 0): self.sim})
        self.chip = Ls7366r(KernelSpi(self.spidev, 0, {"azimuth.select": 0}), "azimuth.select")
        self.turned = 0

    def turn(self, counts: int) -> None:
        """Clockwise, A leads; negative: counter-clockwise."""
        for _ in range(abs(counts)):
            step = self.turned if counts > 0 else self.turned - 1
            channel, level = CLOCKWISE[step % 4]
            self.sim.edge(channel, level if counts > 0 else not level)
            self.turned += 1 if counts > 0 else -1

    def counter(self, counts_per_deg: float = 200.0) -> ChipCounter:
        return ChipCounter(self.chip, counts_per_deg, SimClock())

    def exchange(self, *octets: int) -> str:
        device = self.spidev.SpiDev()
        device.open(0, 0)
        return bytes(device.xfer2(octets)[1:]).hex(" ")


def test_instructions_as_in_table_1() -> None:
    bench = Bench()
    assert bench.exchange(0x70, 0) == "0c", "STR after power-on: counting enabled, power was lost"
    bench.exchange(0x30)  # CLR STR
    bench.exchange(0x88, 0x03)  # WR MDR0: four counts a period
    assert bench.exchange(0x48, 0) == "03"
    bench.turn(5)
    assert bench.exchange(0x60, 0, 0, 0, 0) == "00 00 00 05"
    bench.turn(-6)
    assert bench.exchange(0x60, 0, 0, 0, 0) == "ff ff ff ff"
    assert bench.exchange(0x70, 0) == "09", "down, and negative"
    bench.turn(3)
    assert bench.exchange(0x68, 0, 0, 0, 0) == "ff ff ff ff", "OTR keeps what CNTR was"
    bench.exchange(0x98, 0x00, 0x01, 0x02, 0x03)  # WR DTR
    bench.exchange(0xE0)  # LOAD CNTR
    assert bench.exchange(0x60, 0, 0, 0, 0) == "00 01 02 03"
    bench.exchange(0x90, 0x04)  # WR MDR1: counting disabled
    bench.turn(3)
    assert bench.exchange(0x60, 0, 0, 0, 0) == "00 01 02 03"
    assert bench.exchange(0x70, 0) == "02"


@pytest.mark.parametrize(("counts_per_deg", "there_deg"), [(200.0, 95.0), (-200.0, 85.0)])
def test_a_thousand_counts_there_and_back(counts_per_deg: float, there_deg: float) -> None:
    bench = Bench()
    counter = bench.counter(counts_per_deg)
    assert counter.trouble == "it has not been placed yet"
    counter.place(90.0)
    bench.turn(1000)
    assert counter.read() == pytest.approx(there_deg)
    bench.turn(-1000)
    assert counter.read() == pytest.approx(90.0)
    assert (counter.changes, counter.trouble) == (2000, "")


def test_the_next_run_finds_what_the_chip_counted_meanwhile() -> None:
    bench = Bench()
    bench.counter().place(-12.5)
    bench.turn(4000)  # the program has died, and the motor runs on
    after = bench.counter()
    assert after.kept_deg == pytest.approx(7.5)
    assert after.trouble == "it has not been placed yet"
    after.place(7.5)
    bench.turn(-200)
    assert after.read() == pytest.approx(6.5)


def test_a_count_that_nobody_placed_is_no_angle_for_the_next_run() -> None:
    bench = Bench()
    bench.counter()
    bench.turn(400)
    assert bench.counter().kept_deg is None


def test_a_power_cut_is_seen_even_if_it_was_too_short_for_a_reading_to_fail() -> None:
    bench = Bench()
    counter = bench.counter()
    counter.place(90.0)
    bench.turn(200)
    assert counter.read() == 91.0
    bench.sim.power_on()
    bench.turn(200)
    counter.read()
    assert counter.trouble == "its counter chip was without supply, and has lost the count"
    assert bench.counter().kept_deg is None
    before_deg = counter.read()
    bench.turn(200)  # it counts again: a press of jog is followed
    assert counter.read() == pytest.approx(before_deg + 1.0)
    counter.place(123.0)
    assert (counter.read(), counter.trouble) == (123.0, "")


def test_a_count_over_the_end_of_31_bits() -> None:
    bench = Bench()
    counter = bench.counter(1.0)
    counter.place((1 << 31) - 3)
    bench.turn(10)
    assert counter.read() == (1 << 31) + 7


class Held:
    """A data line that something holds at one level."""

    def __init__(self, level: bool) -> None:
        self.so = level

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        pass


@pytest.mark.parametrize("level", [False, True])
def test_a_line_held_at_one_level_is_no_count(level: bool) -> None:
    chip = Ls7366r(KernelSpi(SimSpidev({(0, 0): Held(level)}), 0, {"azimuth.select": 0}), "azimuth.select")
    with pytest.raises(HardwareError, match=r"LS7366R \(azimuth.select\): does not answer; look at its supply"):
        chip.look()


def test_a_chip_that_is_not_allowed_to_count() -> None:
    bench = Bench()
    bench.sim.enabled = False
    with pytest.raises(HardwareError, match="it does not count: wire its CNT_EN to its supply"):
        bench.counter()


def test_a_mode_that_nobody_wrote_is_a_spark_and_no_power_cut() -> None:
    bench = Bench()
    bench.counter().place(10.0)
    bench.sim.registers[1] = 0x13
    with pytest.raises(HardwareError, match="arrives with errors"):
        bench.chip.look()
    bench.sim.registers[1] = Mode.PLACED
    assert bench.chip.look() == (2000, Mode.PLACED)
