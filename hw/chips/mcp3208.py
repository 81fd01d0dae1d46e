"""The MCP3208, an eight-input 12-bit converter on SPI: single readings in volts.

Knows the frame of the chip (Microchip DS21298E, sections 5.0 and 6.1). A reading is a share of the voltage at the VREF
pin: with VREF on the supply of the pots, the reading does not depend on that supply. Does not know what its inputs are
wired to.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.buses.spi import SpiBus
from hw.ports import HardwareError

CHANNELS = 8
STEPS = 4096
START_SINGLE_ENDED = 0b11 << 9
"""The start bit and SGL/DIFF, after five leading zeros: the twelve bits of the answer then end with the third byte."""
CHANNEL_SHIFT = 6
NULL_BIT = 1 << 12
"""Low before the first bit of a conversion; a data line that no chip drives is pulled high."""

SLOWEST_FRAME_S = 0.01
"""The longest time for one frame, in seconds: the sampled voltage leaks away meanwhile. The chip keeps it for 1.2 ms at
85 °C (section 6.2). Leakage halves with about every 10 K, so 10 ms is short enough for a chip at up to 50 °C."""
TRIES = 3


class Mcp3208:
    """One chip; `chip` is the name of its select line.

    `clock`: seconds, where the program clocks the frame bit by bit and may be interrupted; None where hardware does.
    """

    def __init__(self, bus: SpiBus, chip: str, vref_v: float, clock: Callable[[], float] | None = None) -> None:
        self._bus = bus
        self._chip = chip
        self._vref_v = vref_v
        self._clock = clock

    def volts(self, channel: int) -> float:
        """Volts on one input against ground. Raises HardwareError when the chip does not answer in time."""
        answer = self._steady(channel)
        if answer & NULL_BIT:
            raise HardwareError("MCP3208: does not answer; look at its supply and at the wires CLK, DIN, DOUT and CS")
        return (answer & (STEPS - 1)) * self._vref_v / STEPS

    def answers(self) -> bool:
        """Whether a chip answers. The kernel's SPI may read 0 from a line without a chip. Raises HardwareError."""
        return not self._frame(0) & NULL_BIT

    def _steady(self, channel: int) -> int:
        """The answer of a frame that was clocked fast enough. Raises HardwareError."""
        if self._clock is None:
            return self._frame(channel)
        for _ in range(TRIES):
            begun_s = self._clock()
            answer = self._frame(channel)
            if self._clock() - begun_s <= SLOWEST_FRAME_S:
                return answer
        raise HardwareError(
            f"MCP3208: {TRIES} readings in turn took more than {SLOWEST_FRAME_S * 1000:.0f} ms each, too slow to be "
            'right; the computer is too busy for SPI on lines: adc.spi = "kernel"'
        )

    def _frame(self, channel: int) -> int:
        if not 0 <= channel < CHANNELS:
            raise ValueError(f"an MCP3208 has the inputs 0 to {CHANNELS - 1}, not {channel}")
        order = (START_SINGLE_ENDED | channel << CHANNEL_SHIFT) << 8
        return int.from_bytes(self._bus.exchange(self._chip, order.to_bytes(3, "big")), "big")
