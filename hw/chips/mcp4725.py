"""The MCP4725, a digital-to-analog converter of 12 bits on I2C.

Knows the chip's commands (Microchip DS22039D, sections 6.1 and 6.2), and that its EEPROM holds the voltage with which
it wakes: half its supply, as it is sold. Does not know what the voltage is for.
"""

from __future__ import annotations

from hw.ports import I2CBus

FULL = 0xFFF
_KEEP = 0x60
"""Write the converter and the EEPROM; the fast command without it begins with four zeros."""
_ANSWER = 5
"""Status, the converter in two bytes, the EEPROM in two bytes."""


class Mcp4725:
    """One chip on `bus`. `wakes`: the share of its supply with which it is to wake after a power cut.

    Raises HardwareError when the chip does not answer.
    """

    def __init__(self, bus: I2CBus, address: int, wakes: float) -> None:
        self._bus = bus
        self._address = address
        code = _code(wakes)
        kept = bus.write_read(address, bytes([code >> 8, code & 0xFF]), _ANSWER)
        if (kept[3] & 0x0F) << 8 | kept[4] != code or kept[3] & 0x60:
            bus.write(address, bytes([_KEEP, code >> 4, code << 4 & 0xFF]))

    def duty(self, share: float) -> None:
        """The voltage, as a share of the chip's supply. Raises HardwareError."""
        code = _code(share)
        self._bus.write(self._address, bytes([code >> 8, code & 0xFF]))


def _code(share: float) -> int:
    return round(min(max(share, 0.0), 1.0) * FULL)
