"""What Linux really says about an I2C adapter that misbehaves, and what our sentence makes of it."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest

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
