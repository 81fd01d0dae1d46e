"""The MCP3208 as its data sheet (Microchip DS21298E) describes it, edge by edge."""

from __future__ import annotations

import pytest

from firmware_sim.chips.mcp3208 import Mcp3208

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


def test_further_clocks_show_it_again_from_the_other_end_and_then_zeros_as_in_figure_5_2() -> None:
    seen = clocked(reading(0xA5C), "1 1 000 0" + "0" * (13 + 11 + 3))
    assert seen[19:] == f"{0xA5C:012b}"[:-1][::-1] + "000"


@pytest.mark.parametrize("leading", range(8))
def test_leading_zeros_before_the_start_bit(leading: int) -> None:
    seen = clocked(reading(0x123), "0" * leading + "1 1 000 0" + "0" * 13)
    assert seen.endswith(f"0{0x123:012b}")


@pytest.mark.parametrize("channel", range(8))
def test_each_input_by_its_number(channel: int) -> None:
    seen = clocked(reading(1000 + channel, channel), f"1 1 {channel:03b} 0" + "0" * 13)
    assert int(seen[-12:], 2) == 1000 + channel


@pytest.mark.parametrize(("order", "code"), [("000", 300), ("001", 0), ("010", 0), ("011", 200)])
def test_pairs_as_in_table_5_2(order: str, code: int) -> None:
    chip = Mcp3208(VREF_V)
    for pin, steps in enumerate((500.5, 200, 100, 300.5)):
        chip.inputs[pin] = lambda steps=steps: steps * STEP_V  # type: ignore[misc]
    assert int(clocked(chip, f"1 0 {order} 0" + "0" * 13)[-12:], 2) == code


@pytest.mark.parametrize(("volts", "code"), [(-0.1, 0), (0.0, 0), (VREF_V / 2, 2048), (VREF_V, 4095), (5.0, 4095)])
def test_the_code_is_a_share_of_vref(volts: float, code: int) -> None:
    chip = Mcp3208(VREF_V)
    chip.inputs[0] = lambda: volts
    assert int(clocked(chip, "1 1 000 0" + "0" * 13)[-12:], 2) == code


def test_a_select_that_rises_too_early_ends_it() -> None:
    chip = reading(0xFFF)
    assert set(clocked(chip, "1 1 000")) == {"z"}
    assert chip.conversions == 0
    assert clocked(chip, "1 1 000 0" + "0" * 13).endswith("0" + "1" * 12)


def test_clocks_without_select_and_zeros_do_nothing() -> None:
    chip = reading(0xFFF)
    for _ in range(24):
        chip.pins(cs=True, sck=True, si=True)
        chip.pins(cs=True, sck=False, si=True)
    assert chip.so is None
    assert set(clocked(chip, "0" * 24)) == {"z"}


def test_without_supply_it_drives_nothing() -> None:
    chip = reading(0xFFF)
    chip.gone = True
    assert set(clocked(chip, "1 1 000 0" + "0" * 13)) == {"z"}
