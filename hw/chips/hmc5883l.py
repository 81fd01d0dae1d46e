"""The HMC5883L, and the compass in an LSM303DLHC, which has its registers: compass chips of three axes.

Knows their registers (Honeywell HMC5883L; ST LSM303DLHC, section 7.2) and where the two differ. Does not know how the
board is mounted, nor its iron.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass

from hw.ports import BoardAxes, HardwareError, I2CBus

ADDRESS = 0x1E
"""Fixed, for both."""

SETTINGS, DATA, STATUS, IDENTITY = 0x00, 0x03, 0x09, 0x0A

NAMED = b"H43"
READY = 0x01
GAIN_130_UT, CONTINUOUS = 0x20, 0x00
OVERFLOW = -4096
SETTLING_S = 0.05
"""Three results at 75 Hz: the first after a change of the gain still has the old one."""


@dataclass(frozen=True, slots=True)
class Part:
    """What differs. `rate`: configuration register A for 75 results a second."""

    name: str
    rate: int
    steps_per_gauss: BoardAxes


HMC5883L = Part("HMC5883L", 0x78, (1090, 1090, 1090))
"""With the mean of eight samples in each result."""
LSM303DLHC = Part("LSM303DLHC", 0x18, (1100, 1100, 980))


class Hmc5883l:
    """One chip as a `hw.ports.Magnetometer`. `sleep` waits while it starts."""

    def __init__(
        self, bus: I2CBus, sleep: Callable[[float], None], address: int = ADDRESS, part: Part = HMC5883L
    ) -> None:
        self.name = f"{part.name} at 0x{address:02x}"
        self._bus = bus
        self._sleep = sleep
        self._address = address
        self._part = part
        self._settings = bytes([part.rate, GAIN_130_UT, CONTINUOUS])

    def field_ut(self) -> BoardAxes:
        settings, result = self._result()
        if settings != self._settings:  # after a dip of its supply it idles, with settings of its own
            self._begin()
            _, result = self._result()
        x, z, y = struct.unpack(">hhh", result)  # in this order
        if OVERFLOW in (x, y, z):
            raise self._error("the field is above 130 µT, twice the earth's; a magnet or a motor is too near")
        ut_x, ut_y, ut_z = (100.0 * at / steps for at, steps in zip((x, y, z), self._part.steps_per_gauss, strict=True))
        return ut_x, ut_y, ut_z

    def _begin(self) -> None:
        if (named := self._read(IDENTITY, 3)) != NAMED:
            raise self._error(
                f"the chip calls itself {named!r}, this one is b'H43'; a board with a QMC5883L answers at 0x0d, "
                "and other LSM303 are other chips"
            )
        for register, value in enumerate(self._settings):
            self._bus.write(self._address, bytes([register, value]))
        self._sleep(SETTLING_S)
        if self._result()[0] != self._settings or not self._read(STATUS, 1)[0] & READY:
            raise self._error("it does not keep what is written, or measures nothing; switch its power off and on")

    def _result(self) -> tuple[bytes, bytes]:
        """Its settings and its latest result, of one moment: in one transfer."""
        registers = self._read(SETTINGS, 9)
        return registers[:DATA], registers[DATA:]

    def _read(self, register: int, count: int) -> bytes:
        return self._bus.write_read(self._address, bytes([register]), count)

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"{self.name}: {text}")
