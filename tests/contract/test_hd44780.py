"""The display's driver by both ways to its pins: what counts is the text on the glass."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest

from hw.buses.gpio import GpioOutputs
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS, BackpackPort, GpioPort, Hd44780, NibblePort
from hw.ports import HardwareError
from tests.contract.bench import Bench

ROWS = ("SAT A:235 E:025 ", "ANT A:231 E:024 ")


@pytest.fixture(params=["backpack", "lines"])
def way(request: pytest.FixtureRequest) -> str:
    name: str = request.param
    return name


@pytest.fixture
def port(bench: Bench, way: str) -> Iterator[NibblePort]:
    if way == "backpack":
        yield backpack(bench)
        return
    lines = GpioOutputs(bench.api, bench.chip, bench.lcd_pins, consumer="rotator-lcd")
    yield GpioPort(lines, time.sleep)
    lines.close()


def backpack(bench: Bench) -> BackpackPort:
    active_low = bench.backpack in BACKLIGHT_ACTIVE_LOW
    return BackpackPort(bench.bus, bench.lcd_address, BACKPACKS[bench.backpack], backlight_active_low=active_low)


@pytest.fixture
def display(port: NibblePort) -> Hd44780:
    return Hd44780(port, time.sleep)


def test_it_reads_what_it_was_told(bench: Bench, way: str, display: Hd44780) -> None:
    display.reset()
    display.show(ROWS)
    assert bench.read_glass(way, ROWS) == ROWS


def test_new_rows_replace_the_old_ones(bench: Bench, way: str, display: Hd44780) -> None:
    display.reset()
    for number in range(5):
        rows = (f"SAT A:{number:03d} E:000 ", f"ANT A:000 E:{number:03d} ")
        display.show(rows)
        assert bench.read_glass(way, rows) == rows


def test_half_a_byte_behind_a_reset_brings_it_back(bench: Bench, way: str, display: Hd44780, port: NibblePort) -> None:
    display.reset()
    display.show(("before", ""))
    port.send(True, [0x5])  # a spark on E: every byte from here on is shifted by half
    display.reset()
    display.show(ROWS)
    assert bench.read_glass(way, ROWS) == ROWS


def test_a_backpack_that_goes_and_comes_back(bench: Bench) -> None:
    display = Hd44780(backpack(bench), time.sleep)
    display.reset()
    bench.unplug(bench.lcd_address)
    with pytest.raises(HardwareError, match=f"does not answer.*0x{bench.lcd_address:02x}"):
        display.show(ROWS)
    bench.replug(bench.lcd_address)
    display.reset()
    display.show(ROWS)
    assert bench.read_glass("backpack", ROWS) == ROWS
