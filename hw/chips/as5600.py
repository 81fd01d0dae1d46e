"""The AS5600 and AS5600L: the angle of a magnet above the chip, as a share of one turn.

Knows the chip's registers and its magnet flags (ams AS5600, "Register Description"). Does not know gears: when the
magnet turns more than once over the axis's range, the reading repeats. The driver writes register
addresses only, so that it can never burn a chip's settings by accident.
"""

from __future__ import annotations

from hw.ports import AngleSource, HardwareError, I2CBus

ADDRESS = 0x36

STATUS = 0x0B
RAW_ANGLE = 0x0C
"""The driver does not read ANGLE at 0x0E, because settings burned into the chip change the range of that register."""

MAGNET_DETECTED = 1 << 5
MAGNET_WEAK = 1 << 4
MAGNET_STRONG = 1 << 3
STEPS = 4096


class As5600:
    """One chip as a `hw.ports.AngleSensor`. `zero_turn`, 0 to 1, is where the reading jumps from 1 to 0: set it outside
    the axis's range. A calibration is valid for one `zero_turn` only.
    """

    source = AngleSource.MEASURED

    def __init__(self, bus: I2CBus, address: int = ADDRESS, *, zero_turn: float = 0.0) -> None:
        self._bus = bus
        self._address = address
        self._zero_turn = zero_turn

    def read(self) -> float:
        """The share of a turn, 0 up to 1, in steps of 1/4096.

        Raises HardwareError when the chip does not answer, or reports no good magnet.
        """
        # The status is read second, so that it is valid for the angle read before it.
        angle = int.from_bytes(self._bus.write_read(self._address, bytes([RAW_ANGLE]), 2), "big")
        status = self._bus.write_read(self._address, bytes([STATUS]), 1)[0]
        self._check(angle, status)
        return (angle / STEPS - self._zero_turn) % 1.0

    def _check(self, angle: int, status: int) -> None:
        weak, strong = bool(status & MAGNET_WEAK), bool(status & MAGNET_STRONG)
        if angle >= STEPS or (weak and strong):
            raise self._error(
                f"the answer makes no sense (angle 0x{angle:04x}, status 0x{status:02x}); "
                "shorten the I2C cable, and check that nothing else has this address"
            )
        if not status & MAGNET_DETECTED:
            raise self._error("there is no magnet; put one over the middle of the chip, 0.5 to 3 mm away")
        if weak:
            raise self._error("the magnet is too weak or too far; bring it nearer, or take one magnetized across")
        if strong:
            raise self._error("the magnet is too strong or too near; move it away a little")

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"AS5600 at 0x{self._address:02x}: {text}")
