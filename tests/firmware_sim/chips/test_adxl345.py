"""The simulated ADXL345 as its data sheet (Analog Devices, rev. E) describes the chip, in bytes."""

from __future__ import annotations

import struct

import pytest

from firmware_sim.chips.adxl345 import Adxl345


class Bench:
    def __init__(self) -> None:
        self.now_s = 0.0
        self.feels_g = (0.0, 0.0, 1.0)
        self.chip = Adxl345(lambda: self.now_s, lambda: self.feels_g, noisy=False)

    def counts(self) -> tuple[int, ...]:
        self.chip.write(b"\x32")
        return struct.unpack("<hhh", self.chip.read(6))

    def measure(self) -> None:
        self.chip.write(b"\x2d\x08")
        self.now_s += 0.1


def test_its_name_and_standby_after_power_on() -> None:
    bench = Bench()
    bench.now_s = 10.0
    bench.chip.write(b"\x00")
    assert bench.chip.read(1) == b"\xe5"
    bench.chip.write(b"\x2c")
    assert bench.chip.read(2) == b"\x0a\x00", "100 Hz, and it measures nothing"
    assert bench.counts() == (0, 0, 0)


def test_turn_on_time_is_a_period_and_a_millisecond() -> None:
    bench = Bench()
    bench.chip.write(b"\x2d\x08")
    bench.now_s = 0.011
    assert bench.counts() == (0, 0, 0)
    bench.now_s = 0.0112
    assert bench.counts() == (0, 0, 256)


@pytest.mark.parametrize(
    ("data_format", "one_g", "most"), [(0x00, 256, 511), (0x01, 128, 511), (0x03, 32, 511), (0x0B, 256, 4095)]
)
def test_ten_bits_or_full_resolution(data_format: int, one_g: int, most: int) -> None:
    bench = Bench()
    bench.chip.write(bytes([0x31, data_format]))
    bench.measure()
    bench.feels_g = (-1.0, 0.0, 99.0)
    assert bench.counts() == (-one_g, 0, most)
