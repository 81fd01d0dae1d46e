"""A simulated MCP3208: eight inputs, one 12-bit converter, clocked out bit by bit.

Knows the pins and every clock of a conversion, as Microchip DS21298E shows them (figures 5-1 and 5-2). Knows no pots
and no angles. Not simulated: noise, the limits of the clock, and the droop of a sample that is clocked out slowly.
"""

from __future__ import annotations

from collections.abc import Callable

BITS = 12
STEPS = 1 << BITS
SAMPLED_AT = 6
"""The sample ends and the null bit comes out at the falling edge of this clock. The start bit is clock 1."""
CHANNELS = 8


class Mcp3208:
    """The chip. `inputs` give the volts at CH0 to CH7 at the end of a sample; `vref_v` is the voltage at VREF."""

    def __init__(self, vref_v: float = 3.3) -> None:
        self.inputs: list[Callable[[], float]] = [lambda: 0.0] * CHANNELS
        self.vref_v = vref_v
        self.gone = False
        """Fault: the chip has no supply, and does not drive DOUT."""
        self.conversions = 0
        self._cs, self._sck = True, False
        self._clocks = 0
        """Rising edges since the start bit, which counts as 1; 0 before the start bit."""
        self._order = 0
        """The bits SGL/DIFF, D2, D1, D0 in the order of their arrival."""
        self._code = 0
        self._so: bool | None = None

    @property
    def so(self) -> bool | None:
        """The level at DOUT; None: high impedance."""
        return None if self.gone else self._so

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        """Take the levels of the pins from now on."""
        if cs or self._cs:
            # CS high ends a conversion; its falling edge begins one.
            self._clocks, self._order, self._so = 0, 0, None
        elif sck and not self._sck:
            self._rise(si)
        elif self._sck and not sck and self._clocks >= SAMPLED_AT:
            self._fall(self._clocks - SAMPLED_AT)
        self._cs, self._sck = cs, sck

    def _rise(self, si: bool) -> None:
        if self._clocks == 0 and not si:
            return  # leading zeros before the start bit
        self._clocks += 1
        if 2 <= self._clocks <= 5:
            self._order = self._order << 1 | si

    def _fall(self, place: int) -> None:
        if place == 0:
            self._code = self._convert()
            self._so = False
        elif place <= BITS:
            self._so = bool(self._code >> BITS - place & 1)
        elif place < 2 * BITS:
            self._so = bool(self._code >> place - BITS & 1)  # the code again, least significant bit first, without B0
        else:
            self._so = False

    def _convert(self) -> int:
        self.conversions += 1
        channel = self._order & 0b111
        volts = self.inputs[channel]()
        if not self._order & 0b1000:  # differential: against the other input of the pair (table 5-2)
            volts -= self.inputs[channel ^ 1]()
        return min(max(int(volts * STEPS / self.vref_v), 0), STEPS - 1)
