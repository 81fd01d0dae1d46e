"""The HD44780 driver on a simulated display: six GPIO lines, and every way a backpack is wired.

What counts is the text on the glass, and that nothing was sent to the controller (Hitachi ADE-207-272) while it was
busy.
"""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.hd44780 import Hd44780 as Glass
from firmware_sim.chips.pcf8574 import Backpack
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.buses.i2c import SmbusI2C
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS, BackpackPort, GpioPort, Hd44780, NibblePort

ADDRESS = 0x27
ROWS = ("SAT A:235 E:025 ", "SIM A:231 E:024 ")
PINS = {"rs": 17, "e": 27, "d4": 5, "d5": 6, "d6": 12, "d7": 13}
# Which bit of the PCF8574 is RS, RW, E, D4 to D7 and the light, and which level lights it, as the boards are sold
BOARDS = {
    "ywrobot": ((0, 1, 2, 4, 5, 6, 7, 3), True),
    "lcm1602": ((0, 1, 2, 4, 5, 6, 7, 3), False),
    "mjkdz": ((6, 5, 4, 0, 1, 2, 3, 7), False),
    "lcdxio": ((4, 5, 6, 0, 1, 2, 3, 7), False),
    "swapped": ((2, 1, 0, 4, 5, 6, 7, 3), True),
}


class Bench:
    clock: SimClock
    glass: Glass
    port: NibblePort
    display: Hd44780


class SixLines(Bench):
    def __init__(self) -> None:
        self.clock = SimClock()
        gpio = SimGpio(self.clock)
        self.glass = Glass(self.clock)
        levels = {pin: gpio.level(pin) for pin in PINS.values()}

        def wires(_now_s: float, changes: Mapping[int, bool]) -> None:
            levels.update(changes)
            self.glass.pins(**{name: levels[pin] for name, pin in PINS.items()})

        gpio.on_edges.append(wires)
        lines = GpioOutputs(gpio, "/dev/gpiochip0", PINS, consumer="test")
        self.port = GpioPort(lines, self.clock.sleep)
        self.display = Hd44780(self.port, self.clock.sleep)


class OnBackpack(Bench):
    def __init__(self, board: str = "ywrobot") -> None:
        self.clock = SimClock()
        self.wire = SimI2CBus(self.clock.sleep)
        self.glass = Glass(self.wire.wire_time(self.clock))
        bits, lit_when_high = BOARDS[board]
        pins = dict(zip(("rs", "rw", "e", "d4", "d5", "d6", "d7", "bl"), bits, strict=True))
        self.backpack = Backpack(self.glass, pins, lit_when_high)
        self.wire.attach(ADDRESS, self.backpack.expander)
        active_low = board in BACKLIGHT_ACTIVE_LOW
        bus = SmbusI2C(self.wire, "bus 1")
        self.port = BackpackPort(bus, ADDRESS, BACKPACKS[board], backlight_active_low=active_low)
        self.display = Hd44780(self.port, self.clock.sleep)


@pytest.fixture(params=["six lines", *BOARDS])
def bench(request: pytest.FixtureRequest) -> Bench:
    return SixLines() if request.param == "six lines" else OnBackpack(request.param)


def test_a_reset_shows_nothing_and_is_on(bench: Bench) -> None:
    bench.display.reset()
    assert bench.glass.text() == (" " * 16, " " * 16)
    assert bench.glass.display_on


def test_signs_outside_ascii_come_from_rom_a00(bench: Bench) -> None:
    bench.display.reset()
    bench.display.show(("235° → ←", "a\\b ~ é"))
    assert bench.glass.text() == ("235° → ←        ", "a?b ? ?         ")


# --- backpacks


def test_a_display_plugged_in_again_is_brought_up_from_power_on() -> None:
    bench = OnBackpack()
    bench.display.reset()
    bench.display.show(ROWS)
    bench.wire.detach(ADDRESS)
    glass = Glass(bench.wire.wire_time(bench.clock))
    bench.wire.attach(ADDRESS, Backpack(glass, BACKPACKS["ywrobot"]).expander)
    bench.display.reset()
    bench.display.show(ROWS)
    assert glass.text() == ROWS
    assert glass.violations == 0
