"""The adapter through smbus2: bytes as on the wire, and one sentence for an error, with any of its numbers."""

from __future__ import annotations

import pytest

from hw.ports import HardwareError
from tests.contract.bench import EMPTY_ADDRESS, Bench

LOW_THRESHOLD = 0x02
"""A register of the converter that does nothing while its comparator is off."""


def test_what_was_written_is_read_back_in_the_order_of_the_wire(bench: Bench) -> None:
    for word in (b"\x12\x34", b"\x80\x00"):
        bench.bus.write(bench.adc_address, bytes([LOW_THRESHOLD]) + word)
        assert bench.bus.write_read(bench.adc_address, bytes([LOW_THRESHOLD]), 2) == word


def test_a_row_of_a_display_fits_in_one_write(bench: Bench) -> None:
    # an SMBus block ends at 32 bytes; all zeros leave E low, so a display takes no notice
    bench.bus.write(bench.lcd_address, bytes(68))


def test_an_empty_address_is_a_sentence(bench: Bench) -> None:
    with pytest.raises(HardwareError, match=r"^I2C .+: the device does not answer; .* \(address 0x35\)$") as fault:
        bench.bus.write_read(EMPTY_ADDRESS, b"\x00", 2)
    assert isinstance(fault.value.__cause__, OSError)


def test_an_empty_address_disturbs_no_other(bench: Bench) -> None:
    for _ in range(3):
        with pytest.raises(HardwareError):
            bench.bus.write(EMPTY_ADDRESS, b"\x00")
        assert len(bench.bus.write_read(bench.adc_address, b"\x01", 2)) == 2


def test_a_bus_that_hangs_gives_up_with_a_sentence_and_recovers(bench: Bench) -> None:
    bench.hang()
    with pytest.raises(HardwareError, match="something holds SDA or SCL low"):
        bench.bus.write_read(bench.adc_address, b"\x01", 2)
    bench.release()
    assert len(bench.bus.write_read(bench.adc_address, b"\x01", 2)) == 2


def test_a_closed_bus_is_a_sentence_too(bench: Bench) -> None:
    bench.bus.close()
    with pytest.raises(HardwareError, match=r"it has been closed \(address 0x48\)$"):
        bench.bus.write(0x48, b"\x00")
