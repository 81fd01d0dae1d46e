"""A sketch's LiquidCrystal object on six pins of a UNO: it writes to an HD44780, four bits at a time.

Knows the controller's wake-up sequence, the order of the nibbles, and the waits: with R/W on ground it cannot read
whether the display is ready. Does not know whether a display is connected.
"""

from __future__ import annotations

from dataclasses import dataclass

from firmware_sim.arduino.uno import HIGH, LOW, PinMode, Uno

# HD44780 instructions.
CLEAR = 0x01
ENTRY_LEFT_TO_RIGHT = 0x06
DISPLAY_ON = 0x0C
FUNCTION_4_BIT_2_LINES = 0x28
SET_ADDRESS = 0x80

POWER_UP_MS = 50
"""The controller needs 40 ms from the moment its supply is good."""
WAKE_NIBBLES = ((0x3, 4500), (0x3, 4500), (0x3, 150), (0x2, 0))
"""Three times "8 bits" resets the controller from any state, then "4 bits". The second number is the wait in µs."""
CLEAR_US = 2000
SETTLE_US = 100
"""Every other instruction takes 37 µs; slow displays take longer."""
SECOND_ROW = 0x40


@dataclass(frozen=True, slots=True)
class LcdPins:
    """The UNO's pins of the display; `data` is D4, D5, D6, D7."""

    rs: int
    enable: int
    data: tuple[int, int, int, int]


class LiquidCrystal:
    """The Arduino library's object of that name, as far as the sketch uses it."""

    def __init__(self, board: Uno, pins: LcdPins) -> None:
        self._board = board
        self._pins = pins

    def begin(self) -> None:
        """Wake a display of two rows, clear it and put the cursor top left."""
        board, pins = self._board, self._pins
        for pin in (pins.rs, pins.enable, *pins.data):
            board.pin_mode(pin, PinMode.OUTPUT)
        board.delay(POWER_UP_MS)
        board.digital_write(pins.rs, LOW)
        board.digital_write(pins.enable, LOW)
        for nibble, wait_us in WAKE_NIBBLES:
            self._put_nibble(nibble)
            board.delay_microseconds(wait_us)
        self._command(FUNCTION_4_BIT_2_LINES)
        self._command(DISPLAY_ON)
        self.clear()
        self._command(ENTRY_LEFT_TO_RIGHT)

    def clear(self) -> None:
        self._command(CLEAR)
        self._board.delay_microseconds(CLEAR_US)

    def set_cursor(self, column: int, row: int) -> None:
        self._command(SET_ADDRESS | (column + SECOND_ROW * row))

    def print(self, text: str) -> None:
        """Write characters from the cursor on. Those beyond the right edge go into memory that is not shown."""
        self._board.digital_write(self._pins.rs, HIGH)
        for byte in text.encode("latin-1", "replace"):
            self._put_byte(byte)

    def _command(self, instruction: int) -> None:
        self._board.digital_write(self._pins.rs, LOW)
        self._put_byte(instruction)

    def _put_byte(self, byte: int) -> None:
        self._put_nibble(byte >> 4)
        self._put_nibble(byte & 0xF)

    def _put_nibble(self, nibble: int) -> None:
        """Put four bits on the data pins and pulse E; the display takes them when E falls."""
        board, enable = self._board, self._pins.enable
        for bit, pin in enumerate(self._pins.data):
            board.digital_write(pin, bool(nibble >> bit & 1))
        board.digital_write(enable, LOW)
        board.delay_microseconds(1)
        board.digital_write(enable, HIGH)
        board.delay_microseconds(1)
        board.digital_write(enable, LOW)
        board.delay_microseconds(SETTLE_US)
