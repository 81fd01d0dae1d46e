"""The ADXL345: an accelerometer of three axes.

Knows the chip's registers (Analog Devices ADXL345, "Register Map"). Uses neither its FIFO nor its interrupts, and does
not know how the board is mounted.
"""

from __future__ import annotations

import struct
from collections.abc import Callable

from hw.chips.accelerometer import AccelerometerChip
from hw.ports import BoardAxes, HardwareError, I2CBus

ADDRESS = 0x53
"""With SDO (ALT ADDRESS) low; 0x1D with it high."""

DEVID, BW_RATE, POWER_CTL, DATA_FORMAT, DATA = 0x00, 0x2C, 0x2D, 0x31, 0x32

IDENTITY = 0xE5
RATE_50_HZ = 0x09
"""The chip's own filter then ends at 25 Hz, below the hum of a motor."""
FULL_RESOLUTION_2_G = 0x08
MEASURE = 0x08
STEPS_PER_G = 256
SETTLING_S = 0.05
"""Its first results come one period and 1.1 ms after standby."""


class Adxl345(AccelerometerChip):
    def __init__(self, bus: I2CBus, sleep: Callable[[float], None], address: int = ADDRESS) -> None:
        super().__init__("ADXL345", bus, sleep, address)

    def _result(self) -> BoardAxes:
        x, y, z = struct.unpack("<hhh", self._bus.write_read(self._address, bytes([DATA]), 6))
        return x / STEPS_PER_G, y / STEPS_PER_G, z / STEPS_PER_G

    def _begin(self) -> None:
        identity, power = (self._bus.write_read(self._address, bytes([at]), 1)[0] for at in (DEVID, POWER_CTL))
        if identity != IDENTITY:
            raise HardwareError(
                f"{self.name}: the chip's identity is 0x{identity:02x}, an ADXL345 has 0xe5; "
                "another chip is at this address"
            )
        for register, value in ((DATA_FORMAT, FULL_RESOLUTION_2_G), (BW_RATE, RATE_50_HZ), (POWER_CTL, MEASURE)):
            self._bus.write(self._address, bytes([register, value]))
        if power != MEASURE:
            self._sleep(SETTLING_S)
