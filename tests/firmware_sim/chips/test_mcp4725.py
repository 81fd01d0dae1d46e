"""The simulated MCP4725 against the byte tables of its data sheet (Microchip DS22039D, figures 6-1 to 6-3)."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import Nack
from firmware_sim.chips.mcp4725 import Mcp4725


def test_as_sold_it_is_ready_and_in_the_middle() -> None:
    assert Mcp4725().read(5) == bytes([0xC0, 0x80, 0x00, 0x08, 0x00])


def test_the_fast_command_writes_the_converter_alone() -> None:
    chip = Mcp4725()
    chip.write(bytes([0x0A, 0xBC]))
    assert chip.read(5) == bytes([0xC0, 0xAB, 0xC0, 0x08, 0x00])
    chip.write(bytes([0x01, 0x23, 0x04, 0x56]))
    assert chip.read(3) == bytes([0xC0, 0x45, 0x60])


def test_the_long_commands_write_the_converter_and_with_it_the_eeprom() -> None:
    chip = Mcp4725()
    chip.write(bytes([0x40, 0x12, 0x30]))
    assert chip.read(5) == bytes([0xC0, 0x12, 0x30, 0x08, 0x00])
    chip.write(bytes([0x60, 0x45, 0x60]))
    assert chip.read(5) == bytes([0xC0, 0x45, 0x60, 0x04, 0x56])


def test_in_power_down_its_output_is_at_ground() -> None:
    chip = Mcp4725()
    chip.write(bytes([0x1F, 0xFF]))
    assert chip.share == 0.0
    chip.write(bytes([0x0F, 0xFF]))
    assert chip.share == 4095 / 4096


@pytest.mark.parametrize("data", [b"\x00", b"\x60\x00", b"\x80\x00\x00", b"\xc0\x00\x00"])
def test_what_is_no_command_is_not_acknowledged(data: bytes) -> None:
    with pytest.raises(Nack):
        Mcp4725().write(data)
