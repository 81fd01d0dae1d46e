"""The LSM303DLHC's accelerometer, one of the two chips in its package; the compass beside it is `hmc5883l.LSM303DLHC`.

Knows its registers (ST LSM303DLHC, section 7.1). It has no register that names it: what it keeps of what is written
does. Does not know how the board is mounted.
"""

from __future__ import annotations

import struct
from collections.abc import Callable

from hw.chips.accelerometer import AccelerometerChip
from hw.ports import BoardAxes, HardwareError, I2CBus

ADDRESS = 0x19

CTRL_1, CTRL_4, OUT = 0x20, 0x23, 0x28
EACH_NEXT = 0x80
"""This bit of a register's number lets a transfer go on to the next register."""
RATE_100_HZ_XYZ = 0x57
WHOLE_FINE_2_G = 0x88
"""Both bytes of a result are of one moment; high resolution, which also filters at 11 Hz; ±2 g."""
STEPS_PER_G = 16000
"""Twelve bits of 1 mg, at the left of sixteen."""
SETTLING_S = 0.1
"""Seven results in high resolution, until they are right."""


class Lsm303Accelerometer(AccelerometerChip):
    def __init__(self, bus: I2CBus, sleep: Callable[[float], None], address: int = ADDRESS) -> None:
        super().__init__("LSM303DLHC", bus, sleep, address)

    def _result(self) -> BoardAxes:
        x, y, z = struct.unpack("<hhh", self._bus.write_read(self._address, bytes([OUT | EACH_NEXT]), 6))
        return x / STEPS_PER_G, y / STEPS_PER_G, z / STEPS_PER_G

    def _begin(self) -> None:
        settings = ((CTRL_4, WHOLE_FINE_2_G), (CTRL_1, RATE_100_HZ_XYZ))
        ran = self._kept(CTRL_1) == RATE_100_HZ_XYZ
        for register, value in settings:
            self._bus.write(self._address, bytes([register, value]))
        if any(self._kept(register) != value for register, value in settings):
            raise HardwareError(
                f"{self.name}: it does not keep what is written; another chip is at this address, or its supply is bad"
            )
        if not ran:
            self._sleep(SETTLING_S)

    def _kept(self, register: int) -> int:
        return self._bus.write_read(self._address, bytes([register]), 1)[0]
