"""A simulated PCF8574 port expander, and the backpack with one behind a character LCD.

Knows the byte on its eight pins, and which LCD pin is wired to which of them. Knows no time: the bus delivers each byte
at its moment. Does not know what the LCD does with its pins. Not simulated: the interrupt output, and reading the LCD
through the backpack.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from firmware_sim.chips.hd44780 import Hd44780

POWER_ON = 0xFF


class Pcf8574:
    """The expander puts each written byte on its pins at the byte's ACK, and calls `on_change` with a changed byte."""

    bytewise = True

    def __init__(self, on_change: Callable[[int], None] = lambda port: None) -> None:
        self.on_change = on_change
        self.port = POWER_ON
        self.inputs = 0xFF
        """Levels from outside: a 0 pulls that pin low. A written 1 is only weakly high: the pin is an input."""

    def write(self, data: bytes) -> None:
        for value in data:
            if value != self.port:
                self.port = value
                self.on_change(value)

    def read(self, count: int) -> bytes:
        return bytes([self.port & self.inputs]) * count


class Backpack:
    """An expander soldered to an LCD. Attach `expander` to the bus; give the LCD the bus's `wire_time`.

    `pin_map` gives the expander's bit for rs, rw, e, d4, d5, d6, d7 and bl. Without rw the LCD's R/W pin is grounded;
    without bl the backlight is always on.
    """

    def __init__(self, lcd: Hd44780, pin_map: Mapping[str, int], backlight_active_high: bool = True) -> None:
        self.lcd = lcd
        self.expander = Pcf8574(self._wires)
        self._pin_map = dict(pin_map)
        self._backlight_active_high = backlight_active_high
        self._wires(self.expander.port)

    @property
    def backlight(self) -> bool:
        """Whether the backlight is on."""
        return "bl" not in self._pin_map or self._high("bl", self.expander.port) == self._backlight_active_high

    def _wires(self, port: int) -> None:
        self.lcd.pins(
            rs=self._high("rs", port),
            rw="rw" in self._pin_map and self._high("rw", port),
            e=self._high("e", port),
            d4=self._high("d4", port),
            d5=self._high("d5", port),
            d6=self._high("d6", port),
            d7=self._high("d7", port),
        )

    def _high(self, pin: str, port: int) -> bool:
        return bool(port >> self._pin_map[pin] & 1)
