"""The simulated MPU6050 as its register map (RM-MPU-6000A) describes the chip, in bytes."""

from __future__ import annotations

import struct

import pytest

from firmware_sim.chips.mpu6050 import Mpu6050


class Bench:
    def __init__(self, noise_g_per_root_hz: float = 0.0) -> None:
        self.now_s = 0.0
        self.feels_g = (0.0, 0.0, 1.0)
        self.chip = Mpu6050(lambda: self.now_s, lambda: self.feels_g, noise_g_per_root_hz=noise_g_per_root_hz)

    def register(self, at: int) -> int:
        self.chip.write(bytes([at]))
        return self.chip.read(1)[0]

    def counts(self) -> tuple[int, int, int]:
        self.chip.write(b"\x3b")
        x, y, z = struct.unpack(">hhh", self.chip.read(6))
        return x, y, z

    def wake(self) -> None:
        self.chip.write(b"\x6b\x00")
        self.now_s += 0.05


def test_asleep_it_says_nothing_and_takes_its_time_to_wake() -> None:
    bench = Bench()
    bench.now_s = 10.0
    assert bench.counts() == (0, 0, 0)
    bench.chip.write(b"\x6b\x00")
    bench.now_s += 0.029
    assert bench.counts() == (0, 0, 0)
    bench.now_s += 0.002
    assert bench.counts() == (0, 0, 16384)


@pytest.mark.parametrize(("afs_sel", "steps"), [(0, 16384), (1, 8192), (2, 4096), (3, 2048)])
def test_ranges(afs_sel: int, steps: int) -> None:
    bench = Bench()
    bench.wake()
    bench.chip.write(bytes([0x1C, afs_sel << 3]))
    bench.feels_g = (-0.5, 0.25, 1.0)
    assert bench.counts() == (-steps // 2, steps // 4, steps)
