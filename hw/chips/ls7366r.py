"""The LS7366R: a chip that counts the edges of a quadrature encoder in 32 bits, by itself.

Knows its registers and instructions on SPI in mode 0 (LSI/CSI LS7366R). Does not know what a count means, but keeps one
word about it in the chip: whether somebody has loaded the count with a place. For that it uses a bit that
halves the clock of the input filter, which makes no difference here. The chip keeps count and word without the
program, and loses both with its supply.
"""

from __future__ import annotations

from enum import IntEnum

from hw.buses.spi import SpiBus
from hw.chips.magnet import GARBLED, SILENT
from hw.ports import HardwareError

CLR_CNTR, CLR_STR, LOAD_CNTR = 0x20, 0x30, 0xE0
WR_MDR0, WR_MDR1, WR_DTR = 0x88, 0x90, 0x98
RD_MDR0, RD_CNTR, RD_OTR, RD_STR = 0x48, 0x60, 0x68, 0x70
COUNT_ENABLED, POWER_LOST = 1 << 3, 1 << 2
"""Of STR."""
NEAR = 64
"""Counts that an axis may turn on while its count is loaded, in a millisecond or two on its way home."""


class Mode(IntEnum):
    """MDR0: how the chip counts, and what it was told about its count."""

    RESET = 0x00
    """As after power-on."""
    COUNTING = 0x03
    """Four counts a period, without end."""
    PLACED = 0x83
    """The same, and the count was loaded with a place."""

    @property
    def is_place(self) -> bool:
        return self is Mode.PLACED


class Ls7366r:
    """`chip`: the name of its select line. Each method raises HardwareError."""

    def __init__(self, bus: SpiBus, chip: str) -> None:
        self._bus = bus
        self._chip = chip

    def look(self) -> tuple[int, Mode]:
        """The count, and what it is worth: RESET after the supply was gone."""
        # Reading CNTR copies it to OTR: the same count twice, because it comes without a checksum.
        count, again, mode = self._read(RD_CNTR, 4), self._read(RD_OTR, 4), self._read(RD_MDR0, 1)
        if mode not in (Mode.COUNTING, Mode.PLACED):
            status = self._read(RD_STR, 1)
            if status in (0x00, 0xFF):
                raise self._error(SILENT)
            if not status & POWER_LOST:
                raise self._error(GARBLED)
            return 0, Mode.RESET
        if count != again:
            raise self._error(GARBLED)
        return count - (count >> 31 << 32), Mode(mode)

    def begin(self) -> None:
        """Count from 0, which is no place."""
        for order in ((WR_MDR0, Mode.COUNTING), (WR_MDR1, 0), (CLR_CNTR,), (CLR_STR,)):
            self._bus.send(self._chip, bytes(order))
        if not self._read(RD_STR, 1) & COUNT_ENABLED:
            raise self._error("it does not count: wire its CNT_EN to its supply")

    def place(self, count: int) -> None:
        """Count on from here: a place."""
        data = (count % (1 << 32)).to_bytes(4, "big")
        for order in (bytes((WR_MDR0, Mode.COUNTING)), bytes((WR_DTR,)) + data, bytes((LOAD_CNTR,))):
            self._bus.send(self._chip, order)
        if abs(self.look()[0] - count) > NEAR:
            raise self._error(GARBLED)
        self._bus.send(self._chip, bytes((WR_MDR0, Mode.PLACED)))

    def _read(self, order: int, octets: int) -> int:
        return int.from_bytes(self._bus.exchange(self._chip, bytes((order, *bytes(octets))))[1:], "big")

    def _error(self, text: str) -> HardwareError:
        return HardwareError(f"LS7366R ({self._chip}): {text}")
