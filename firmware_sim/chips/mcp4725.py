"""A simulated MCP4725: the converter's register, its EEPROM, and the voltage that follows.

Knows the write commands and the read-back of Microchip DS22039D, sections 6.1 to 6.3, and one fault: an interruption
of the supply, after which it wakes with what its EEPROM holds. Does not know what its output is wired to. Not
simulated: the time that the EEPROM takes, and the load at the output.
"""

from __future__ import annotations

from collections.abc import Callable

from firmware_sim.buses.i2c import Nack

AS_SOLD = 0x800
READY = 0x80


class Mcp4725:
    """The chip. It calls `changed` after its output has changed."""

    def __init__(self) -> None:
        self.changed: Callable[[], None] = lambda: None
        self._code, self._power_down = AS_SOLD, 0
        self._kept = AS_SOLD, 0
        self.kept_writes = 0
        """How often its EEPROM was written, which wears out."""

    @property
    def share(self) -> float:
        """Its output, as a share of its supply. In power-down a resistor pulls it to ground."""
        return 0.0 if self._power_down else self._code / 4096

    def power_on(self) -> None:
        """Fault: its supply was interrupted."""
        self._code, self._power_down = self._kept
        self.changed()

    def write(self, data: bytes) -> None:
        if not data:
            return  # only the address: is it there?
        match data[0] >> 6:
            case 0b00 if len(data) >= 2:  # the fast command; each two bytes more are the next one
                first, second = data[len(data) // 2 * 2 - 2 :][:2]
                self._set((first & 0x0F) << 8 | second, first >> 4 & 0b11)
            case 0b01 if len(data) >= 3:
                self._set(data[1] << 4 | data[2] >> 4, data[0] >> 1 & 0b11)
                if data[0] & 0x20:
                    self._kept = self._code, self._power_down
                    self.kept_writes += 1
            case _:
                raise Nack

    def read(self, count: int) -> bytes:
        code, (kept, kept_down) = self._code, self._kept
        status = READY | 0x40 | self._power_down << 1
        answer = bytes([status, code >> 4, code << 4 & 0xFF, kept_down << 5 | kept >> 8, kept & 0xFF])
        return (answer * count)[:count]

    def _set(self, code: int, power_down: int) -> None:
        self._code, self._power_down = code, power_down
        self.changed()
