"""GPIO lines as libgpiod 2.x, the kernel's documentation and the BCM2835 manual describe them.

Uses the real `gpiod.LineSettings` and its enums; time is a number in a list.
"""

from __future__ import annotations

import errno
import threading
from collections.abc import Mapping
from datetime import timedelta
from itertools import pairwise

import pytest
from gpiod import LineSettings
from gpiod.line import Bias, Clock, Direction, Drive, Value

from firmware_sim.buses.gpio import Edge, RequestReleasedError, SimGpio

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


# --- finding the chip


@pytest.mark.parametrize(
    "chips",
    [
        {"/dev/gpiochip0": "pinctrl-bcm2711", "/dev/gpiochip1": "raspberrypi-exp-gpio"},  # Pi 4
        {"/dev/gpiochip10": "gpio-brcmstb@107d508500", "/dev/gpiochip11": "pinctrl-rp1"},  # Pi 5, kernel 6.12.96
    ],
    ids=["Pi 4", "Pi 5"],
)
def test_the_header_is_found_by_its_label(time: FakeTime, chips: Mapping[str, str]) -> None:
    gpio = SimGpio(time.clock, chips)
    assert gpio.paths() == list(chips)
    labels = {}
    for path in gpio.paths():
        with gpio.Chip(path) as chip:
            labels[path] = chip.get_info().label
    assert labels == chips
    header = next(path for path, label in chips.items() if label.startswith("pinctrl"))
    gpio.request_lines(header, {17: OUTPUT_ON})
    assert gpio.level(17)


def test_chip_info(gpio: SimGpio) -> None:
    info = gpio.Chip(HEADER).get_info()
    assert (info.name, info.label, info.num_lines) == ("gpiochip0", "pinctrl-bcm2711", 58)


def test_an_unknown_path(gpio: SimGpio) -> None:
    assert gpio.is_gpiochip_device(HEADER)
    assert not gpio.is_gpiochip_device("/dev/gpiochip4")
    with pytest.raises(FileNotFoundError, match="No such file"):
        gpio.Chip("/dev/gpiochip4")
    with pytest.raises(FileNotFoundError, match="No such file"):
        gpio.request_lines("/dev/gpiochip4", {17: OUTPUT})


def test_a_machine_without_chips(time: FakeTime) -> None:
    assert SimGpio(time.clock, {}).paths() == []


def test_line_info(gpio: SimGpio) -> None:
    chip = gpio.Chip(HEADER)
    assert not chip.get_line_info(17).used
    gpio.request_lines(HEADER, {17: OUTPUT}, consumer="rotator")
    info = chip.get_line_info(17)
    assert (info.offset, info.used, info.consumer, info.name) == (17, True, "rotator", "GPIO17")


# --- levels before, during and after a request


def test_pulls_at_boot(gpio: SimGpio) -> None:
    # BCM2835 ARM Peripherals, table 6-31: GPIO 0-8 pulled up, 9-27 down
    assert [gpio.level(offset) for offset in range(28)] == [True] * 9 + [False] * 19


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


def test_output_values_speak_for_all_lines_of_the_request(gpio: SimGpio) -> None:
    # libgpiod 2.x, Chip.request_lines: a line that the mapping leaves out becomes INACTIVE
    gpio.request_lines(HEADER, {(12, 13): OUTPUT_ON}, output_values={12: Value.ACTIVE})
    assert (gpio.level(12), gpio.level(13)) == (True, False)


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


def test_the_oldest_edges_are_forgotten(gpio: SimGpio) -> None:
    request = gpio.request_lines(HEADER, {12: OUTPUT})
    for _ in range(5_001):
        request.set_value(12, Value.ACTIVE)
        request.set_value(12, Value.INACTIVE)
    assert len(gpio.edges) == 2_000


def test_edges_of_two_threads_come_in_the_order_of_the_levels(gpio: SimGpio) -> None:
    heard: list[bool] = []
    request = gpio.request_lines(HEADER, {12: OUTPUT})
    gpio.on_edges.append(lambda at_s, levels: heard.append(levels[12]))

    def toggle() -> None:
        for _ in range(500):
            request.set_value(12, Value.ACTIVE)
            request.set_value(12, Value.INACTIVE)

    threads = [threading.Thread(target=toggle) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(before != after for before, after in pairwise(heard))


# --- refusals


def test_a_busy_line_refuses_the_whole_request(gpio: SimGpio) -> None:
    gpio.request_lines(HEADER, {12: OUTPUT})
    with pytest.raises(OSError, match="Device or resource busy") as error:
        gpio.request_lines(HEADER, {13: OUTPUT_ON, 12: OUTPUT_ON})
    assert error.value.errno == errno.EBUSY
    assert (gpio.level(13), gpio.Chip(HEADER).get_line_info(13).used) == (False, False)


def test_a_released_request_is_dead(gpio: SimGpio) -> None:
    request = gpio.request_lines(HEADER, {12: OUTPUT})
    request.release()
    request.release()
    with pytest.raises(RequestReleasedError):
        request.set_value(12, Value.ACTIVE)
    with pytest.raises(RequestReleasedError):
        request.get_values()


@pytest.mark.parametrize(
    ("config", "fault"),
    [
        ({58: OUTPUT}, ValueError),
        ({(12, 13): OUTPUT, 12: INPUT}, ValueError),
        ({12: LineSettings(drive=Drive.OPEN_DRAIN)}, NotImplementedError),
        ({12: LineSettings(event_clock=Clock.REALTIME)}, NotImplementedError),
        ({12: LineSettings(direction=Direction.OUTPUT, debounce_period=timedelta(seconds=0.02))}, OSError),
    ],
    ids=["out of range", "twice", "open drain", "another clock", "a debounced output"],
)
def test_a_request_that_cannot_be(gpio: SimGpio, config: object, fault: type[Exception]) -> None:
    with pytest.raises(fault):
        gpio.request_lines(HEADER, config)  # type: ignore[arg-type]


def test_a_line_of_another_request_cannot_be_set(gpio: SimGpio) -> None:
    with pytest.raises(ValueError, match="Invalid argument"):
        gpio.request_lines(HEADER, {12: OUTPUT}).set_value(13, Value.ACTIVE)


def test_an_input_cannot_be_set(gpio: SimGpio) -> None:
    # Linux, gpio-v2-line-set-values-ioctl: EPERM
    with pytest.raises(PermissionError):
        gpio.request_lines(HEADER, {22: INPUT}).set_value(22, Value.ACTIVE)
