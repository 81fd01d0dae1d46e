"""The MCP3208 as its data sheet (Microchip DS21298E) describes it, edge by edge."""

from __future__ import annotations

import pytest

from firmware_sim.chips.mcp3208 import Mcp3208
from tests.tables import every_row

VREF_V = 4.096
STEP_V = VREF_V / 4096


def clocked(chip: Mcp3208, bits: str, *, idle: bool = False) -> str:
    """What DOUT shows at each rising edge: 0, 1, or z for high impedance."""
    seen = []
    chip.pins(cs=True, sck=idle, si=False)
    chip.pins(cs=False, sck=idle, si=False)
    for bit in bits.replace(" ", ""):
        chip.pins(cs=False, sck=False, si=bit == "1")
        seen.append("z" if chip.so is None else str(int(chip.so)))
        chip.pins(cs=False, sck=True, si=bit == "1")
    chip.pins(cs=False, sck=idle, si=False)
    chip.pins(cs=True, sck=idle, si=False)
    return "".join(seen)


def reading(code: int, channel: int = 0) -> Mcp3208:
    chip = Mcp3208(VREF_V)
    chip.inputs[channel] = lambda: (code + 0.5) * STEP_V
    return chip


@pytest.mark.parametrize("idle", [False, True], ids=["mode 0,0", "mode 1,1"])
def test_one_conversion_as_in_figure_5_1(idle: bool) -> None:
    # Start, SGL, D2 D1 D0, one clock to sample; then the null bit and B11 to B0.
    assert clocked(reading(0xA5C), "1 1 000 0" + "0" * 13, idle=idle) == "zzzzzz" + "0" + f"{0xA5C:012b}"


@every_row("channel", range(8))
def test_each_input_by_its_number(channel: int) -> None:
    seen = clocked(reading(1000 + channel, channel), f"1 1 {channel:03b} 0" + "0" * 13)
    assert int(seen[-12:], 2) == 1000 + channel


@every_row(("volts", "code"), [(-0.1, 0), (0.0, 0), (VREF_V / 2, 2048), (VREF_V, 4095), (5.0, 4095)])
def test_the_code_is_a_share_of_vref(volts: float, code: int) -> None:
    chip = Mcp3208(VREF_V)
    chip.inputs[0] = lambda: volts
    assert int(clocked(chip, "1 1 000 0" + "0" * 13)[-12:], 2) == code
