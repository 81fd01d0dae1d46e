"""Finding the header's chip and taking its lines, on simulated gpiod chips.

Chips as Raspberry Pis really list them: their numbers changed with kernels, their labels did not.
"""

from __future__ import annotations

import errno
import os
import sys
from types import ModuleType
from typing import NoReturn

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs, find_chip, holders, real_gpiod
from hw.ports import HardwareError

PI_4 = {"/dev/gpiochip0": "pinctrl-bcm2711", "/dev/gpiochip1": "raspberrypi-exp-gpio"}
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23}


def simulated(chips: dict[str, str]) -> SimGpio:
    return SimGpio(SimClock(), chips)


def take(gpio: object, path: str = "/dev/gpiochip0", pins: dict[str, int] | None = None) -> GpioOutputs:
    return GpioOutputs(gpio, path, PINS if pins is None else pins, consumer="rotator-relays")


# --- the chip, by its label


def test_without_any_chip_it_says_so() -> None:
    with pytest.raises(HardwareError, match="found none at all"):
        find_chip(simulated({}), paths=[])


class Forbidden:
    """The gpiod package as a user outside the group gpio meets it."""

    def Chip(self, path: str) -> NoReturn:  # noqa: N802 - gpiod's own name
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)

    def request_lines(self, path: str, **_wanted: object) -> NoReturn:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)


def test_without_permission_it_names_the_group() -> None:
    with pytest.raises(HardwareError, match="no permission for /dev/gpiochip0: add the user to the group gpio"):
        find_chip(Forbidden(), paths=["/dev/gpiochip0"])


# --- looking without taking


def test_the_holders_of_lines_are_named_and_free_lines_left_out() -> None:
    gpio = simulated(PI_4)
    lines = take(gpio)
    assert holders(gpio, "/dev/gpiochip0", [22, 24]) == {22: "rotator-relays"}
    lines.close()
    assert holders(gpio, "/dev/gpiochip0", [22, 24]) == {}


@pytest.mark.parametrize(
    ("gpio", "path", "offsets", "words"),
    [
        (simulated(PI_4), "/dev/gpiochip7", [22], "/dev/gpiochip7: No such file"),
        (simulated(PI_4), "/dev/gpiochip0", [99], "/dev/gpiochip0: line offset"),
        (Forbidden(), "/dev/gpiochip0", [22], "add the user to the group gpio"),
    ],
    ids=["no-chip", "no-line", "not-yours"],
)
def test_holders_that_cannot_be_read_are_an_error(gpio: object, path: str, offsets: list[int], words: str) -> None:
    with pytest.raises(HardwareError, match=words):
        holders(gpio, path, offsets)


# --- the package itself


def test_without_the_package_it_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gpiod", None)
    with pytest.raises(HardwareError, match="the Python package gpiod cannot be loaded"):
        real_gpiod()


def test_its_namesake_of_version_1_is_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    # pip on 32-bit ARM takes an unrelated gpiod 1.5 for it
    monkeypatch.setitem(sys.modules, "gpiod", ModuleType("gpiod"))
    with pytest.raises(HardwareError, match=r"gpiod 1\.x.*install gpiod 2\.1"):
        real_gpiod()
