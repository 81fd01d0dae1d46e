"""An I2C chip in use, with its bus and address, and the addresses that each part can have.

Knows no register, and not which chips a configuration uses: its tables say that.
"""

from __future__ import annotations

from dataclasses import dataclass

ADDRESSES: dict[str, tuple[int, ...]] = {
    "ADS1115": tuple(range(0x48, 0x4C)),
    "PCA9685": tuple(range(0x40, 0x48)),
    "PCF8574": (*range(0x20, 0x28), *range(0x38, 0x40)),
    "AS5600": (0x36, 0x40),
    "MPU6050": (0x68, 0x69),
    "BNO055": (0x28, 0x29),
}
"""The usual addresses of each part, from its data sheet. 0x38 to 0x3F are those of the PCF8574A."""


@dataclass(frozen=True, slots=True)
class I2CChip:
    bus: int
    """The N of /dev/i2c-N."""
    address: int
    key: str
    """The key of the file that names the address: `adc.address`."""
    part: str
    """The name of the part, as in `ADDRESSES`."""
