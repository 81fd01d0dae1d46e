"""The angle of an axis by an LS7366R, which counts the edges of its encoder for any speed, also while no program runs.

Knows how a count is an angle. In the chip, the count of a placed axis is the angle itself, from 0° on the rotor's own
scale, so that the next run of the program finds it. Knows no register.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.chips.ls7366r import Ls7366r, Mode
from hw.sensors.quadrature import EncoderCounter

HALF = 1 << 31


class ChipCounter(EncoderCounter):
    """Raises HardwareError."""

    def __init__(self, chip: Ls7366r, counts_per_deg: float, clock: Callable[[], float]) -> None:
        super().__init__(counts_per_deg, clock)
        self._chip = chip
        self._raw, mode = chip.look()
        self.kept_deg = self._raw / counts_per_deg if mode.is_place else None
        """The angle by the count of an earlier run, if the chip has kept it and its scale was this one."""
        if mode is Mode.RESET:
            chip.begin()

    def _take(self) -> None:
        raw, mode = self._chip.look()
        if mode is Mode.RESET:
            self.trouble = "its counter chip was without supply, and has lost the count"
            self._chip.begin()
            self._raw = 0
            return
        turned = (raw - self._raw + HALF) % (2 * HALF) - HALF
        self._raw = raw
        self._counted(turned, abs(turned))

    def _settle(self, angle_deg: float) -> None:
        self._raw = round(angle_deg * self._per_deg)
        self._chip.place(self._raw)
