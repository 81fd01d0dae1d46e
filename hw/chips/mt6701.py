"""The MT6701: the angle of a magnet in 14 bits, by I2C, or by a synchronous serial interface (SSI) with a checksum.

Knows both answers (MagnTek MT6701, "I2C Interface" and "SSI Interface"). The registers hold no word about the magnet:
only SSI tells a magnet that cannot be relied on. The driver writes no register.
"""

from __future__ import annotations

from hw.buses.spi import SpiBus
from hw.chips.magnet import GARBLED, SILENT, Magnet, MagneticEncoder
from hw.ports import I2CBus

ADDRESS = 0x06
STEPS = 1 << 14
REG_ANGLE = 0x03
"""Bits 13 to 6, and in the upper bits of the next register 5 to 0."""
FIELD, TRACK_LOST = 0b11, 1 << 3
"""Of the four bits of status: 0 for a field within its range; the magnet turned too fast."""
AFTER = 32 - 1 - 24
"""The chip shifts at each rising edge of the clock, so that in mode 2 a bit without meaning comes first."""


class Mt6701(MagneticEncoder):
    """On I2C."""

    def __init__(self, bus: I2CBus, address: int = ADDRESS, *, zero_turn: float = 0.0) -> None:
        super().__init__(f"MT6701 at 0x{address:02x}", STEPS, zero_turn)
        self._bus = bus
        self._address = address

    def _look(self) -> tuple[int, Magnet]:
        return int.from_bytes(self._bus.write_read(self._address, bytes([REG_ANGLE]), 2), "big") >> 2, Magnet.GOOD


class Mt6701Ssi(MagneticEncoder):
    """`chip`: the name of its select line on a bus in mode 2.

    The checksum of all zeros is zero: an angle of exactly 0 looks like a broken wire, and is taken for one.
    """

    def __init__(self, bus: SpiBus, chip: str, *, zero_turn: float = 0.0) -> None:
        super().__init__("MT6701", STEPS, zero_turn)
        self._bus = bus
        self._chip = chip

    def _look(self) -> tuple[int, Magnet]:
        word = int.from_bytes(self._bus.exchange(self._chip, bytes(4)), "big") >> AFTER & 0xFFFFFF
        if word in (0, 0xFFFFFF):
            raise self._error(SILENT)
        if crc6(word >> 6) != word & 0x3F:
            raise self._error(GARBLED)
        status = word >> 6 & 0xF
        if status & TRACK_LOST:
            raise self._error("the magnet turned too fast for the chip: on the axis itself it does not; or a spark")
        return word >> 10, Magnet.UNFIT if status & FIELD else Magnet.GOOD


def crc6(bits: int) -> int:
    """The checksum over the 18 bits of angle and status: x⁶ + x + 1, from 0."""
    rest = bits << 6
    for place in range(23, 5, -1):
        if rest >> place & 1:
            rest ^= 0b1000011 << place - 6
    return rest
