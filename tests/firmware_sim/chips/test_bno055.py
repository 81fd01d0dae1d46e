"""The simulated BNO055 as its datasheet describes the chip, in bytes; then its faults, one by one."""

from __future__ import annotations

import struct

import pytest

from firmware_sim.buses.i2c import Nack
from firmware_sim.chips.bno055 import Bno055


class Bench:
    def __init__(self, noise_deg_rms: float = 0.0) -> None:
        self.now_s = 0.0
        self.heading_deg, self.pitch_deg = 100.0, 20.0
        self.chip = Bno055(
            lambda: self.now_s, lambda: self.heading_deg, pitch_deg=lambda: self.pitch_deg, noise_deg_rms=noise_deg_rms
        )

    def read(self, at: int, count: int = 1) -> bytes:
        self.chip.write(bytes([at]))
        return self.chip.read(count)

    def run(self) -> None:
        """Booted, fusion on, errors learnt."""
        self.now_s = 1.0
        self.chip.write(b"\x3d\x0c")
        self.now_s = 30.0

    def euler(self) -> tuple[int, int, int]:
        heading, roll, pitch = struct.unpack("<hhh", self.read(0x1A, 6))
        return heading, roll, pitch


@pytest.mark.parametrize(("reset", "boot_s"), [(False, 0.4), (True, 0.65)])
def test_booting_it_acknowledges_nothing(reset: bool, boot_s: float) -> None:
    bench = Bench()
    if reset:
        bench.now_s = 1.0
        bench.chip.write(b"\x3f\x20")
    bench.now_s += boot_s - 0.01
    with pytest.raises(Nack):
        bench.read(0x00)
    bench.now_s += 0.02
    assert bench.read(0x00) == b"\xa0"


def test_a_mode_takes_its_time() -> None:
    # table 3-6: CONFIG to any 7 ms, any to CONFIG 19 ms
    bench = Bench()
    for mode, latency_s in ((0x0C, 0.007), (0x00, 0.019)):
        bench.now_s += 1.0
        before = bench.read(0x3D)
        bench.chip.write(bytes([0x3D, mode]))
        bench.now_s += latency_s - 0.001
        assert bench.read(0x3D) == before
        bench.now_s += 0.002
        assert bench.read(0x3D)[0] == mode


@pytest.mark.parametrize(("units", "pitch"), [(0x80, -320), (0x00, 320)], ids=["Android", "Windows"])
def test_sixteen_steps_a_degree_and_the_sign_of_the_pitch(units: int, pitch: int) -> None:
    bench = Bench()
    bench.now_s = 0.5
    bench.chip.write(bytes([0x3B, units]))
    bench.run()
    assert bench.euler() == (1600, 0, pitch)


# --- faults


def test_busy_it_does_not_acknowledge() -> None:
    bench = Bench()
    bench.run()
    bench.chip.nack_share = 1.0
    with pytest.raises(Nack):
        bench.read(0x00)
