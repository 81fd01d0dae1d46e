"""The adapter through smbus2: whole transfers, and Linux's error numbers as sentences."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from hw.buses.i2c import SmbusI2C, open_bus
from hw.ports import HardwareError
from tests.tables import every_row

ADDRESS = 0x48


class Memory:
    """A chip that keeps what is written and answers with what it was given."""

    def __init__(self, answer: bytes = b"") -> None:
        self.log: list[bytes | int] = []
        self.answer = answer

    def write(self, data: bytes) -> None:
        self.log.append(data)

    def read(self, count: int) -> bytes:
        self.log.append(count)
        return self.answer[:count]


class BrokenAdapter:
    """An adapter whose every transfer ends with one error number."""

    def __init__(self, number: int) -> None:
        self._number = number

    def i2c_rdwr(self, *_messages: object) -> None:
        raise OSError(self._number, os.strerror(self._number))


@pytest.fixture
def chip() -> Memory:
    return Memory(b"\x85\x83")


@pytest.fixture
def wire(chip: Memory) -> SimI2CBus:
    wire = SimI2CBus()
    wire.attach(ADDRESS, chip)
    return wire


@pytest.fixture
def bus(wire: SimI2CBus) -> SmbusI2C:
    return SmbusI2C(wire, "/dev/i2c-1")


@pytest.mark.parametrize("way", ["empty", "gone"])
def test_a_chip_that_does_not_answer(bus: SmbusI2C, wire: SimI2CBus, way: str) -> None:
    address = 0x49 if way == "empty" else ADDRESS
    wire.gone.add(address)
    with pytest.raises(HardwareError) as fault:
        bus.write_read(address, b"\x00", 2)
    assert str(fault.value) == (
        f"I2C /dev/i2c-1: the device does not answer; check its wiring, power and address (address 0x{address:02x})"
    )
    assert isinstance(fault.value.__cause__, OSError)


@every_row(
    ("number", "words"),
    [
        (errno.EREMOTEIO, "does not answer"),  # the Pi's own controller
        (errno.ENXIO, "does not answer"),  # i2c-gpio, and adapters on USB
        (errno.ETIMEDOUT, "the bus hangs"),
        (errno.EIO, "Input/output error; something holds SDA or SCL low, or the adapter has gone"),
        (errno.EAGAIN, "Resource temporarily unavailable"),
    ],
)
def test_each_error_number_is_a_sentence(number: int, words: str) -> None:
    with pytest.raises(HardwareError, match=rf"^I2C bus 1: .*{words}.*\(address 0x27\)$"):
        SmbusI2C(BrokenAdapter(number), "bus 1").write(0x27, b"\x00")


def test_asking_whether_a_chip_answers_writes_nothing(bus: SmbusI2C, chip: Memory) -> None:
    assert bus.answers(ADDRESS)
    assert not bus.answers(0x49)
    assert chip.log == [1]


@pytest.mark.parametrize("number", [errno.EREMOTEIO, errno.ENXIO], ids=["the Pi's own", "on USB"])
def test_each_error_number_for_an_address_without_an_answer(number: int) -> None:
    assert not SmbusI2C(BrokenAdapter(number), "bus 1").answers(ADDRESS)


def test_a_sick_bus_is_no_answer(bus: SmbusI2C, wire: SimI2CBus) -> None:
    wire.hang(hang_timeout_s=0.01)
    with pytest.raises(HardwareError, match="the bus hangs"):
        bus.answers(ADDRESS)


def test_a_missing_adapter_says_how_to_switch_it_on() -> None:
    number = next(number for number in range(200, 256) if not Path(f"/dev/i2c-{number}").exists())
    with pytest.raises(HardwareError, match=rf"there is no /dev/i2c-{number}: switch I2C on \(dtparam=i2c_arm=on"):
        open_bus(number)
