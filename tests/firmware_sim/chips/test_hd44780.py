"""The HD44780U as its datasheet (Hitachi ADE-207-272) describes it: instructions, times, nibbles.

Moves pins and a clock by hand, the way the datasheet's timing diagrams do. Knows no driver.
"""

from __future__ import annotations

import pytest

from firmware_sim.chips.hd44780 import Hd44780


class Bench:
    """Seven wires to the display, and the clock on the wall."""

    def __init__(self, columns: int = 16, rows: int = 2, pause_s: float = 50e-6) -> None:
        self.now_s = 100.0
        self.lcd = Hd44780(lambda: self.now_s, columns, rows)
        self.pause_s = pause_s
        """Time after each nibble: 37 us and what an oscillator may be slow."""

    def nibble(self, value: int, rs: bool = False, e_high_s: float = 1e-6, rw: bool = False) -> None:
        d4, d5, d6, d7 = (bool(value >> bit & 1) for bit in range(4))
        self.lcd.pins(rs, False, d4, d5, d6, d7, rw)
        self.lcd.pins(rs, True, d4, d5, d6, d7, rw)
        self.now_s += e_high_s
        self.lcd.pins(rs, False, d4, d5, d6, d7, rw)
        self.now_s += self.pause_s

    def byte(self, value: int, rs: bool = False) -> None:
        self.nibble(value >> 4, rs)
        self.nibble(value & 0x0F, rs)

    def command(self, value: int) -> None:
        self.byte(value)
        if value <= 0x03:
            self.now_s += 2e-3

    def write(self, text: str | bytes) -> None:
        for value in text.encode("ascii") if isinstance(text, str) else text:
            self.byte(value, rs=True)

    def wake(self) -> None:
        """Figure 24, "4-Bit Interface": initializing by instruction."""
        for value, wait_s in ((0x3, 4.2e-3), (0x3, 110e-6), (0x3, 50e-6), (0x2, 50e-6)):
            self.nibble(value)
            self.now_s += wait_s

    def initialise(self) -> None:
        self.now_s += 15.1e-3
        self.wake()
        for instruction in (0x28, 0x08, 0x01, 0x06, 0x0C):
            self.command(instruction)


@pytest.fixture
def bench() -> Bench:
    bench = Bench()
    bench.initialise()
    return bench


# --- Initializing by instruction, figure 24


def test_the_prescribed_sequence_works(bench: Bench) -> None:
    bench.write("AZ 235")
    assert (bench.lcd.text()[0], bench.lcd.violations) == ("AZ 235          ", 0)


@pytest.mark.parametrize(
    ("power_s", "first_s", "second_s", "lost"),
    [(14e-3, 4.2e-3, 110e-6, 2), (16e-3, 4.0e-3, 4.2e-3, 1), (16e-3, 4.2e-3, 90e-6, 1)],
    ids=["15 ms after power", "4.1 ms after the first", "100 us after the second"],
)
def test_haste_while_initialising_is_punished(power_s: float, first_s: float, second_s: float, lost: int) -> None:
    bench = Bench(pause_s=0.0)
    bench.now_s += power_s
    for wait_s in (first_s, second_s, 50e-6):
        bench.nibble(0x3)
        bench.now_s += wait_s
    assert bench.lcd.violations == lost  # a first one that is lost makes the second the first


# --- Table 6, instructions


@pytest.mark.parametrize(
    ("instructions", "expected"),
    [
        ([0x04, 0x01], "!"),  # clear: spaces, and address 0
        ([0x02], "!bc"),  # return home
        ([0x80 | 0x01], "a!c"),  # set DDRAM address
        ([0x10], "ab!"),  # cursor left
        ([0x14], "abc !"),  # cursor right
        ([0x18], "bc!"),  # display shift left
        ([0x1C], " abc!"),  # display shift right
        ([0x1C, 0x02], "!bc"),  # return home takes the shift back
        ([0x05], " abc!"),  # entry mode: down, with shift (right)
        ([0x08], ""),  # display off
        ([0x08, 0x0C], "abc!"),  # and on: nothing was lost
    ],
)
def test_instruction(bench: Bench, instructions: list[int], expected: str) -> None:
    bench.write("abc")
    for instruction in instructions:
        bench.command(instruction)
    bench.write("!")
    assert bench.lcd.text()[0].rstrip() == expected


# --- Execution times at 270 kHz, table 6; bus timing, table 9


@pytest.mark.parametrize(
    ("first", "rs", "busy_s"),
    [(0x06, False, 37e-6), (0x41, True, 41e-6), (0x01, False, 1.52e-3), (0x02, False, 1.52e-3)],
    ids=["instruction", "data", "clear", "home"],
)
def test_what_comes_while_busy_is_lost(bench: Bench, first: int, rs: bool, busy_s: float) -> None:
    bench.pause_s = 0.0
    bench.byte(first, rs)
    bench.now_s += busy_s - 3e-6  # E goes high for 1 us before the first nibble is taken
    bench.byte(0xC0)
    assert bench.lcd.violations == 1
    bench.now_s += busy_s
    bench.write("!")
    assert bench.lcd.text()[1] == " " * 16  # the address was never set
    bench.now_s += 41e-6
    bench.byte(0xC0)
    assert bench.lcd.violations == 1
