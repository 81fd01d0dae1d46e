"""The MCP3208, an eight-input 12-bit converter on SPI: single readings in volts.

Knows the frame of the chip (Microchip DS21298E, sections 5.0 and 6.1). A reading is a share of the voltage at its VREF
pin: wired to the supply of the pots, it does not depend on that supply. Knows nothing of what is at its inputs.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.buses.spi import SpiBus
from hw.ports import HardwareError

CHANNELS = 8
STEPS = 4096
START_SINGLE_ENDED = 0b11 << 9
"""The start bit and SGL/DIFF, behind five leading zeros: the twelve bits of the answer then end with the third byte."""
CHANNEL_SHIFT = 6
NULL_BIT = 1 << 12
"""Low before the first bit of a conversion; a data line that no chip drives is pulled high."""

SLOWEST_FRAME_S = 0.01
"""The sample leaks away while it is clocked out. The chip keeps it for 1.2 ms at 85 °C (section 6.2); leakage halves
with every 10 K or so, so this will do for a chip at up to 50 °C."""
TRIES = 3


class Mcp3208:
    """One chip; `chip` is the name of its select line.

    `clock`: seconds, where the program clocks the frame bit by bit and may be interrupted; None: hardware clocks it.
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
        """Whether a chip is there. The kernel's SPI may read a line that no chip drives as 0. Raises HardwareError."""
        return not self._frame(0) & NULL_BIT

    def _steady(self, channel: int) -> int:
        """A frame that was clocked without a pause. Raises HardwareError."""
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
