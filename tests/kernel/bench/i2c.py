"""A real /dev/i2c-N whose far end is a simulated bus: the kernel's i2c-tiny-usb driver, and its adapter in Python.

Knows the adapter's vendor requests (drivers/i2c/busses/i2c-tiny-usb.c). Knows no chip: they are attached to the
`SimI2CBus` it is given, and taken off it to be unplugged.
"""

from __future__ import annotations

import os
import struct
from pathlib import Path
from typing import Self

from smbus2 import i2c_msg

from firmware_sim.buses.i2c import READ_FLAG, SimI2CBus
from tests.kernel.bench.usbip import Identity, Setup, StallError, UsbDevice
from tests.kernel.bench.waiting import until

IDENTITY = Identity(0x0403, 0xC631, "i2c-tiny-usb")
BUSES = Path("/sys/bus/i2c/devices")

ECHO, GET_FUNCTIONS, SET_DELAY, GET_STATUS, IO = 0, 1, 2, 3, 4
IO_BEGIN_END = 3
PLAIN_I2C_AND_SMBUS = 0x0EFF0001
ACKNOWLEDGED, NOT_ACKNOWLEDGED = 1, 2


class I2CAdapter:
    """The adapter, from `plug` to `unplug`. A transfer's errors are what Linux makes of them: ENXIO without an ACK,
    ETIMEDOUT after two seconds on a bus that hangs, EIO when the adapter has gone."""

    def __init__(self, bus: SimI2CBus) -> None:
        self._bus = bus
        self._status = 0
        self._usb = UsbDevice(IDENTITY, self._control)
        self.number: int | None = None
        """N of /dev/i2c-N while it is plugged in."""

    def __enter__(self) -> Self:
        self.plug()
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def plug(self) -> int:
        """Returns N of /dev/i2c-N once it can be opened."""
        before = set(_numbers())
        self._usb.plug()
        (self.number,) = until(lambda: set(_numbers()) - before, "an I2C adapter")
        path = f"/dev/i2c-{self.number}"
        until(lambda: os.access(path, os.R_OK | os.W_OK), path)
        return self.number

    def unplug(self) -> None:
        """Out it goes, whoever uses it: their transfers fail from now on."""
        self._usb.unplug()

    def close(self) -> None:
        """Unplug, and wait until the kernel has forgotten it. Everybody must have closed it, or it never does."""
        self.unplug()
        self._bus.release()
        gone, self.number = self.number, None
        until(lambda: gone not in _numbers(), f"the end of /dev/i2c-{gone}")

    def _control(self, setup: Setup, data: bytes) -> bytes:
        match setup.request:
            case 0:  # ECHO
                return struct.pack("<H", setup.value)
            case 1:  # GET_FUNCTIONS
                return struct.pack("<I", PLAIN_I2C_AND_SMBUS)
            case 2:  # SET_DELAY
                return b""
            case 3:  # GET_STATUS
                return bytes([self._status])
            case request if request & ~IO_BEGIN_END == IO:
                return self._message(setup, data)
            case _:
                raise StallError

    def _message(self, setup: Setup, data: bytes) -> bytes:
        reading = setup.value & READ_FLAG
        message = i2c_msg.read(setup.index, setup.length) if reading else i2c_msg.write(setup.index, data)
        try:
            self._bus.i2c_rdwr(message)
        except OSError:
            self._status = NOT_ACKNOWLEDGED
            return bytes(setup.length) if reading else b""
        self._status = ACKNOWLEDGED
        return bytes(message) if reading else b""


def _numbers() -> list[int]:
    """The I2C adapters of that kind, by their names: numbers are given in the order of appearance."""
    found = []
    for bus in BUSES.glob("i2c-*"):
        try:
            if (bus / "name").read_text().startswith("i2c-tiny-usb"):
                found.append(int(bus.name.removeprefix("i2c-")))
        except OSError:
            continue
    return found
