"""An I2C adapter through smbus2; its errors say what to check.

Knows Linux's error numbers. Does not know which chip is at an address. The only importer of smbus2.
"""

from __future__ import annotations

import errno
from collections.abc import Sequence
from functools import lru_cache
from threading import get_ident
from typing import Any

from smbus2 import SMBus, i2c_msg

from hw.ports import HardwareError


class SmbusI2C:
    """A `hw.ports.I2CBus`. `bus`: an open smbus2.SMBus, or an object of its shape. `name` opens each error."""

    def __init__(self, bus: Any, name: str) -> None:
        self._bus = bus
        self._name = name
        self._closed = False
        self._questions: dict[tuple[int, int, tuple[bytes, ...], int], _Question] = {}
        """The questions asked before, by thread. A question comes some ten times a second, and building its messages
        takes longer than sending them to the kernel."""

    def write(self, address: int, data: bytes) -> None:
        self._transfer(address, _written(address, data))

    def write_read(self, address: int, data: bytes, count: int) -> bytes:
        return self._ask(address, (data,), count)[0]

    def read_each(self, address: int, registers: Sequence[int], count: int) -> list[bytes]:
        return self._ask(address, tuple(bytes((register,)) for register in registers), count)

    def _ask(self, address: int, writes: tuple[bytes, ...], count: int) -> list[bytes]:
        """Write each of `writes` and read `count` bytes after it, all in one transfer. Raises HardwareError."""
        key = get_ident(), address, writes, count
        question = self._questions.get(key)
        if question is None:
            question = self._questions[key] = _Question(address, writes, count)
        self._transfer(address, *question.messages)
        return [bytes(answer) for answer in question.answers]

    def answers(self, address: int) -> bool:
        """Whether a chip acknowledges the address when one byte is read. Raises HardwareError: the bus itself fails."""
        try:
            self._transfer(address, i2c_msg.read(address, 1))
        except HardwareError as fault:
            if isinstance(fault.__cause__, OSError) and fault.__cause__.errno in (errno.EREMOTEIO, errno.ENXIO):
                return False
            raise
        return True

    def close(self) -> None:
        """Release the adapter. Later transfers raise HardwareError. May be called twice."""
        self._closed = True
        self._bus.close()

    def _transfer(self, address: int, *messages: i2c_msg) -> None:
        if self._closed:  # smbus2 would raise a TypeError
            raise HardwareError(f"I2C {self._name}: it has been closed (address 0x{address:02x})")
        try:
            self._bus.i2c_rdwr(*messages)
        except OSError as fault:
            raise HardwareError(f"I2C {self._name}: {_explain(fault)} (address 0x{address:02x})") from fault


class _Question:
    """A transfer that can be sent again and again, by one thread: the answers stand in the same places each time."""

    def __init__(self, address: int, writes: tuple[bytes, ...], count: int) -> None:
        self.answers = [i2c_msg.read(address, count) for _ in writes]
        pairs = zip([_written(address, data) for data in writes], self.answers, strict=True)
        self.messages = [message for pair in pairs for message in pair]


@lru_cache(maxsize=256)
def _written(address: int, data: bytes) -> i2c_msg:
    """A message that writes. It can be sent again, by any thread: sending changes nothing in it."""
    return i2c_msg.write(address, data)


def _explain(fault: OSError) -> str:
    match fault.errno:
        case errno.EREMOTEIO | errno.ENXIO:
            return "the device does not answer; check its wiring, power and address"
        case errno.ETIMEDOUT:
            return "the bus hangs; something holds SDA or SCL low"
        case errno.EIO:
            # The Pi's own controller reports this for a clock held low too long, a USB adapter for a pulled plug.
            return f"{fault.strerror}; something holds SDA or SCL low, or the adapter has gone"
        case _:
            return fault.strerror or str(fault)


def open_bus(number: int) -> SmbusI2C:
    """The adapter /dev/i2c-N. Raises HardwareError."""
    path = f"/dev/i2c-{number}"
    try:
        return SmbusI2C(SMBus(number), path)
    except FileNotFoundError as fault:
        raise HardwareError(
            f"I2C: there is no {path}: switch I2C on (dtparam=i2c_arm=on in /boot/firmware/config.txt) and reboot"
        ) from fault
    except PermissionError as fault:
        raise HardwareError(f"I2C: no permission for {path}: add the user to the group i2c") from fault
    except OSError as fault:
        raise HardwareError(f"I2C: {path}: {fault.strerror or fault}") from fault
