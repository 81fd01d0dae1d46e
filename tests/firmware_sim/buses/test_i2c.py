"""The adapter as Linux and the I2C specification describe it.

Knows smbus2's real message objects. Knows one chip only: a memory that stores the bytes it gets.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest
from smbus2 import i2c_msg

from firmware_sim.buses.i2c import Nack, SimI2CBus

ADDRESS = 0x48
BYTE_S = 90e-6  # nine clocks at 100 kHz: eight bits and the ACK


class Recorder:
    """A chip that keeps what was written and answers with what it was given."""

    def __init__(self, answer: bytes = b"", clock: Callable[[], float] = lambda: 0.0, bytewise: bool = False) -> None:
        self.written: list[bytes] = []
        self.moments_s: list[float] = []
        self.answer = answer
        self.bytewise = bytewise
        self.refuses = False
        self._clock = clock

    def write(self, data: bytes) -> None:
        if self.refuses:
            raise Nack
        self.written.append(data)
        self.moments_s.append(self._clock())

    def read(self, count: int) -> bytes:
        self.moments_s.append(self._clock())
        return self.answer[:count]


class FakeTime:
    def __init__(self) -> None:
        self.now_s = 0.0
        self.sleeps: list[float] = []

    def clock(self) -> float:
        return self.now_s

    def sleep(self, seconds: float) -> None:
        self.sleeps.append(seconds)
        self.now_s += seconds


def bus_with(chip: Recorder, sleep: Callable[[float], None] | None = None) -> SimI2CBus:
    bus = SimI2CBus(sleep)
    bus.attach(ADDRESS, chip)
    return bus


# --- transfers


def test_a_combined_transfer_writes_and_then_reads() -> None:
    chip = Recorder(b"\x85\x83")
    answer = i2c_msg.read(ADDRESS, 2)
    bus_with(chip).i2c_rdwr(i2c_msg.write(ADDRESS, [0x01]), answer)
    assert (chip.written, bytes(answer)) == ([b"\x01"], b"\x85\x83")


def test_smbus_calls_are_the_same_bytes() -> None:
    # Linux, Documentation/i2c/smbus-protocol.rst: what each call puts on the wire
    chip = Recorder(b"\xa1\xa2\xa3")
    bus = bus_with(chip)
    bus.write_quick(ADDRESS)
    bus.write_byte(ADDRESS, 0x10)
    bus.write_byte_data(ADDRESS, 0x20, 0x21)
    bus.write_i2c_block_data(ADDRESS, 0x30, [0x31, 0x32])
    assert chip.written == [b"", b"\x10", b"\x20\x21", b"\x30\x31\x32"]
    assert bus.read_byte(ADDRESS) == 0xA1
    assert bus.read_byte_data(ADDRESS, 0x40) == 0xA1
    assert bus.read_i2c_block_data(ADDRESS, 0x50, 4) == [0xA1, 0xA2, 0xA3, 0xFF]  # no chip pulls the last one down
    assert chip.written[4:] == [b"\x40", b"\x50"]


# --- time


def test_a_transfer_sleeps_once_for_every_address_and_data_byte() -> None:
    time = FakeTime()
    bus = bus_with(Recorder(b"\0\0"), sleep=time.sleep)
    bus.i2c_rdwr(i2c_msg.write(ADDRESS, [0x00]), i2c_msg.read(ADDRESS, 2))
    assert time.sleeps == pytest.approx([5 * BYTE_S])  # address, pointer, address again, two bytes back


def test_an_unanswered_address_takes_one_byte() -> None:
    time = FakeTime()
    with pytest.raises(OSError, match="Remote I/O"):
        SimI2CBus(sleep=time.sleep).i2c_rdwr(i2c_msg.write(ADDRESS, bytes(10)))
    assert time.sleeps == pytest.approx([BYTE_S])


def test_wire_time_tells_a_bytewise_chip_when_each_byte_came() -> None:
    time = FakeTime()
    bus = SimI2CBus(sleep=time.sleep)
    chip = Recorder(clock=bus.wire_time(time.clock), bytewise=True)
    bus.attach(ADDRESS, chip)
    bus.i2c_rdwr(i2c_msg.write(ADDRESS, b"abc"))
    assert chip.written == [b"a", b"b", b"c"]
    assert chip.moments_s == pytest.approx([2 * BYTE_S, 3 * BYTE_S, 4 * BYTE_S])
    assert len(time.sleeps) == 1


# --- what goes wrong


def test_a_chip_that_is_gone_comes_back_until_it_is_detached() -> None:
    chip = Recorder()
    bus = bus_with(chip)
    bus.gone.add(ADDRESS)
    with pytest.raises(OSError, match="Remote I/O error"):
        bus.write_byte(ADDRESS, 1)
    bus.gone.remove(ADDRESS)
    bus.write_byte(ADDRESS, 2)
    bus.detach(ADDRESS)
    with pytest.raises(OSError, match="Remote I/O error"):
        bus.write_byte(ADDRESS, 3)
    assert chip.written == [b"\x02"]


def test_a_hung_bus_lets_nothing_through_until_released() -> None:
    chip = Recorder()
    bus = bus_with(chip)
    bus.hang()
    writer = threading.Thread(target=bus.write_byte, args=(ADDRESS, 7), daemon=True)
    writer.start()
    assert chip.written == []
    bus.release()
    writer.join(timeout=10)
    assert chip.written == [b"\x07"]
