"""The simulated AS5600 as its datasheet describes the chip, in bytes."""

from __future__ import annotations

import pytest

from firmware_sim.chips.as5600 import As5600
from firmware_sim.chips.magnet import MagnetFault
from tests.tables import every_row


class Bench:
    def __init__(self) -> None:
        self.turn = 0.0
        self.chip = As5600(lambda: self.turn, noise_deg_rms=0.0)

    def read(self, register: int, count: int = 1) -> bytes:
        self.chip.write(bytes([register]))
        return self.chip.read(count)


@every_row(
    ("turn", "octets"),
    [(0.0, "00 00"), (0.25, "04 00"), (0.5, "08 00"), (4095 / 4096, "0f ff"), (1.0, "00 00"), (-0.25, "0c 00")],
)
def test_raw_angle(turn: float, octets: str) -> None:
    bench = Bench()
    bench.turn = turn
    assert bench.read(0x0C, 2) == bytes.fromhex(octets)


@pytest.mark.parametrize(
    ("fault", "status", "gain"),
    [
        (MagnetFault.NONE, 0b00100000, 64),  # the gain in the middle of its range at 3.3 V
        (MagnetFault.MISSING, 0b00010000, 128),
        (MagnetFault.WEAK, 0b00110000, 128),
        (MagnetFault.STRONG, 0b00101000, 0),
    ],
)
def test_status_and_gain(fault: MagnetFault, status: int, gain: int) -> None:
    bench = Bench()
    bench.chip.fault = fault
    assert (bench.read(0x0B)[0], bench.read(0x1A)[0]) == (status, gain)
