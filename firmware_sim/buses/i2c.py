"""A simulated I2C adapter in the shape of `smbus2.SMBus`.

Knows the messages of a transfer, its time on the wire, Linux's error numbers, and two faults: an address that does not
answer, and a bus that hangs. Knows no chip: each attached chip gets the bytes for its address. Not simulated: SMBus
words, process calls and blocks with a length byte, clock stretching, and a second master.
"""

from __future__ import annotations

import ctypes
import errno
import os
import threading
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, Protocol, Self

from firmware_sim.sporadic import Sporadic

READ_FLAG = 0x0001  # I2C_M_RD, linux/i2c.h
MESSAGES_MAX = 42  # I2C_RDWR_IOCTL_MAX_MSGS, linux/i2c-dev.h
BLOCK_MAX = 32  # I2C_SMBUS_BLOCK_MAX, linux/i2c.h


class Nack(Exception):  # noqa: N818 - the field's word
    """Raised by a chip that does not acknowledge a byte."""


class I2CChip(Protocol):
    """A chip at an address. It gets whole messages; with an attribute `bytewise = True` it gets one byte at a time."""

    def write(self, data: bytes) -> None:
        """The data bytes of one write message, address not included. Raises Nack."""

    def read(self, count: int) -> bytes:
        """The bytes of one read message. Raises Nack."""


class _Message(NamedTuple):  # some hundred thousand of these in a simulated hour: a tuple is made faster
    address: int
    length: int
    data: bytes | None
    """The bytes that it writes; None: it reads `length` bytes."""


