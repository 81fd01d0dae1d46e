"""Edge events as Linux makes them (gpiolib-cdev.c) and as gpiod 2.5 on the kernel's own gpio-sim was seen to give them.

Uses the real `gpiod.LineSettings` and its enums; time is a number.
"""

from __future__ import annotations

from datetime import timedelta

import pytest
from gpiod import LineSettings
from gpiod.line import Bias, Direction, Edge, Value

from firmware_sim.buses.gpio import SimGpio, SimLineRequest
from firmware_sim.clock import SimClock

HEADER = "/dev/gpiochip0"
BOTH = LineSettings(direction=Direction.INPUT, edge_detection=Edge.BOTH)
DEBOUNCED = LineSettings(
    direction=Direction.INPUT, edge_detection=Edge.BOTH, debounce_period=timedelta(milliseconds=20)
)


@pytest.fixture
def clock() -> SimClock:
    return SimClock(1000.0)


@pytest.fixture
def gpio(clock: SimClock) -> SimGpio:
    return SimGpio(clock)


def toggle(gpio: SimGpio, clock: SimClock, count: int, every_s: float = 0.001, pin: int = 17) -> None:
    for _ in range(count):
        clock.sleep(every_s)
        gpio.drive_input(pin, not gpio.level(pin))


def told(request: SimLineRequest) -> list[tuple[str, float]]:
    """What is waiting: which edge, and its moment in seconds after the start."""
    events = []
    while request.wait_edge_events(0):
        for event in request.read_edge_events():
            events.append((event.event_type.name, round(event.timestamp_ns * 1e-9 - 1000.0, 6)))
    return events


# --- events


def test_every_edge_in_order_with_its_moment(gpio: SimGpio, clock: SimClock) -> None:
    request = gpio.request_lines(HEADER, {17: BOTH})
    toggle(gpio, clock, 3)
    assert told(request) == [("RISING_EDGE", 0.001), ("FALLING_EDGE", 0.002), ("RISING_EDGE", 0.003)]
    assert not request.wait_edge_events(0)


def test_edges_are_those_of_the_logical_value(gpio: SimGpio, clock: SimClock) -> None:
    request = gpio.request_lines(HEADER, {17: LineSettings(edge_detection=Edge.BOTH, active_low=True)})
    toggle(gpio, clock, 1)  # the pin rises
    assert told(request) == [("FALLING_EDGE", 0.001)]


# --- the buffer


@pytest.mark.parametrize(
    ("lines", "size", "kept"),
    [((17, 27), None, 32), ((17, 27), 256, 100), ((17,), None, 16), ((17,), 33, 64), ((17,), 5000, 100)],
    ids=["as seen: 16 a line", "as seen: 256", "one line", "a power of two", "no more than 1024"],
)
def test_a_burst_of_a_hundred_unread_edges(
    gpio: SimGpio, clock: SimClock, lines: tuple[int, ...], size: int | None, kept: int
) -> None:
    request = gpio.request_lines(HEADER, {lines: BOTH}, event_buffer_size=size)
    toggle(gpio, clock, 100)
    seqnos = []
    while request.wait_edge_events(0):
        seqnos += [event.line_seqno for event in request.read_edge_events()]
    assert seqnos == list(range(101 - kept, 101))  # the oldest are gone


# --- debouncing


def test_eleven_fast_edges_are_one_event_20_ms_after_the_last(gpio: SimGpio, clock: SimClock) -> None:
    request = gpio.request_lines(HEADER, {17: DEBOUNCED})
    toggle(gpio, clock, 11)
    assert told(request) == []
    assert request.get_value(17) is Value.INACTIVE
    clock.sleep(0.1)
    assert request.get_value(17) is Value.ACTIVE
    assert told(request) == [("RISING_EDGE", 0.031)]


def test_a_spark_shorter_than_the_debounce_leaves_no_trace(gpio: SimGpio, clock: SimClock) -> None:
    request = gpio.request_lines(HEADER, {17: DEBOUNCED})
    toggle(gpio, clock, 2, every_s=0.019)
    clock.sleep(0.1)
    assert told(request) == []
    toggle(gpio, clock, 1)
    clock.sleep(0.021)
    assert [event.line_seqno for event in request.read_edge_events()] == [1]


# --- bias


@pytest.mark.parametrize(("bias", "level"), [(Bias.PULL_UP, True), (Bias.PULL_DOWN, False), (Bias.AS_IS, False)])
def test_an_open_contact_rests_where_the_bias_pulls_it(gpio: SimGpio, bias: Bias, level: bool) -> None:
    gpio.request_lines(HEADER, {17: LineSettings(edge_detection=Edge.BOTH, bias=bias)})
    assert gpio.level(17) is level
    gpio.drive_input(17, not level)
    assert gpio.level(17) is not level


# --- waiting


def test_hardware_that_moves_by_itself_reports_when_it_is_read(gpio: SimGpio, clock: SimClock) -> None:
    pending = [(1000.25, True), (1000.75, False)]

    def catch_up(now_s: float) -> None:
        while pending and pending[0][0] <= now_s:
            at_s, level = pending.pop(0)
            gpio.drive_input(17, level, at_s)

    gpio.on_look.append(catch_up)
    request = gpio.request_lines(HEADER, {17: DEBOUNCED})
    clock.sleep(0.5)
    assert request.get_value(17) is Value.ACTIVE
    clock.sleep(0.5)
    assert not gpio.level(17)
    assert told(request) == [("RISING_EDGE", 0.27), ("FALLING_EDGE", 0.77)]
