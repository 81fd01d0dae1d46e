"""The QMC5883L: a compass chip of three axes, on most boards that are sold as GY-271 or "HMC5883L".

Knows the chip's registers (QST QMC5883L, section 9). Does not know how the board is mounted, nor its iron. The QMC5883P
at 0x2C is another chip.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable

from hw.ports import BoardAxes, HardwareError, I2CBus

ADDRESS = 0x0D
"""Fixed."""

DATA, STATUS, CONTROL, RESET, PERIOD, CHIP_ID = 0x00, 0x06, 0x09, 0x0A, 0x0B, 0x0D

IDENTITY = 0xFF
READY, OVERFLOW = 0x01, 0x02
SOFT_RESET = 0x80
SET_AND_RESET = 0x01
"""How often it turns its own magnetism about: the data sheet wants 1."""
CONTINUOUS_50_HZ_2_G = 0x05
"""With 512 samples in a result, the quietest setting."""
STEPS_PER_UT = 120
"""12000 a gauss at ±2 G; a gauss is 100 µT."""
SETTLING_S = 0.05
STALE_S = 0.1
"""A chip that measures has a new result every 20 ms."""


class Qmc5883l:
    """One chip as a `hw.ports.Magnetometer`. `clock` gives seconds; `sleep` waits while it starts."""

    def __init__(
        self, bus: I2CBus, clock: Callable[[], float], sleep: Callable[[float], None], address: int = ADDRESS
    ) -> None:
        self.name = f"QMC5883L at 0x{address:02x}"
        self._bus = bus
        self._clock = clock
        self._sleep = sleep
        self._address = address
        self._latest: tuple[float, BoardAxes] | None = None
        """The moment of the latest result, and the result; None: it has to be set up."""

    def field_ut(self) -> BoardAxes:
        try:
            self._latest = self._measured(*(self._latest or self._begin()))
        except HardwareError:
            self._latest = None
            raise
        return self._latest[1]

    def _measured(self, since_s: float, before: BoardAxes) -> tuple[float, BoardAxes]:
        now_s = self._clock()
        # The status first, in the same transfer: the read of the data clears READY.
        (status, *_), result = self._bus.read_each(self._address, [STATUS, DATA], 6)
        if not status & READY:
            if now_s - since_s <= STALE_S:
                return since_s, before
            raise self._error("it measures nothing; check its 3.3 V, and its cable for breaks")
        x, y, z = struct.unpack("<hhh", result)
        if status & OVERFLOW:
            raise self._error("the field is above 200 µT, four times the earth's; a magnet or a motor is too near")
        return now_s, (x / STEPS_PER_UT, y / STEPS_PER_UT, z / STEPS_PER_UT)

    def _begin(self) -> tuple[float, BoardAxes]:
        if (identity := self._bus.write_read(self._address, bytes([CHIP_ID]), 1)[0]) != IDENTITY:
            raise self._error(
                f"the chip's identity is 0x{identity:02x}, a QMC5883L has 0xff; another chip is at this address"
            )
        for register, value in ((RESET, SOFT_RESET), (PERIOD, SET_AND_RESET), (CONTROL, CONTINUOUS_50_HZ_2_G)):
            self._bus.write(self._address, bytes([register, value]))
        self._sleep(SETTLING_S)
        return -math.inf, (0.0, 0.0, 0.0)

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"{self.name}: {text}")
