"""Switches to ground on the Pi's own resistors, and what limit switches forbid: real drivers on simulated lines."""

from __future__ import annotations

import errno
import os
from typing import NoReturn

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioInputs
from hw.ports import Axis, Direction, HardwareError
from hw.sensors.switches import LIMITS, LimitSwitches

PATH = "/dev/gpiochip0"
PINS = {"stop": 16, "calibrate": 20}
LIMIT_PINS = {"azimuth_low": 5, "azimuth_high": 6, "elevation_high": 13}
MINUS, PLUS = Direction.MINUS, Direction.PLUS
NO_WAY: frozenset[Direction] = frozenset()


@pytest.fixture
def gpio() -> SimGpio:
    return SimGpio(SimClock())


def close(gpio: SimGpio, *pins: int) -> None:
    for pin in pins:
        gpio.drive_input(pin, False)


def open_up(gpio: SimGpio, *pins: int) -> None:
    """Or break the wire: nothing drives the line any more."""
    for pin in pins:
        gpio.drive_input(pin, None)


def test_a_closed_switch_pulls_its_line_to_ground_and_an_open_one_leaves_it_to_the_pi(gpio: SimGpio) -> None:
    inputs = GpioInputs(gpio, PATH, PINS, consumer="test")
    assert gpio.level(16)
    assert inputs.read() == {"stop": False, "calibrate": False}
    close(gpio, 16)
    assert inputs.read() == {"stop": True, "calibrate": False}
    open_up(gpio, 16)
    assert inputs.read() == {"stop": False, "calibrate": False}


class Dead:
    """A chip whose driver has gone: every look at its lines fails."""

    def request_lines(self, _path: str, **_wanted: object) -> Dead:
        return self

    def get_values(self, _offsets: object) -> NoReturn:
        raise OSError(errno.ENODEV, os.strerror(errno.ENODEV))


def test_lines_that_cannot_be_read_are_named() -> None:
    with pytest.raises(HardwareError, match="cannot read stop, calibrate: No such device"):
        GpioInputs(Dead(), PATH, PINS, consumer="test").read()


# --- limit switches


@pytest.fixture
def limits(gpio: SimGpio) -> LimitSwitches:
    close(gpio, *LIMIT_PINS.values())
    return LimitSwitches(GpioInputs(gpio, PATH, LIMIT_PINS, consumer="limits"), LIMIT_PINS)


@pytest.mark.parametrize("name", LIMIT_PINS)
def test_an_open_one_or_a_broken_wire_blocks_its_way_alone(gpio: SimGpio, limits: LimitSwitches, name: str) -> None:
    open_up(gpio, LIMIT_PINS[name])
    axis, way = LIMITS[name]
    nothing = {Axis.AZIMUTH: NO_WAY, Axis.ELEVATION: NO_WAY}
    assert limits.blocked() == nothing | {axis: frozenset({way})}


def test_low_blocks_minus_and_high_blocks_plus(gpio: SimGpio, limits: LimitSwitches) -> None:
    open_up(gpio, *LIMIT_PINS.values())
    everything = {Axis.AZIMUTH: frozenset({MINUS, PLUS}), Axis.ELEVATION: frozenset({PLUS})}
    assert limits.blocked() == limits.guarded() == everything


def test_switches_that_cannot_be_read_are_no_permission() -> None:
    limits = LimitSwitches(GpioInputs(Dead(), PATH, LIMIT_PINS, consumer="limits"), LIMIT_PINS)
    with pytest.raises(HardwareError, match="cannot read azimuth_low"):
        limits.blocked()
    assert limits.guarded()[Axis.ELEVATION] == {PLUS}
