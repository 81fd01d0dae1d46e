"""The PCF8574 as its datasheet (NXP) describes it, and the backpacks it is sold on.

Writes real I2C messages through the simulated bus; time is a number in a list. Knows no driver: the bytes that make a
nibble are put together here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pytest
from smbus2 import i2c_msg

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.hd44780 import Hd44780
from firmware_sim.chips.pcf8574 import Backpack

ADDRESS = 0x27
YWROBOT = {"rs": 0, "rw": 1, "e": 2, "bl": 3, "d4": 4, "d5": 5, "d6": 6, "d7": 7}
MJKDZ = {"d4": 0, "d5": 1, "d6": 2, "d7": 3, "e": 4, "rw": 5, "rs": 6, "bl": 7}


class Bench:
    """A backpack on a bus, and the clock on the wall."""

    def __init__(self, pin_map: Mapping[str, int], byte_s: float = 90e-6, free: bool = False, **light: bool) -> None:
        self.now_s = 0.0
        self.pin_map = pin_map
        self.bus = SimI2CBus(None if free else self.sleep, byte_s)
        self.lcd = Hd44780(self.bus.wire_time(lambda: self.now_s))
        self.backpack = Backpack(self.lcd, pin_map, **light)
        self.bus.attach(ADDRESS, self.backpack.expander)

    def sleep(self, seconds: float) -> None:
        self.now_s += seconds

    def pulse(self, nibble: int, rs: bool) -> Iterator[int]:
        """Two bytes: the nibble with E high, the nibble with E low."""
        port = rs << self.pin_map["rs"] | sum((nibble >> bit & 1) << self.pin_map[f"d{bit + 4}"] for bit in range(4))
        yield port | 1 << self.pin_map["e"]
        yield port

    def send(self, *values: int, rs: bool = False) -> bytes:
        return bytes(port for value in values for half in (value >> 4, value & 15) for port in self.pulse(half, rs))

    def write(self, ports: bytes) -> None:
        self.bus.i2c_rdwr(i2c_msg.write(ADDRESS, ports))

    def initialise(self) -> None:
        self.sleep(0.05)
        for nibble in (3, 3, 3, 2):
            self.write(bytes(self.pulse(nibble, rs=False)))
            self.sleep(0.005)
        for instruction in (0x28, 0x08, 0x01):
            self.write(self.send(instruction))
        self.sleep(0.0016)
        for instruction in (0x06, 0x0C):
            self.write(self.send(instruction))

    def write_row(self, text: str) -> None:
        ports = self.send(0x80) + self.send(*text.encode("ascii"), rs=True)
        assert len(ports) == 68
        self.write(ports)


# --- the backpack


@pytest.mark.parametrize("pin_map", [YWROBOT, MJKDZ], ids=["YwRobot", "mjkdz"])
def test_a_row_in_one_write_at_100_khz(pin_map: Mapping[str, int]) -> None:
    bench = Bench(pin_map)
    bench.initialise()
    began_s = bench.now_s
    bench.write_row("ANT A:231 E:024 ")
    assert bench.now_s - began_s == pytest.approx(69 * 90e-6)  # 6.2 ms, address byte and all
    assert (bench.lcd.text()[0], bench.lcd.violations) == ("ANT A:231 E:024 ", 0)


@pytest.mark.parametrize(("byte_s", "in_time"), [(90e-6, True), (22.5e-6, True), (9e-6, False)])
def test_the_wire_itself_is_the_wait_up_to_400_khz(byte_s: float, in_time: bool) -> None:
    # The first nibble of a character comes two bytes after the last one of the character before: 41 us at least.
    bench = Bench(YWROBOT)
    bench.initialise()
    fast = SimI2CBus(bench.sleep, byte_s)
    lcd = Hd44780(fast.wire_time(lambda: bench.now_s))
    bench.bus, bench.lcd = fast, lcd
    fast.attach(ADDRESS, Backpack(lcd, YWROBOT).expander)
    bench.initialise()
    lcd.busy_violations = 0
    bench.write_row("ANT A:231 E:024 ")
    assert (lcd.violations == 0) == in_time


def test_a_clear_needs_a_wait_that_the_wire_does_not_give() -> None:
    bench = Bench(YWROBOT)
    bench.initialise()
    bench.write(bench.send(0x01) + bench.send(0x41, 0x42, rs=True))
    assert bench.lcd.violations == 2
