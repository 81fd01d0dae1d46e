"""What Linux really says about an I2C adapter that misbehaves, and what our sentence makes of it."""

from __future__ import annotations

import errno
import time
from collections.abc import Iterator

import pytest
from smbus2 import SMBus

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115
from hw.buses.i2c import open_bus
from hw.ports import HardwareError
from tests.kernel.bench.i2c import I2CAdapter

ADDRESS, NOBODY = 0x48, 0x49
CONFIG_RESET = [0x85, 0x83]
USB_TIMEOUT_S = 2.0


@pytest.fixture
def wire() -> SimI2CBus:
    wire = SimI2CBus()
    wire.attach(ADDRESS, Ads1115(time.monotonic))
    return wire


@pytest.fixture
def adapter(wire: SimI2CBus) -> Iterator[I2CAdapter]:
    with I2CAdapter(wire) as adapter:
        yield adapter


def test_every_way_of_smbus2_reaches_the_chip(adapter: I2CAdapter) -> None:
    assert adapter.number is not None
    with SMBus(adapter.number) as bus:
        assert bus.read_i2c_block_data(ADDRESS, 1, 2) == CONFIG_RESET
        bus.write_i2c_block_data(ADDRESS, 2, [0x12, 0x34])
        assert bus.read_word_data(ADDRESS, 2) == 0x3412
        assert bus.read_byte(ADDRESS) == 0x12


def test_a_second_program_reads_the_same_chip(adapter: I2CAdapter) -> None:
    assert adapter.number is not None
    with SMBus(adapter.number) as one, SMBus(adapter.number) as other:
        for value in range(20):
            one.write_i2c_block_data(ADDRESS, 3, [value, 0])
            assert other.read_i2c_block_data(ADDRESS, 3, 2) == [value, 0]


def test_without_an_acknowledge_the_number_is_enxio(adapter: I2CAdapter) -> None:
    assert adapter.number is not None
    with SMBus(adapter.number) as bus, pytest.raises(OSError, match="No such device or address") as fault:
        bus.read_byte(NOBODY)
    assert fault.value.errno == errno.ENXIO


def test_a_bus_that_hangs_in_mid_transfer_costs_the_adapters_timeout_each_time(
    adapter: I2CAdapter, wire: SimI2CBus
) -> None:
    assert adapter.number is not None
    bus = open_bus(adapter.number)
    wire.hang()
    for _ in range(2):
        began_s = time.monotonic()
        with pytest.raises(HardwareError, match="something holds SDA or SCL low"):
            bus.write_read(ADDRESS, b"\x01", 2)
        assert time.monotonic() - began_s >= 0.9 * USB_TIMEOUT_S
    wire.release()
    assert bus.write_read(ADDRESS, b"\x01", 2) == bytes(CONFIG_RESET)
    bus.close()


def test_an_adapter_pulled_out_and_put_back(adapter: I2CAdapter) -> None:
    assert adapter.number is not None
    bus = open_bus(adapter.number)
    adapter.unplug()
    for _ in range(2):
        with pytest.raises(HardwareError, match=r"^I2C /dev/i2c-\d+: .*the adapter has gone.*\(address 0x48\)$"):
            bus.write_read(ADDRESS, b"\x01", 2)
    bus.close()
    adapter.close()
    bus = open_bus(adapter.plug())
    assert bus.write_read(ADDRESS, b"\x01", 2) == bytes(CONFIG_RESET)
    bus.close()
