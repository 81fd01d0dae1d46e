"""A contact on an input line: the real driver on simulated gpiod lines."""

from __future__ import annotations

import errno
import os
from typing import NoReturn

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioContact
from hw.ports import HardwareError

PATH = "/dev/gpiochip0"
PIN = 17


@pytest.fixture
def clock() -> SimClock:
    return SimClock(1000.0)


@pytest.fixture
def gpio(clock: SimClock) -> SimGpio:
    return SimGpio(clock)


def switch(gpio: SimGpio, clock: SimClock, *levels: bool, every_s: float = 0.1) -> None:
    for level in levels:
        gpio.drive_input(PIN, level)
        clock.sleep(every_s)


def test_what_was_dropped_is_counted(gpio: SimGpio, clock: SimClock) -> None:
    contact = GpioContact(gpio, PATH, PIN, consumer="test")
    switch(gpio, clock, *[False, True] * 600, every_s=0.021)
    clock.sleep(0.1)
    changes = contact.changes()
    assert (len(changes), changes[0].lost) == (1024, 1200 - 1024)
    assert {change.lost for change in changes[1:]} == {0}


class Unplugged:
    """The gpiod package on a chip that goes away (a USB GPIO board): Linux answers ENODEV."""

    def request_lines(self, path: str, **_wanted: object) -> Unplugged:
        return self

    def get_value(self, offset: int) -> NoReturn:
        raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))

    def wait_edge_events(self, timeout: float) -> NoReturn:
        raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))


def test_a_chip_that_goes_away_is_a_sentence() -> None:
    contact = GpioContact(Unplugged(), PATH, PIN, consumer="test")
    with pytest.raises(HardwareError, match="GPIO: cannot read GPIO17: No such device"):
        contact.closed()
    with pytest.raises(HardwareError, match="GPIO: cannot read GPIO17: No such device"):
        contact.changes()
