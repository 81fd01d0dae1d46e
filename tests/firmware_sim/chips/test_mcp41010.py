"""The MCP41010 as its datasheet (Microchip DS11195C) describes it, edge by edge."""

from __future__ import annotations

from firmware_sim.chips.mcp41010 import Mcp41010
from tests.tables import every_row


def clock_in(chip: Mcp41010, bits: str, *, idle: bool = False) -> None:
    chip.pins(cs=True, sck=idle, si=False)
    chip.pins(cs=False, sck=idle, si=False)
    for bit in bits.replace(" ", ""):
        chip.pins(cs=False, sck=False, si=bit == "1")
        chip.pins(cs=False, sck=True, si=bit == "1")
    chip.pins(cs=False, sck=idle, si=False)
    chip.pins(cs=True, sck=idle, si=False)


@every_row(
    ("bits", "step"),
    [
        ("00010001 01000000", 0x40),
        ("00010011 11111111", 0xFF),  # both pots
        ("11011101 00000001", 0x01),  # "don't care" bits
        ("00010010 01000000", 0x80),  # the other pot
        ("00000001 01000000", 0x80),  # no command
        ("00110001 01000000", 0x80),
        ("00010001 0100000", 0x80),  # 15 clocks: ignored
        ("00010001 01000000 1", 0x80),
        ("", 0x80),
        ("00010001 11110000 00010001 00000111", 0x07),  # 32: the last 16 count
    ],
)
@every_row("idle", [False, True])
def test_frames(bits: str, step: int, idle: bool) -> None:
    chip = Mcp41010()
    clock_in(chip, bits, idle=idle)
    assert chip.step == step


def test_the_wiper_moves_when_the_select_rises_and_not_before() -> None:
    chip = Mcp41010()
    chip.pins(cs=False, sck=False, si=False)
    for bit in "0001000101000000":
        chip.pins(cs=False, sck=False, si=bit == "1")
        chip.pins(cs=False, sck=True, si=bit == "1")
    assert chip.step == 0x80
    chip.pins(cs=True, sck=True, si=False)
    assert chip.step == 0x40


def test_a_supply_that_dips_puts_it_in_the_middle() -> None:
    chip = Mcp41010()
    clock_in(chip, "00010001 01000000")
    chip.power_on()
    assert chip.step == 0x80
