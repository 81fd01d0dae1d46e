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


def test_after_power_up_the_glass_is_dark() -> None:
    assert Bench().lcd.text() == (" " * 16, " " * 16)


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


@pytest.mark.parametrize("left_over", [0, 1], ids=["in step", "half a byte behind"])
def test_the_sequence_brings_it_back_from_any_phase(bench: Bench, left_over: int) -> None:
    for _ in range(left_over):
        bench.nibble(0x8)
    bench.wake()
    for instruction in (0x28, 0x01, 0x06, 0x0C):
        bench.command(instruction)
    bench.write("OK")
    assert (bench.lcd.text()[0][:2], bench.lcd.violations) == ("OK", 0)


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


def test_entry_mode_with_shift_holds_the_cursor_still(bench: Bench) -> None:
    bench.command(0x80 | 0x10)
    bench.command(0x07)
    bench.write("abc")
    assert bench.lcd.text()[0] == " " * 13 + "abc"


def test_entry_mode_down_writes_backwards_until_a_clear(bench: Bench) -> None:
    bench.command(0x80 | 0x02)
    bench.command(0x04)
    bench.write("cba")
    assert bench.lcd.text()[0][:3] == "abc"
    bench.command(0x01)
    bench.write("abc")
    assert bench.lcd.text()[0][:3] == "abc"


def test_function_set_of_one_line_leaves_the_second_row_blank(bench: Bench) -> None:
    bench.command(0x80 | 0x40)
    bench.write("below")
    bench.command(0x20)
    assert bench.lcd.text()[1] == " " * 16


# --- Display Data RAM, figures 2 to 4


@pytest.mark.parametrize(
    ("start", "step", "then"), [(0x27, 0x06, 0x40), (0x67, 0x06, 0x00), (0x40, 0x04, 0x27), (0x00, 0x04, 0x67)]
)
def test_two_lines_of_forty_wrap_into_each_other(bench: Bench, start: int, step: int, then: int) -> None:
    bench.command(step)
    bench.command(0x80 | start)
    bench.write("12")
    for _ in range(16 if then & 0x3F else 0):  # bring the far end into sight
        bench.command(0x1C)
    shown = bench.lcd.text()[then >> 6]
    assert shown[15 if then & 0x3F else 0] == "2"


@pytest.mark.parametrize(("row", "address"), [(0, 0x00), (1, 0x40), (2, 0x14), (3, 0x54)])
def test_rows_of_a_20x4_glass(row: int, address: int) -> None:
    bench = Bench(columns=20, rows=4)
    bench.initialise()
    bench.command(0x80 | address)
    bench.write("row of twenty chars!")
    assert bench.lcd.text()[row] == "row of twenty chars!"


# --- Character generator, table 4 (ROM code A00) and table 5 (CGRAM)


@pytest.mark.parametrize(
    ("code", "seen"), [(0x41, "A"), (0x5C, "¥"), (0x7D, "}"), (0x7E, "→"), (0x7F, "←"), (0xDF, "°"), (0xFF, "█")]
)
def test_rom_character(bench: Bench, code: int, seen: str) -> None:
    bench.write(bytes([code]))
    assert bench.lcd.text()[0][0] == seen


def test_a_glyph_of_ones_own(bench: Bench) -> None:
    rows = (0x04, 0x0E, 0x15, 0x04, 0x04, 0x04, 0x04, 0x00)
    bench.command(0x40 | 3 << 3)
    bench.write(bytes(rows))
    bench.command(0x80)
    bench.write(bytes([3, 0x0B]))  # codes 8 to 15 are 0 to 7 again
    assert (bench.lcd.glyph(3), bench.lcd.text()[0][:2]) == (rows, "③③")


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


@pytest.mark.parametrize(("high_s", "short"), [(449e-9, 1), (460e-9, 0), (0.0, 0)])
def test_e_is_high_for_450_ns(bench: Bench, high_s: float, short: int) -> None:
    bench.nibble(0x8, e_high_s=high_s)
    assert (bench.lcd.short_pulses, bench.lcd.violations) == (short, short)


def test_what_stood_on_the_pins_before_e_fell_is_taken(bench: Bench) -> None:
    for value in (0x4, 0x1):
        bench.lcd.pins(True, True, *(bool(value >> bit & 1) for bit in range(4)))
        bench.lcd.pins(False, False, False, False, False, False)
    assert bench.lcd.text()[0][0] == "A"


def test_a_read_cycle_writes_nothing(bench: Bench) -> None:
    bench.nibble(0x4, rs=True, rw=True)
    bench.write("A")
    assert bench.lcd.text()[0].rstrip() == "A"
