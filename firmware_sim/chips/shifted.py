"""A simulated chip on SPI or SSI that puts out a bit where the clock rises, and takes one where it falls.

Knows select, clock and data lines, and two faults: no supply, and sparks that turn bits of its answers. Knows no
answer.
"""

from __future__ import annotations

import random

from firmware_sim.sporadic import Sporadic


class Shifted:
    latches_at_fall = False
    """The answer is fixed, and its first bit follows, after the clock's first falling edge; False: when selected."""

    def __init__(self) -> None:
        self.gone = False
        """Fault: no supply, and nobody drives the data line."""
        self.sparks = Sporadic(chance=random.Random(18))
        """Fault: one bit of the answer is turned."""
        self._cs, self._sck = True, True
        self._so: bool | None = None
        self._word: int | None = None
        self._left = self._taken = self._count = 0
        self._dice = random.Random(24)

    def answer(self) -> tuple[int, int]:
        """The word that it puts out now, and the number of its bits."""
        raise NotImplementedError

    def took(self, word: int, bits: int) -> None:
        """What came in, once the chip is no longer selected."""

    @property
    def so(self) -> bool | None:
        """The level of the data output; None: high impedance."""
        return None if self.gone else self._so

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        """Take the levels of the pins from now on."""
        if cs != self._cs:
            self._released() if cs else self._selected()
        elif not cs and sck and not self._sck:
            self._rise()
        elif not cs and self._sck and not sck:
            self._fall(si)
        self._cs, self._sck = cs, sck

    def _selected(self) -> None:
        self._word, self._so, self._taken, self._count = None, True, 0, 0
        if not self.latches_at_fall:
            self._latch()

    def _released(self) -> None:
        self._so = None
        if not self.gone:
            self.took(self._taken, self._count)

    def _latch(self) -> None:
        self._word, self._left = self.answer()
        if self.sparks.strikes():
            self._word ^= 1 << self._dice.randrange(self._left)

    def _rise(self) -> None:
        if self._word is not None:
            self._left -= 1
            self._so = self._left >= 0 and bool(self._word >> self._left & 1)

    def _fall(self, si: bool) -> None:
        if self._word is None:
            self._latch()
        self._taken, self._count = self._taken << 1 | si, self._count + 1
