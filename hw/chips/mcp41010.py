"""The MCP41010, a 10 kΩ potentiometer of 256 steps on SPI.

Knows the chip's commands (Microchip DS11195C, figure 5-2). The chip cannot be read, and after power-on it is in the
middle, at step 128. Does not know what its wiper is wired to.
"""

from __future__ import annotations

from hw.buses.spi import SpiBus

STEPS = 256
_WRITE = 0x11


class Mcp41010:
    """One chip on `bus`; `chip` is the name of its select line."""

    def __init__(self, bus: SpiBus, chip: str) -> None:
        self._bus = bus
        self._chip = chip

    def write(self, step: int) -> None:
        """Put the wiper on a step, 0 to 255: step/256 of the resistance from B to A.

        Raises ValueError for another step, HardwareError when the lines cannot be set.
        """
        if not 0 <= step < STEPS:
            raise ValueError(f"a wiper has the steps 0 to {STEPS - 1}, not {step}")
        self._bus.send(self._chip, bytes([_WRITE, step]))
