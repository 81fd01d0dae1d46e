"""The LCD library at its pins: what it sends, in nibbles, and that a display understands it."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from firmware_sim.arduino.liquid_crystal import LcdPins, LiquidCrystal
from firmware_sim.arduino.uno import Uno
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.clock import SimClock

PINS = LcdPins(rs=7, enable=8, data=(9, 10, 11, 12))


@dataclass(frozen=True, slots=True)
class Nibble:
    now_s: float
    rs: bool
    value: int


class Bench:
    """A board with a display on it and a probe that notes a nibble at each falling edge of E."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.board = Uno(self.clock, self.clock.sleep)
        self.display = Hd44780(self.clock)
        self.nibbles: list[Nibble] = []
        self.board.on_pin.append(self._probe)
        self.lcd = LiquidCrystal(self.board, PINS)

    def _probe(self, now_s: float, pin: int, level: bool) -> None:
        rs, enable, d4, d5, d6, d7 = (self.board.level(wire) for wire in (PINS.rs, PINS.enable, *PINS.data))
        self.display.pins(rs, enable, d4, d5, d6, d7)
        if pin == PINS.enable and not level:
            self.nibbles.append(Nibble(now_s, rs, d4 | d5 << 1 | d6 << 2 | d7 << 3))

    def values(self) -> list[int]:
        return [nibble.value for nibble in self.nibbles]


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_wakes_the_display_as_its_datasheet_asks(bench: Bench) -> None:
    bench.lcd.begin()

    assert bench.values() == [3, 3, 3, 2, 2, 8, 0, 0xC, 0, 1, 0, 6]
    assert not any(nibble.rs for nibble in bench.nibbles)
    first, second, third, fourth = (nibble.now_s for nibble in bench.nibbles[:4])
    assert first > 40e-3
    assert second - first > 4.1e-3
    assert third - second > 100e-6
    assert fourth - third > 100e-6
    cleared, entry = bench.nibbles[9].now_s, bench.nibbles[10].now_s
    assert entry - cleared > 1.52e-3


def test_text_goes_out_high_nibble_first_with_rs_high(bench: Bench) -> None:
    bench.lcd.begin()
    bench.nibbles.clear()

    bench.lcd.print("SA")

    assert bench.values() == [5, 3, 4, 1]
    assert all(nibble.rs for nibble in bench.nibbles)


@pytest.mark.parametrize(("column", "row", "address"), [(0, 0, 0x80), (5, 0, 0x85), (0, 1, 0xC0), (15, 1, 0xCF)])
def test_cursor(bench: Bench, column: int, row: int, address: int) -> None:
    bench.lcd.begin()
    bench.nibbles.clear()

    bench.lcd.set_cursor(column, row)

    assert bench.values() == [address >> 4, address & 0xF]
    assert not any(nibble.rs for nibble in bench.nibbles)


def test_a_display_shows_it_and_is_never_driven_while_busy(bench: Bench) -> None:
    bench.lcd.begin()
    assert bench.display.text() == (" " * 16, " " * 16)

    bench.lcd.set_cursor(0, 0)
    bench.lcd.print("SAT A:235 E:025")
    bench.lcd.set_cursor(6, 1)
    bench.lcd.print("231")
    assert bench.display.text() == ("SAT A:235 E:025 ", "      231       ")

    bench.lcd.clear()
    bench.lcd.print("X")
    assert bench.display.text() == ("X" + " " * 15, " " * 16)
    assert bench.display.busy_violations == 0


def test_starts_again_from_any_state_of_the_display(bench: Bench) -> None:
    bench.lcd.begin()
    bench.board.digital_write(PINS.enable, True)  # half a byte, as a reset in mid-character leaves it
    bench.board.digital_write(PINS.enable, False)

    bench.lcd.begin()
    bench.lcd.print("OK")

    assert bench.display.text()[0] == "OK" + " " * 14


def test_a_character_takes_two_nibbles_of_102_us(bench: Bench) -> None:
    bench.lcd.begin()
    before_s = bench.clock()

    bench.lcd.print("A")

    assert bench.clock() - before_s == pytest.approx(204e-6)
