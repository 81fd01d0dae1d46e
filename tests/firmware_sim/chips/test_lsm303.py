"""The simulated accelerometer of an LSM303DLHC as its data sheet (ST, section 7.1) describes it, in bytes."""

from __future__ import annotations

import struct

import pytest

from firmware_sim.chips.lsm303 import Lsm303Accelerometer


class Bench:
    def __init__(self) -> None:
        self.now_s = 0.0
        self.feels_g = (0.0, -0.5, 1.0)
        self.chip = Lsm303Accelerometer(lambda: self.now_s, lambda: self.feels_g, noisy=False)

    def counts(self, register: int = 0xA8) -> tuple[int, ...]:
        self.chip.write(bytes([register]))
        return struct.unpack("<hhh", self.chip.read(6))


def test_it_is_off_until_a_rate_is_written_and_needs_seven_results() -> None:
    bench = Bench()
    bench.chip.write(b"\x20")
    assert bench.chip.read(1) == b"\x07"
    bench.now_s = 10.0
    assert bench.counts() == (0, 0, 0)
    bench.chip.write(b"\x20\x57")
    bench.now_s += 0.069
    assert bench.counts() == (0, 0, 0)
    bench.now_s += 0.002
    assert bench.counts() == (0, -500 << 4, 1000 << 4)


def test_only_with_bit_7_a_transfer_goes_on_to_the_next_register() -> None:
    bench = Bench()
    bench.chip.write(b"\x20\x57")
    bench.now_s = 1.0
    low, high = (1000 << 4).to_bytes(2, "little")
    bench.chip.write(b"\x2d")
    assert bench.chip.read(3) == bytes([high] * 3)
    bench.chip.write(b"\xac")
    assert bench.chip.read(2) == bytes([low, high])


@pytest.mark.parametrize(("ctrl_4", "mg"), [(0x00, 1), (0x10, 2), (0x20, 4), (0x30, 12)])
def test_ranges(ctrl_4: int, mg: int) -> None:
    bench = Bench()
    bench.chip.write(bytes([0x23, ctrl_4]))
    bench.chip.write(b"\x20\x57")
    bench.now_s = 1.0
    assert bench.counts()[2] == round(1000 / mg) << 4
