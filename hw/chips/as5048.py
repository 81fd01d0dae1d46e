"""The AS5048A on SPI and the AS5048B on I2C: the angle of a magnet in 14 bits.

Knows the chip's registers, its diagnostic flags and the frames on SPI with their parity (ams AS5048, "SPI Interface",
"I2C Interface", "Register Description"). The driver writes no register, so that it never burns the zero position.
"""

from __future__ import annotations

from hw.buses.spi import SpiBus
from hw.chips.magnet import GARBLED, SILENT, Magnet, MagneticEncoder, even
from hw.ports import I2CBus

ADDRESS = 0x40
STEPS = 1 << 14
COMP_HIGH, COMP_LOW, COF, OCF = 1 << 3, 1 << 2, 1 << 1, 1 << 0
"""Diagnostics. The gain is at its highest, for a weak field; at its lowest; overflow; the offsets are compensated."""

READ_ANGLE, READ_DIAGNOSTICS, CLEAR_ERROR = 0xFFFF, 0x7FFD, 0x4001
"""Orders on SPI: even parity, the read bit, and the register 0x3FFF, 0x3FFD or 0x0001."""
ERROR = 1 << 14
"""In an answer on SPI: a frame to the chip was bad. It stays until it is cleared."""
REG_DIAGNOSTICS, REG_ANGLE = 0xFB, 0xFE


class _As5048(MagneticEncoder):
    def _judged(self, angle: int, diagnostics: int) -> tuple[int, Magnet]:
        """Both in the chip's own bits. Raises HardwareError."""
        if diagnostics & COMP_HIGH and diagnostics & COMP_LOW:
            raise self._error(GARBLED)
        if not diagnostics & OCF:
            raise self._error("it has not finished its start; if that lasts, look at its supply and its wires")
        if diagnostics & (COF | COMP_LOW):
            return angle, Magnet.STRONG
        return angle, Magnet.FAINT if diagnostics & COMP_HIGH else Magnet.GOOD


class As5048a(_As5048):
    """`chip`: the name of its select line on a bus in mode 1."""

    def __init__(self, bus: SpiBus, chip: str, *, zero_turn: float = 0.0) -> None:
        super().__init__("AS5048A", STEPS, zero_turn)
        self._bus = bus
        self._chip = chip

    def _look(self) -> tuple[int, Magnet]:
        # A frame brings the answer to the one before it; the answer to the first is to a frame of the last reading.
        self._exchange(READ_ANGLE)
        words = self._exchange(READ_DIAGNOSTICS), self._exchange(READ_ANGLE)
        if set(words) <= {0, 0xFFFF}:
            raise self._error(SILENT)
        if any(word & ERROR or not even(word) for word in words):
            self._exchange(CLEAR_ERROR)
            raise self._error(GARBLED)
        return self._judged(words[0] & STEPS - 1, words[1] >> 8 & 0xF)

    def _exchange(self, word: int) -> int:
        return int.from_bytes(self._bus.exchange(self._chip, word.to_bytes(2, "big")), "big")


class As5048b(_As5048):
    def __init__(self, bus: I2CBus, address: int = ADDRESS, *, zero_turn: float = 0.0) -> None:
        super().__init__(f"AS5048B at 0x{address:02x}", STEPS, zero_turn)
        self._bus = bus
        self._address = address

    def _look(self) -> tuple[int, Magnet]:
        high, low = self._bus.write_read(self._address, bytes([REG_ANGLE]), 2)
        diagnostics = self._bus.write_read(self._address, bytes([REG_DIAGNOSTICS]), 1)[0]
        if low > 0x3F or diagnostics > 0xF:
            raise self._error(GARBLED)
        return self._judged(high << 6 | low, diagnostics)
