"""The simulated AS5600 as its datasheet describes the chip, in bytes."""

from __future__ import annotations

import pytest

from firmware_sim.chips.as5600 import As5600, MagnetFault


class Bench:
    def __init__(self) -> None:
        self.turn = 0.0
        self.chip = As5600(lambda: self.turn, noise_deg_rms=0.0)

    def read(self, register: int, count: int = 1) -> bytes:
        self.chip.write(bytes([register]))
        return self.chip.read(count)


@pytest.mark.parametrize(
    ("turn", "octets"),
    [(0.0, "00 00"), (0.25, "04 00"), (0.5, "08 00"), (4095 / 4096, "0f ff"), (1.0, "00 00"), (-0.25, "0c 00")],
)
def test_raw_angle(turn: float, octets: str) -> None:
    bench = Bench()
    bench.turn = turn
    assert bench.read(0x0C, 2) == bytes.fromhex(octets)


def test_the_pointer_stays_on_the_angle() -> None:
    # "special registers which suppress the automatic increment of the address pointer"
    bench = Bench()
    bench.turn = 0.25
    assert bench.read(0x0C, 4) == bytes.fromhex("04 00 04 00")
    bench.turn = 0.5
    assert bench.chip.read(2) == bytes.fromhex("08 00")


def test_elsewhere_it_moves_on() -> None:
    bench = Bench()
    bench.turn = 0.25
    assert bench.read(0x0B, 3) == bytes.fromhex("20 04 00")


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


@pytest.mark.parametrize(("turn", "angle"), [(0.25, 0), (0.375, 0x800), (0.5, 0xFFF), (0.6, 0xFFF), (0.2, 0), (0.9, 0)])
def test_a_narrowed_range_changes_angle_and_leaves_raw_angle(turn: float, angle: int) -> None:
    bench = Bench()
    bench.chip.write(bytes.fromhex("01 04 00 08 00"))  # ZPOS a quarter, MPOS half a turn
    bench.turn = turn
    assert int.from_bytes(bench.read(0x0E, 2), "big") == angle
    assert int.from_bytes(bench.read(0x0C, 2), "big") == round(turn * 4096)


def test_a_burn_is_remembered() -> None:
    bench = Bench()
    bench.chip.write(b"\xff\x80")
    assert bench.chip.burns == [0x80]
