"""Everything in the hardware layer that has a `close` may be closed twice; the second call changes nothing."""

from __future__ import annotations

import importlib
import inspect
import os
import pkgutil
import socket
import time
from collections.abc import Callable
from typing import Any, Protocol

import pytest

import hw
from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.buses.pwm import SimPwm
from firmware_sim.buses.spi import SimSpidev
from firmware_sim.chips.mcp41010 import Mcp41010
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioContact, GpioInputs, GpioOutputs, GpioPair
from hw.buses.i2c import SmbusI2C
from hw.buses.pwm import KernelPwm
from hw.buses.spi import KernelSpi
from hw.controllers.port import SerialPort as ControllerSerialPort
from hw.controllers.port import TcpPort
from hw.drives.speed import SpeedOutput
from hw.moteus.bus import MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.library import SerialPort
from hw.moteus.orders import MoteusSpec
from hw.ports import HardwareError
from hw.sensors.pulses import TappedLines
from tests.tables import every_row

PATH, PINS = "/dev/gpiochip0", {"azimuth_cw": 22, "azimuth_ccw": 23}


class Closable(Protocol):
    def close(self) -> None: ...


def gpio() -> SimGpio:
    return SimGpio(SimClock())


def outputs() -> GpioOutputs:
    return GpioOutputs(gpio(), PATH, PINS, consumer="test")


def moteus() -> MoteusBus:
    pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")
    return MoteusBus(MoteusDrive(MoteusSpec(1), MoteusSpec(2), time.monotonic), SerialPort("/dev/no-such-adapter"))


def started_moteus() -> MoteusBus:
    bus = moteus()
    bus.start()
    return bus


def controller_cable() -> ControllerSerialPort:
    _, terminal = os.openpty()
    return ControllerSerialPort(os.ttyname(terminal), 9600)


def controller_connection() -> TcpPort:
    with socket.create_server(("127.0.0.1", 0)) as listening:
        return TcpPort(*listening.getsockname())


CLOSABLES: dict[str, Callable[[], Closable]] = {
    "outputs": outputs,
    "inputs": lambda: GpioInputs(gpio(), PATH, PINS, consumer="test"),
    "contact": lambda: GpioContact(gpio(), PATH, 17, consumer="test"),
    "pair": lambda: GpioPair(gpio(), PATH, (16, 20), consumer="test"),
    "PWM": lambda: KernelPwm(SimPwm(), 18, 20_000.0, lambda _seconds: None),
    "speed": lambda: SpeedOutput(KernelPwm(SimPwm(), 18, 20_000.0, lambda _seconds: None), 0.0, 1.0, 0.2, SimClock()),
    "tapped lines": lambda: TappedLines(outputs(), SimClock()),
    "I2C": lambda: SmbusI2C(SimI2CBus(), "bus 1"),
    "SPI": lambda: KernelSpi(SimSpidev({(0, 0): Mcp41010()}), 0, {"azimuth": 0}),
    "a controller's serial port": controller_cable,
    "a controller's connection": controller_connection,
    "moteus": started_moteus,
    "moteus, never started": moteus,
}


TRIED = {
    kind.__name__
    for kind in (
        *(GpioOutputs, GpioInputs, GpioContact, GpioPair, KernelPwm, TappedLines, SmbusI2C, KernelSpi, MoteusBus),
        *(ControllerSerialPort, TcpPort, SpeedOutput),
    )
}
ELSEWHERE = {"Sentinel"}
"""A process of its own, which needs a real GPIO chip: tests/kernel."""


@every_row("make", CLOSABLES.values())
def test_closed_twice(make: Callable[[], Closable]) -> None:
    thing = make()
    thing.close()
    thing.close()


@every_row(
    ("what", "use"),
    [
        ("outputs", lambda lines: lines.set({"azimuth_cw": False})),
        ("inputs", lambda lines: lines.read()),
        ("contact", lambda contact: contact.closed()),
        ("contact", lambda contact: contact.changes()),
        ("I2C", lambda bus: bus.write(0x48, b"")),
    ],
)
def test_using_it_after_close_is_a_hardware_error(what: str, use: Callable[[Any], object]) -> None:
    thing = CLOSABLES[what]()
    thing.close()
    with pytest.raises(HardwareError, match=r"released|closed"):
        use(thing)


def test_no_driver_is_left_out() -> None:
    modules = [importlib.import_module(module.name) for module in pkgutil.walk_packages(hw.__path__, "hw.")]
    drivers = {
        kind.__name__
        for module in modules
        for _, kind in inspect.getmembers(module, inspect.isclass)
        if kind.__module__ == module.__name__
        and hasattr(kind, "close")
        and not getattr(kind, "_is_protocol", False)
        and not kind.__name__.startswith("_")
    }
    assert drivers == TRIED | ELSEWHERE, "give it a line in CLOSABLES"
