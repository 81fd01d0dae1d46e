"""The AS5600 and AS5600L: the angle of a magnet above the chip, as a share of one turn.

Knows the chip's registers and its magnet flags (ams AS5600, "Register Description"). The driver writes register
addresses only, so that it can never burn a chip's settings by accident.
"""

from __future__ import annotations

from hw.chips.magnet import Magnet, MagneticEncoder
from hw.ports import I2CBus

ADDRESS = 0x36

STATUS = 0x0B
RAW_ANGLE = 0x0C
"""The driver does not read ANGLE at 0x0E, because settings burned into the chip change the range of that register."""

MAGNET_DETECTED = 1 << 5
MAGNET_WEAK = 1 << 4
MAGNET_STRONG = 1 << 3
STEPS = 4096


class As5600(MagneticEncoder):
    def __init__(self, bus: I2CBus, address: int = ADDRESS, *, zero_turn: float = 0.0) -> None:
        super().__init__(f"AS5600 at 0x{address:02x}", STEPS, zero_turn)
        self._bus = bus
        self._address = address

    def _look(self) -> tuple[int, Magnet]:
        # The status is read second, so that it is valid for the angle read before it.
        angle = int.from_bytes(self._bus.write_read(self._address, bytes([RAW_ANGLE]), 2), "big")
        status = self._bus.write_read(self._address, bytes([STATUS]), 1)[0]
        weak, strong = bool(status & MAGNET_WEAK), bool(status & MAGNET_STRONG)
        if angle >= STEPS or (weak and strong):
            raise self._error(
                f"the answer makes no sense (angle 0x{angle:04x}, status 0x{status:02x}); "
                "shorten the I2C cable, and check that nothing else has this address"
            )
        if not status & MAGNET_DETECTED:
            return angle, Magnet.MISSING
        return angle, Magnet.WEAK if weak else Magnet.STRONG if strong else Magnet.GOOD
