"""HD44780 character displays, on six GPIO lines or behind a PCF8574 backpack.

Knows the controller's instructions and times (Hitachi ADE-207-272, table 6) and both connections to its pins. Does not
know what the text means. RW is tied to ground on the usual boards, so the driver waits in place of reading the busy
flag.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

from hw.ports import I2CBus, OutputLines

CLEAR = 0x01
ENTRY_LEFT_TO_RIGHT = 0x06
DISPLAY_ON = 0x0C
FOUR_BITS_TWO_LINES = 0x28
SET_ADDRESS = 0x80
ROW_ADDRESS = (0x00, 0x40)

POWER_UP_S = 0.05
FIRST_WAKE_S = 0.0045
WAKE_S = 0.00015
CLEAR_S = 0.002
INSTRUCTION_S = 50e-6

ROM_A00 = {"°": 0xDF, "→": 0x7E, "←": 0x7F}
"""The codes of these characters in the usual character ROM, A00."""


class NibblePort(Protocol):
    """The connection to the display's pins."""

    def send(self, register_select: bool, nibbles: Sequence[int]) -> None:
        """Clock each nibble into D4 to D7, and wait for the time of an instruction after each pair.

        `register_select` is the RS pin: False for instructions, True for characters. Raises HardwareError.
        """


class GpioPort:
    """RS, E, D4 to D7 on six output lines named rs, e, d4, d5, d6, d7."""

    def __init__(self, lines: OutputLines, sleep: Callable[[float], None]) -> None:
        self._lines = lines
        self._sleep = sleep

    def send(self, register_select: bool, nibbles: Sequence[int]) -> None:
        for count, nibble in enumerate(nibbles, 1):
            # RS and data must be stable from 40 ns before E rises until it has fallen: they change in a separate call.
            data = {f"d{4 + bit}": bool(nibble >> bit & 1) for bit in range(4)}
            self._lines.set({"rs": register_select, "e": False} | data)
            self._lines.set({"e": True})
            self._lines.set({"e": False})
            if count % 2 == 0 or len(nibbles) == 1:
                self._sleep(INSTRUCTION_S)


BACKPACKS: dict[str, dict[str, int]] = {
    "ywrobot": {"rs": 0, "rw": 1, "e": 2, "bl": 3, "d4": 4, "d5": 5, "d6": 6, "d7": 7},
    "lcm1602": {"rs": 0, "rw": 1, "e": 2, "bl": 3, "d4": 4, "d5": 5, "d6": 6, "d7": 7},
    "mjkdz": {"rs": 6, "rw": 5, "e": 4, "bl": 7, "d4": 0, "d5": 1, "d6": 2, "d7": 3},
    "lcdxio": {"rs": 4, "rw": 5, "e": 6, "bl": 7, "d4": 0, "d5": 1, "d6": 2, "d7": 3},
    "swapped": {"rs": 2, "rw": 1, "e": 0, "bl": 3, "d4": 4, "d5": 5, "d6": 6, "d7": 7},
}
"""For each kind of board: the bit of the PCF8574 for each pin. Nearly every board is a `ywrobot`."""
BACKLIGHT_ACTIVE_LOW = frozenset({"lcm1602", "mjkdz", "lcdxio"})
"""Boards with a backlight that is on while its bit is 0."""


class BackpackPort:
    """A PCF8574 at `address`. A byte sets all eight outputs; at 100 kHz it takes 90 µs, longer than an instruction."""

    def __init__(self, bus: I2CBus, address: int, pins: Mapping[str, int], *, backlight_active_low: bool) -> None:
        self._bus = bus
        self._address = address
        self._pins = pins
        self._idle = 0 if backlight_active_low else 1 << pins["bl"]
        self._register_select: bool | None = None

    def send(self, register_select: bool, nibbles: Sequence[int]) -> None:
        base = self._idle | (register_select << self._pins["rs"])
        enable = 1 << self._pins["e"]
        data = bytearray()
        if register_select != self._register_select:
            # RS must be stable before E rises.
            data.append(base)
            self._register_select = register_select
        for nibble in nibbles:
            byte = base | sum((nibble >> bit & 1) << self._pins[f"d{4 + bit}"] for bit in range(4))
            data += bytes((byte | enable, byte))
        self._bus.write(self._address, bytes(data))


class Hd44780:
    """A display of `columns` by `rows` characters, as a `hw.ports.CharacterDisplay`."""

    def __init__(self, port: NibblePort, sleep: Callable[[float], None], *, columns: int = 16, rows: int = 2) -> None:
        self._port = port
        self._sleep = sleep
        self._columns = columns
        self._rows = rows

    def reset(self) -> None:
        """Bring the controller to four-bit mode from any state, also from half a received byte, and clear it.

        Raises HardwareError.
        """
        self._sleep(POWER_UP_S)
        self._port.send(False, [0x3])
        self._sleep(FIRST_WAKE_S)
        self._port.send(False, [0x3])
        self._sleep(WAKE_S)
        self._port.send(False, [0x3])
        self._sleep(WAKE_S)
        self._port.send(False, [0x2])
        self._sleep(WAKE_S)
        self._bytes(False, [FOUR_BITS_TWO_LINES, ENTRY_LEFT_TO_RIGHT, DISPLAY_ON, CLEAR])
        self._sleep(CLEAR_S)

    def show(self, rows: Sequence[str]) -> None:
        for row, address in zip(rows[: self._rows], ROW_ADDRESS, strict=False):
            text = row[: self._columns].ljust(self._columns)
            self._bytes(False, [SET_ADDRESS | address])
            self._bytes(True, [self._glyph(character) for character in text])

    def _bytes(self, register_select: bool, data: Sequence[int]) -> None:
        self._port.send(register_select, [nibble for byte in data for nibble in (byte >> 4, byte & 0xF)])

    def _glyph(self, character: str) -> int:
        if character in ROM_A00:
            return ROM_A00[character]
        return ord(character) if " " <= character <= "}" and character != "\\" else ord("?")
