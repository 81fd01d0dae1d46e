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
from hw.buses.gpio import GpioInputs, GpioOutputs, find_chip, holders, real_gpiod
from hw.ports import HardwareError

PI_3 = {"/dev/gpiochip0": "pinctrl-bcm2835", "/dev/gpiochip1": "raspberrypi-exp-gpio"}
PI_4 = {"/dev/gpiochip0": "pinctrl-bcm2711", "/dev/gpiochip1": "raspberrypi-exp-gpio"}
BRCMSTB = ("107d508500", "107d508520", "107d517c00", "107d517c20")
PI_5_AT_FIRST = {f"/dev/gpiochip{number}": f"gpio-brcmstb@{at}" for number, at in enumerate(BRCMSTB)} | {
    "/dev/gpiochip4": "pinctrl-rp1"
}
PI_5_KERNEL_6_6_47 = {f"/dev/gpiochip{number}": f"gpio-brcmstb@{at}" for number, at in enumerate(BRCMSTB, 10)} | {
    "/dev/gpiochip0": "pinctrl-rp1"
}
PI_5_KERNEL_6_12_96 = {f"/dev/gpiochip{number}": f"gpio-brcmstb@{at}" for number, at in enumerate(BRCMSTB, 11)} | {
    "/dev/gpiochip15": "pinctrl-rp1"
}
PC = {"/dev/gpiochip0": "INTC1055:00"}
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23}


def simulated(chips: dict[str, str]) -> SimGpio:
    return SimGpio(SimClock(), chips)


def take(gpio: object, path: str = "/dev/gpiochip0", pins: dict[str, int] | None = None) -> GpioOutputs:
    return GpioOutputs(gpio, path, PINS if pins is None else pins, consumer="rotator-relays")


# --- the chip, by its label


@pytest.mark.parametrize(
    ("chips", "path"),
    [
        (PI_3, "/dev/gpiochip0"),
        (PI_4, "/dev/gpiochip0"),
        (PI_5_AT_FIRST, "/dev/gpiochip4"),
        (PI_5_KERNEL_6_6_47, "/dev/gpiochip0"),
        (PI_5_KERNEL_6_12_96, "/dev/gpiochip15"),
    ],
    ids=["pi-3", "pi-4", "pi-5", "pi-5-renumbered", "pi-5-renumbered-again"],
)
def test_the_header_is_found_by_its_label_not_its_number(chips: dict[str, str], path: str) -> None:
    gpio = simulated(chips)
    assert find_chip(gpio, paths=gpio.paths()) == path


def test_the_whole_label_must_match() -> None:
    gpio = simulated({"/dev/gpiochip0": "not-pinctrl-rp1", "/dev/gpiochip1": "pinctrl-rp1-too"})
    seen = r"found /dev/gpiochip0 \(not-pinctrl-rp1\), /dev/gpiochip1 \(pinctrl-rp1-too\)"
    with pytest.raises(HardwareError, match=f"no chip labelled .*; {seen}"):
        find_chip(gpio, paths=gpio.paths())


def test_another_label_may_be_asked_for() -> None:
    gpio = simulated(PI_4)
    assert find_chip(gpio, "raspberrypi-exp-gpio", gpio.paths()) == "/dev/gpiochip1"


def test_a_chip_that_went_away_is_passed_over() -> None:
    gpio = simulated(PI_5_KERNEL_6_6_47)
    assert find_chip(gpio, paths=["/dev/gpiochip9", *gpio.paths()]) == "/dev/gpiochip0"


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


def test_without_permission_for_a_chip_named_in_the_file_it_names_the_group_too() -> None:
    with pytest.raises(HardwareError, match="add the user to the group gpio"):
        take(Forbidden())


# --- the lines


def test_named_lines_switch_in_one_instant() -> None:
    gpio = simulated(PI_4)
    instants: list[dict[int, bool]] = []
    gpio.on_edges.append(lambda _now_s, changes: instants.append(dict(changes)))
    lines = take(gpio)
    lines.set({"azimuth_cw": True, "azimuth_ccw": True})
    lines.set({"azimuth_cw": False})
    assert instants == [{22: True, 23: True}, {22: False}]


def test_closing_leaves_what_was_off_off() -> None:
    gpio = simulated(PI_4)
    lines = take(gpio)
    lines.set({"azimuth_cw": True})
    lines.set({"azimuth_cw": False})
    lines.close()
    assert not gpio.level(22)


def test_lines_that_were_released_cannot_be_switched() -> None:
    """Another program may hold them by now."""
    gpio = simulated(PI_4)
    lines = take(gpio)
    lines.close()
    with pytest.raises(HardwareError, match="cannot switch azimuth_cw: the lines have been released"):
        lines.set({"azimuth_cw": True})
    assert not gpio.level(22)


def test_a_switch_to_ground_reads_closed_and_an_open_one_is_pulled_up() -> None:
    gpio = simulated(PI_4)
    gpio.drive_input(10, False)
    inputs = GpioInputs(gpio, "/dev/gpiochip0", {"msb": 10, "lsb": 9}, consumer="test")
    assert inputs.read() == {"msb": True, "lsb": False}


def test_released_inputs_cannot_be_read() -> None:
    inputs = GpioInputs(simulated(PI_4), "/dev/gpiochip0", {"msb": 10, "lsb": 9}, consumer="test")
    inputs.close()
    with pytest.raises(HardwareError, match="cannot read msb, lsb: the lines have been released"):
        inputs.read()


def test_a_chip_that_is_not_there_is_a_sentence() -> None:
    with pytest.raises(HardwareError, match=r"/dev/gpiochip7: cannot take azimuth_cw on GPIO22.*No such file"):
        take(simulated(PI_4), "/dev/gpiochip7")


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


def test_the_real_package_is_at_hand() -> None:
    pytest.importorskip("gpiod")
    assert callable(real_gpiod().request_lines)


def test_without_the_package_it_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gpiod", None)
    with pytest.raises(HardwareError, match="the Python package gpiod cannot be loaded"):
        real_gpiod()


def test_its_namesake_of_version_1_is_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    # pip on 32-bit ARM takes an unrelated gpiod 1.5 for it
    monkeypatch.setitem(sys.modules, "gpiod", ModuleType("gpiod"))
    with pytest.raises(HardwareError, match=r"gpiod 1\.x.*install gpiod 2\.1"):
        real_gpiod()
