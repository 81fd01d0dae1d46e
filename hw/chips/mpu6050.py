"""The MPU6050: an accelerometer of three axes.

Knows the chip's registers (InvenSense RM-MPU-6000A). Does not use its gyroscopes, and does not know how the board is
mounted.
"""

from __future__ import annotations

import struct
from collections.abc import Callable

from hw.chips.accelerometer import AccelerometerChip
from hw.ports import BoardAxes, HardwareError, I2CBus

ADDRESS = 0x68
"""With AD0 low; 0x69 with AD0 high."""

CONFIG = 0x1A
ACCEL_CONFIG = 0x1C
ACCEL_OUT = 0x3B
POWER = 0x6B
WHO_AM_I = 0x75

IDENTITY = 0x68
AWAKE = 0x00
LOW_PASS_10_HZ = 5
"""Delays a reading by 13.8 ms, and filters out the motor's vibration, which would look like an acceleration."""
RANGE_2_G = 0x00
STEPS_PER_G = 16384
SETTLING_S = 0.05


class Mpu6050(AccelerometerChip):
    def __init__(self, bus: I2CBus, sleep: Callable[[float], None], address: int = ADDRESS) -> None:
        super().__init__("MPU6050", bus, sleep, address)

    def _result(self) -> BoardAxes:
        x, y, z = struct.unpack(">hhh", self._bus.write_read(self._address, bytes([ACCEL_OUT]), 6))
        return x / STEPS_PER_G, y / STEPS_PER_G, z / STEPS_PER_G

    def _begin(self) -> None:
        identity, power = (self._bus.write_read(self._address, bytes([at]), 1)[0] for at in (WHO_AM_I, POWER))
        if identity != IDENTITY:
            raise HardwareError(
                f"{self.name}: the chip's identity is 0x{identity:02x}, an MPU6050 has 0x68; "
                "another chip is at this address"
            )
        for register, value in ((POWER, AWAKE), (CONFIG, LOW_PASS_10_HZ), (ACCEL_CONFIG, RANGE_2_G)):
            self._bus.write(self._address, bytes([register, value]))
        if power != AWAKE:
            self._sleep(SETTLING_S)
