"""The AS5045, as in the HH-12: the angle of a magnet in 12 bits, clocked out on a synchronous serial interface (SSI).

Knows the 18 bits of the answer and their parity (austriamicrosystems AS5045, section 8.1). The chip has no input: the
master's data line stays unwired. The chip latches its answer at the first falling edge of the clock and shifts at each
rising one, so SPI in mode 2, which samples at the falling edges, first sees the idle level of the data line, a 1.
"""

from __future__ import annotations

from hw.buses.spi import SpiBus
from hw.chips.magnet import GARBLED, SILENT, Magnet, MagneticEncoder, even

BITS, STATUS_BITS = 18, 6
OCF, COF, LIN = 1 << 5, 1 << 4, 1 << 3
"""Of the status: the offsets are compensated; overflow, so that the angle is an old one; not linear."""
AFTER = 24 - 1 - BITS
"""Bits of a frame of three bytes behind the answer: what comes in at the pin PDIO."""


class As5045(MagneticEncoder):
    """`chip`: the name of its select line on a bus in mode 2."""

    def __init__(self, bus: SpiBus, chip: str, *, zero_turn: float = 0.0) -> None:
        super().__init__("AS5045", 1 << 12, zero_turn)
        self._bus = bus
        self._chip = chip

    def _look(self) -> tuple[int, Magnet]:
        frame = int.from_bytes(self._bus.exchange(self._chip, bytes(3)), "big")
        if not frame >> 23 or frame == (1 << 24) - 1:
            raise self._error(SILENT)
        word = frame >> AFTER & (1 << BITS) - 1
        if not even(word):
            raise self._error(GARBLED)
        if not word & OCF:
            raise self._error("it has not finished its start; if that lasts, look at its supply")
        # MagINC and MagDEC alone tell a field that is less than ideal, and no bad angle.
        return word >> STATUS_BITS, Magnet.UNFIT if word & (COF | LIN) else Magnet.GOOD
