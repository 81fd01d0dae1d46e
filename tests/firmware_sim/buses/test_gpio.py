"""GPIO lines as libgpiod 2.x, the kernel's documentation and the BCM2835 manual describe them.

Uses the real `gpiod.LineSettings` and its enums; time is a number in a list.
"""

from __future__ import annotations

import errno

import pytest
from gpiod import LineSettings
from gpiod.line import Bias, Direction, Value

from firmware_sim.buses.gpio import Edge, SimGpio

HEADER = "/dev/gpiochip0"
OUTPUT = LineSettings(direction=Direction.OUTPUT)
OUTPUT_ON = LineSettings(direction=Direction.OUTPUT, output_value=Value.ACTIVE)
ACTIVE_LOW = LineSettings(direction=Direction.OUTPUT, active_low=True)
INPUT = LineSettings(direction=Direction.INPUT)


class FakeTime:
    def __init__(self) -> None:
        self.now_s = 0.0

    def clock(self) -> float:
        return self.now_s


@pytest.fixture
def time() -> FakeTime:
    return FakeTime()


@pytest.fixture
def gpio(time: FakeTime) -> SimGpio:
    return SimGpio(time.clock)


# --- levels before, during and after a request


@pytest.mark.parametrize(
    ("active_low", "value", "level"),
    [
        (False, Value.ACTIVE, True),
        (False, Value.INACTIVE, False),
        (True, Value.ACTIVE, False),
        (True, Value.INACTIVE, True),
    ],
)
def test_the_physical_level_is_the_value_or_its_opposite(
    gpio: SimGpio, active_low: bool, value: Value, level: bool
) -> None:
    settings = LineSettings(direction=Direction.OUTPUT, active_low=active_low, output_value=value)
    request = gpio.request_lines(HEADER, {12: settings})
    assert gpio.level(12) == level
    assert request.get_value(12) is value


@pytest.mark.parametrize("offset", [5, 12], ids=["pulled up", "pulled down"])
def test_an_output_starts_at_its_value_without_a_glitch(gpio: SimGpio, offset: int) -> None:
    resting = gpio.level(offset)
    settings = LineSettings(direction=Direction.OUTPUT, output_value=Value(int(resting)))
    gpio.request_lines(HEADER, {offset: settings})
    assert not gpio.edges


def test_an_input_reads_what_is_on_the_pin(gpio: SimGpio) -> None:
    request = gpio.request_lines(
        HEADER, {22: INPUT, 23: LineSettings(direction=Direction.INPUT, bias=Bias.PULL_UP, active_low=True)}
    )
    assert request.get_values() == [Value.INACTIVE, Value.INACTIVE]
    gpio.drive_input(22, True)
    gpio.drive_input(23, False)
    assert request.get_values([23, 22]) == [Value.ACTIVE, Value.ACTIVE]
    gpio.drive_input(22, None)
    assert request.get_value(22) is Value.INACTIVE


@pytest.mark.parametrize(("strict", "still_on"), [(False, True), (True, False)], ids=["Raspberry Pi", "mainline"])
def test_a_released_output(time: FakeTime, strict: bool, still_on: bool) -> None:
    # raspberrypi/linux, dtparam=strict_gpiod: without it the pin stays as it was driven
    gpio = SimGpio(time.clock, strict=strict)
    with gpio.request_lines(HEADER, {12: OUTPUT_ON}):
        assert gpio.level(12)
    assert gpio.level(12) == still_on
    gpio.request_lines(HEADER, {12: OUTPUT})  # and free for the next
    assert not gpio.level(12)


# --- edges


def test_lines_set_together_change_in_one_instant(gpio: SimGpio, time: FakeTime) -> None:
    heard: list[tuple[float, dict[int, bool]]] = []
    request = gpio.request_lines(HEADER, {(12, 13): OUTPUT, 5: ACTIVE_LOW})
    gpio.on_edges.append(lambda at_s, levels: heard.append((at_s, dict(levels))))
    time.now_s = 1.5
    request.set_values({12: Value.ACTIVE, 5: Value.ACTIVE, 13: Value.INACTIVE})
    assert heard == [(1.5, {12: True, 5: False})]
    assert list(gpio.edges) == [Edge(1.5, 12, True), Edge(1.5, 5, False)]
    request.set_value(12, Value.ACTIVE)
    assert len(heard) == 1  # no change, no edge


# --- refusals


def test_a_busy_line_refuses_the_whole_request(gpio: SimGpio) -> None:
    gpio.request_lines(HEADER, {12: OUTPUT})
    with pytest.raises(OSError, match="Device or resource busy") as error:
        gpio.request_lines(HEADER, {13: OUTPUT_ON, 12: OUTPUT_ON})
    assert error.value.errno == errno.EBUSY
    assert (gpio.level(13), gpio.Chip(HEADER).get_line_info(13).used) == (False, False)