class SimI2CBus:
    """The adapter. One transfer at a time, from any thread; each address and data byte takes `byte_s` seconds.

    A transfer calls `sleep` once, because a real sleep of 90 µs a byte is too coarse. Chips get the bytes when the
    transfer is over. A chip that needs the moment of each byte reads its clock through `wire_time`.
    """

    def __init__(self, sleep: Callable[[float], None] | None = None, byte_s: float = 90e-6) -> None:
        self.gone: set[int] = set()
        """Fault: addresses that do not answer although a chip is attached there."""
        self.lapses: dict[int, tuple[Sporadic, ...]] = {}
        """Fault: by address, transfers that a chip does not answer, now and then."""
        self._sleep = sleep
        self._byte_s = byte_s
        self._chips: dict[int, I2CChip] = {}
        self._bytewise: set[int] = set()
        # Reentrant: simulated time has one thread, and an alarm may start a transfer while another transfer sleeps. The
        # chips then get the second transfer first.
        self._transfer_lock = threading.RLock()
        self._flowing = threading.Event()
        self._flowing.set()
        self._hang_timeout_s: float | None = None
        self._closed = False
        self._undelivered_bytes = 0
        self._unslept_s = 0.0

    # --- the bench: wiring and faults

    def attach(self, address: int, chip: I2CChip) -> None:
        if address in self._chips:
            raise ValueError(f"two chips at I2C address 0x{address:02x}")
        self._chips[address] = chip
        if getattr(chip, "bytewise", False):
            self._bytewise.add(address)

    def detach(self, address: int) -> None:
        del self._chips[address]
        self._bytewise.discard(address)

    def hang(self, hang_timeout_s: float | None = None) -> None:
        """Fault: each transfer blocks until `release`, or fails with ETIMEDOUT after `hang_timeout_s` of real time."""
        self._hang_timeout_s = hang_timeout_s
        self._flowing.clear()

    def release(self) -> None:
        self._flowing.set()

    def wire_time(self, clock: Callable[[], float]) -> Callable[[], float]:
        """A clock for a chip on this bus: during a transfer it gives the moment at which the current byte was complete.

        Without `sleep` a transfer takes no time on `clock`, but it does on this clock, which therefore runs ahead of
        `clock`. Its differences are right, so that a display does not count bytes as too fast for a real wire.
        """
        return lambda: clock() + self._unslept_s - self._undelivered_bytes * self._byte_s

    # --- smbus2.SMBus

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def open(self) -> None:
        """The next run of the program opens the adapter again."""
        self._closed = False

    def close(self) -> None:
        """Later transfers raise OSError(EBADF). (smbus2 0.6 raises TypeError there, by passing None as the fd.)"""
        self._closed = True

    def i2c_rdwr(self, *i2c_msgs: Any) -> None:
        """One transfer of real `smbus2.i2c_msg` objects, joined by repeated starts; reads fill their buffers."""
        if not 0 < len(i2c_msgs) <= MESSAGES_MAX:
            raise OSError(errno.EINVAL, os.strerror(errno.EINVAL))
        messages = []
        for each in i2c_msgs:
            length = each.len
            messages.append(_Message(each.addr, length, None if each.flags & READ_FLAG else each.buf[:length]))
        replies = iter(self._transfer(messages))
        for each, message in zip(i2c_msgs, messages, strict=True):
            if message.data is None:
                ctypes.memmove(each.buf, next(replies), message.length)

    def write_quick(self, i2c_addr: int, force: bool | None = None) -> None:
        self._transfer([_write(i2c_addr)])

    def write_byte(self, i2c_addr: int, value: int, force: bool | None = None) -> None:
        self._transfer([_write(i2c_addr, value)])

    def read_byte(self, i2c_addr: int, force: bool | None = None) -> int:
        return self._transfer([_Message(i2c_addr, 1, None)])[0][0]

    def write_byte_data(self, i2c_addr: int, register: int, value: int, force: bool | None = None) -> None:
        self._transfer([_write(i2c_addr, register, value)])

    def read_byte_data(self, i2c_addr: int, register: int, force: bool | None = None) -> int:
        return self._transfer([_write(i2c_addr, register), _Message(i2c_addr, 1, None)])[0][0]

    def write_i2c_block_data(
        self, i2c_addr: int, register: int, data: Iterable[int], force: bool | None = None
    ) -> None:
        block = tuple(data)
        _check_block(len(block))
        self._transfer([_write(i2c_addr, register, *block)])

    def read_i2c_block_data(self, i2c_addr: int, register: int, length: int, force: bool | None = None) -> list[int]:
        _check_block(length)
        return list(self._transfer([_write(i2c_addr, register), _Message(i2c_addr, length, None)])[0])

    # --- the wire

    def _transfer(self, messages: list[_Message]) -> list[bytes]:
        """One transfer. Returns the answers to its reads, in order. Raises OSError."""
        if self._closed:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        with self._transfer_lock:
            if not self._flowing.is_set() and not self._flowing.wait(self._hang_timeout_s):
                raise OSError(errno.ETIMEDOUT, os.strerror(errno.ETIMEDOUT))
            heard = 0
            wire_bytes = 0
            for address, length, _ in messages:
                wire_bytes += 1
                if address not in self._chips or address in self.gone or (not heard and self._lapses(address)):
                    break  # the first address without an ACK ends the transfer
                heard += 1
                wire_bytes += length
            self._spend(wire_bytes)
            try:
                replies = [reply for message in messages[:heard] if (reply := self._deliver(message)) is not None]
                if heard < len(messages):
                    raise Nack
            except Nack:
                raise OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO)) from None
            finally:
                self._undelivered_bytes = 0
            return replies

    def _lapses(self, address: int) -> bool:
        lapses = self.lapses.get(address)
        return lapses is not None and any(lapse.strikes() for lapse in lapses)

    def _spend(self, wire_bytes: int) -> None:
        duration_s = wire_bytes * self._byte_s
        if self._sleep is None:
            self._unslept_s += duration_s
        else:
            self._sleep(duration_s)
        self._undelivered_bytes = wire_bytes

    def _deliver(self, message: _Message) -> bytes | None:
        address, length, data = message
        chip = self._chips[address]
        self._undelivered_bytes -= 1  # the address byte
        if data is None:
            reply = chip.read(length)  # a chip fixes its answer at its address byte, not at the last bit
            self._undelivered_bytes -= length
            # Where no chip pulls SDA down the master reads ones.
            return reply if len(reply) == length else reply[:length].ljust(length, b"\xff")
        if address in self._bytewise:
            for value in data:
                self._undelivered_bytes -= 1
                chip.write(bytes([value]))
        else:
            self._undelivered_bytes -= length
            chip.write(data)
        return None


def _write(address: int, *values: int) -> _Message:
    data = bytes(value & 0xFF for value in values)  # smbus2 puts them into a c_uint8, which cuts them the same way
    return _Message(address, len(data), data)


def _check_block(length: int) -> None:
    if length > BLOCK_MAX:
        raise ValueError(f"Data length cannot exceed {BLOCK_MAX} bytes")
