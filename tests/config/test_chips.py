"""I2C addresses: those that a part can have are taken, 48 in place of 0x48 gets the right line."""

from __future__ import annotations

import pytest

from rotator.config.chips import ADDRESSES, I2CChip
from tests.config.texts import faults


@pytest.mark.parametrize("part", ADDRESSES)
def test_every_address_of_a_part_is_taken(part: str) -> None:
    assert all(I2CChip(1, address, "key", part).fault() is None for address in ADDRESSES[part])


@pytest.mark.parametrize("part", ADDRESSES)
def test_digits_without_0x_are_told_unless_they_are_an_address_too(part: str) -> None:
    for address in ADDRESSES[part]:
        digits = f"{address:x}"
        if digits.isdecimal() and int(digits) not in ADDRESSES[part]:
            fault = I2CChip(1, int(digits), "key", part).fault()
            assert fault is not None
            assert fault.endswith(f": write 0x{digits}")


def test_the_line_of_the_file() -> None:
    assert faults("[adc]\naddress = 48\n") == ["adc.address = 48 is 0x30, and no ADS1115 has that: write 0x48"]
    assert faults("[adc]\naddress = 0x77\n") == [
        "adc.address = 119 is 0x77, and no ADS1115 has that: write one of 0x48 to 0x4b"
    ]
    assert faults('[adc]\nkind = "mcp3208"\naddress = 48\n') == []


def test_parts_with_more_addresses_than_the_usual_ones() -> None:
    assert I2CChip(1, 0x60, "key", "PCA9685").fault() is None
    assert I2CChip(1, 0x31, "key", "AS5600").fault() is None
