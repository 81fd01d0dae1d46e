"""The simulated encoders as their data sheets describe the chips, in bits on the wire."""

from __future__ import annotations

import pytest

from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.as5045 import As5045
from firmware_sim.chips.as5048 import As5048a, As5048b
from firmware_sim.chips.magnet import MagnetFault
from firmware_sim.chips.mt6701 import Mt6701, Mt6701Ssi
from tests.tables import every_row


def exchange(chip: As5045 | As5048a | Mt6701Ssi, mode: int, *octets: int) -> int:
    device = SimSpidev({(0, 0): chip}).SpiDev()
    device.open(0, 0)
    device.mode = mode
    return int.from_bytes(bytes(device.xfer2(octets)), "big")


@every_row(
    ("turn", "fault", "answer"),
    [
        # D11 to D0, OCF, COF, LIN, MagINC, MagDEC, even parity
        (0.0, MagnetFault.NONE, "000000000000 100001"),
        (0.25, MagnetFault.NONE, "010000000000 100000"),
        (4095 / 4096, MagnetFault.NONE, "111111111111 100001"),
        (0.25, MagnetFault.WEAK, "010000000000 101111"),  # below 25 mT: red
        (0.25, MagnetFault.STRONG, "010000000000 101111"),  # above 135 mT: red
    ],
)
def test_as5045(turn: float, fault: MagnetFault, answer: str) -> None:
    chip = As5045(lambda: turn, noise_deg_rms=0.0)
    chip.fault = fault
    bits = f"{exchange(chip, 2, 0, 0, 0):024b}"
    # DO is high until the first rising edge of the clock; behind the answer comes what the pin PDIO gives, here ground.
    assert bits == "1" + answer.replace(" ", "") + "00000"


def test_as5045_with_a_clock_that_rests_low() -> None:
    """Mode 1: the answer is latched at the first falling edge all the same, one clock later than it could be."""
    chip = As5045(lambda: 0.25, noise_deg_rms=0.0)
    assert f"{exchange(chip, 1, 0, 0, 0):024b}"[1:13] == "010000000000"


@every_row(
    ("order", "answer"),
    [
        (0xFFFF, 0x1000),  # READ ANGLE: a quarter of a turn is 0x1000, and one bit of parity
        (0x7FFD, 0x0140),  # READ DIAGNOSTICS AND AGC at 60 mT: OCF, and a gain of 64
        (0x4001, 0x0000),  # CLEAR ERROR FLAG: there was none
    ],
)
def test_as5048a(order: int, answer: int) -> None:
    chip = As5048a(lambda: 0.25, noise_deg_rms=0.0)
    exchange(chip, 1, order >> 8, order & 0xFF)
    got = exchange(chip, 1, 0xC0, 0x00)  # NOP: the answer comes with the next frame
    assert got & 0x3FFF == answer & 0x3FFF
    assert not got & 0x4000
    assert got.bit_count() % 2 == 0


@pytest.mark.parametrize(
    ("frame", "error"),
    [((0x7F, 0xFF), 0b100), ((0xFF,), 0b001), ((0x40, 0x02), 0b010)],
    ids=["wrong parity", "eight clocks", "no such register"],
)
def test_the_error_flag_of_an_as5048a(frame: tuple[int, ...], error: int) -> None:
    chip = As5048a(lambda: 0.25, noise_deg_rms=0.0)
    exchange(chip, 1, *frame)
    assert exchange(chip, 1, 0xFF, 0xFF) & 0x4000
    assert exchange(chip, 1, 0x40, 0x01) & 0x4000
    assert exchange(chip, 1, 0xC0, 0x00) & 0x3FFF == error
    assert not exchange(chip, 1, 0xC0, 0x00) & 0x4000, "reading the errors clears them"


@every_row(
    ("fault", "registers"),
    [
        # AGC, diagnostics, magnitude (8 and 6 bits), angle (8 and 6 bits) at a third of a turn: 0x1555
        (MagnetFault.NONE, "40 01 38 10 55 15"),
        (MagnetFault.WEAK, "ff 09 0e 04 55 15"),
        (MagnetFault.STRONG, "00 05 8c 28 55 15"),
    ],
)
def test_as5048b(fault: MagnetFault, registers: str) -> None:
    chip = As5048b(lambda: 1 / 3, noise_deg_rms=0.0)
    chip.fault = fault
    chip.write(b"\xfa")
    assert chip.read(6).hex(" ") == registers


@every_row(
    ("turn", "octets"), [(0.0, "00 00"), (0.25, "40 00"), (1 / 3, "55 54"), (16383 / 16384, "ff fc"), (-0.25, "c0 00")]
)
def test_mt6701_on_i2c(turn: float, octets: str) -> None:
    chip = Mt6701(lambda: turn, noise_deg_rms=0.0)
    chip.write(b"\x03")
    assert chip.read(2).hex(" ") == octets


@every_row(
    ("turn", "fault", "answer"),
    [
        # angle, status, checksum x⁶ + x + 1 over both
        (0.0, MagnetFault.NONE, "00000000000000 0000 000000"),
        (1 / 16384, MagnetFault.NONE, "00000000000001 0000 110000"),  # x¹⁰ = x⁴·x⁶ = x⁵ + x⁴
        (0.0, MagnetFault.WEAK, "00000000000000 0010 000110"),  # x⁷ = x² + x
        (0.0, MagnetFault.STRONG, "00000000000000 0001 000011"),  # x⁶ = x + 1
    ],
)
def test_mt6701_on_ssi(turn: float, fault: MagnetFault, answer: str) -> None:
    chip = Mt6701Ssi(lambda: turn, noise_deg_rms=0.0)
    chip.fault = fault
    assert f"{exchange(chip, 1, 0, 0, 0):024b}" == answer.replace(" ", "")
    assert f"{exchange(chip, 2, 0, 0, 0, 0):032b}"[1:25] == answer.replace(" ", "")
