"""A simulated HD44780 character LCD at its pins: RS, RW, E, D4 to D7.

Knows the instruction set (Hitachi ADE-207-272), the nibbles, the busy time of each instruction, and the text on the
glass. Does not know which circuit drives its pins. D0 to D3 are open and count as 0. Not simulated: reading (RW high),
the cursor, the 5x10 font, and the set-up times of RS and data.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

POWER_UP_S = 15e-3
FIRST_FUNCTION_SETS_S = (4.1e-3, 100e-6)  # "initializing by instruction": the first two take longer
INSTRUCTION_S = 37e-6
DATA_S = 37e-6 + 4e-6  # the address counter moves 4 µs after the data is in
CLEAR_OR_HOME_S = 1.52e-3
E_HIGH_MIN_S = 450e-9

WRAPS_TWO_LINES = {(0x27, 1): 0x40, (0x67, 1): 0x00, (0x40, -1): 0x27, (0x00, -1): 0x67}
WRAPS_ONE_LINE = {(0x4F, 1): 0x00, (0x00, -1): 0x4F}

BLANK = 0x20
CUSTOM_GLYPHS = "⓪①②③④⑤⑥⑦"  # one circled digit for each custom character: none is in the ROM
ROM_A00 = {0x5C: "¥", 0x7E: "→", 0x7F: "←", 0xDF: "°", 0xE4: "µ", 0xF4: "Ω", 0xF7: "π", 0xFD: "÷", 0xFF: "█"}


@dataclass(frozen=True, slots=True)
class _Pins:
    rs: bool
    rw: bool
    e: bool
    nibble: int


class Hd44780:
    """The display. Call `pins` when a pin changes; read the glass with `text`.

    The chip takes the levels from just before E fell. A byte that drops E and changes the data at the same time is
    therefore harmless, as on the real chip.
    """

    def __init__(self, clock: Callable[[], float], columns: int = 16, rows: int = 2) -> None:
        self.columns = columns
        self.rows = rows
        self.busy_violations = 0
        """Number of instructions and data bytes that came while the chip was busy and so were lost."""
        self.short_pulses = 0
        """Number of E pulses shorter than 450 ns. They work. Not counted: 0 s, where the clock stood still."""
        self.display_on = False
        self.cgram = bytearray(64)
        self._clock = clock
        self._busy_until_s = clock() + POWER_UP_S
        self._slow_function_sets = list(FIRST_FUNCTION_SETS_S)
        self._pins = _Pins(False, False, False, 0)
        self._e_rose_at_s = 0.0
        self._four_bit = False
        self._high_nibble: int | None = None
        self._lost = False
        self._two_lines = False
        self._ddram = bytearray([BLANK]) * 0x80  # 80 bytes are real: 0x00-0x27 and 0x40-0x67, or 0x00-0x4F
        self._address = 0
        self._in_cgram = False
        self._step = 1
        self._shift_on_write = False
        self._shift = 0

    @property
    def violations(self) -> int:
        return self.busy_violations + self.short_pulses

    def pins(  # noqa: PLR0917 - one argument a pin
        self, rs: bool, e: bool, d4: bool, d5: bool, d6: bool, d7: bool, rw: bool = False
    ) -> None:
        before, now_s = self._pins, self._clock()
        self._pins = _Pins(rs, rw, e, d4 | d5 << 1 | d6 << 2 | d7 << 3)
        if e and not before.e:
            self._e_rose_at_s = now_s
        elif before.e and not e:
            if 0.0 < now_s - self._e_rose_at_s < E_HIGH_MIN_S:
                self.short_pulses += 1
            if not before.rw:
                self._latch(before.rs, before.nibble, now_s)

    def text(self) -> tuple[str, ...]:
        """The text on the glass, row by row. A custom character shows as its number in a circle, U+24EA to U+2466."""
        return tuple(self._row(row) for row in range(self.rows))

    def glyph(self, code: int) -> tuple[int, ...]:
        """The eight rows of custom character `code` (0-7), five dots each, the leftmost dot in bit 4."""
        return tuple(self.cgram[code * 8 : code * 8 + 8])

    # --- the interface: nibbles to bytes

    def _latch(self, rs: bool, nibble: int, now_s: float) -> None:
        if not self._four_bit:
            self._take(rs, nibble << 4, now_s, lost=self._busy(now_s))
        elif self._high_nibble is None:
            self._high_nibble, self._lost = nibble, self._busy(now_s)
        else:
            value, self._high_nibble = self._high_nibble << 4 | nibble, None
            self._take(rs, value, now_s, lost=self._lost)

    def _busy(self, now_s: float) -> bool:
        return now_s < self._busy_until_s

    def _take(self, rs: bool, value: int, now_s: float, *, lost: bool) -> None:
        if lost:
            self.busy_violations += 1
        elif rs:
            self._store(value)
            self._busy_until_s = now_s + DATA_S
        else:
            self._busy_until_s = now_s + self._execute(value)

    # --- the instruction set: the highest set bit selects the instruction

    def _execute(self, value: int) -> float:
        """Carry out an instruction. Returns how long the chip is busy with it, in seconds."""
        busy_s = INSTRUCTION_S
        match value.bit_length():
            case 8:
                self._address, self._in_cgram = value & 0x7F, False
            case 7:
                self._address, self._in_cgram = value & 0x3F, True
            case 6:
                if value & 0x10 and self._slow_function_sets:
                    busy_s = self._slow_function_sets.pop(0)
                self._four_bit, self._two_lines = not value & 0x10, bool(value & 0x08)
            case 5:
                step = 1 if value & 0x04 else -1
                if value & 0x08:
                    self._shift -= step
                else:
                    self._move(step)
            case 4:
                self.display_on = bool(value & 0x04)
            case 3:
                self._step, self._shift_on_write = 1 if value & 0x02 else -1, bool(value & 0x01)
            case 2:
                self._home()
                busy_s = CLEAR_OR_HOME_S
            case 1:
                self._ddram[:] = bytes([BLANK]) * len(self._ddram)
                self._home()
                self._step = 1
                busy_s = CLEAR_OR_HOME_S
        return busy_s

    def _home(self) -> None:
        self._address, self._in_cgram, self._shift = 0, False, 0

    def _store(self, value: int) -> None:
        if self._in_cgram:
            self.cgram[self._address] = value & 0x1F
        else:
            self._ddram[self._address] = value
            if self._shift_on_write:
                self._shift += self._step
        self._move(self._step)

    def _move(self, step: int) -> None:
        if self._in_cgram:
            self._address = (self._address + step) % 0x40
            return
        wraps = WRAPS_TWO_LINES if self._two_lines else WRAPS_ONE_LINE
        self._address = wraps.get((self._address, step), (self._address + step) % 0x80)

    # --- the glass

    def _row(self, row: int) -> str:
        if not self.display_on or (row and not self._two_lines):
            return " " * self.columns
        # Rows three and four of a four-row glass are the far ends of the first two lines.
        line, start = row % 2 * 0x40, row // 2 * self.columns
        length = 40 if self._two_lines else 80
        return "".join(
            _character(self._ddram[line + (start + column + self._shift) % length]) for column in range(self.columns)
        )


def _character(code: int) -> str:
    """Character generator ROM A00, for Latin text and katakana. Other characters show as U+FFFD."""
    if code in ROM_A00:
        return ROM_A00[code]
    if code < 0x10:
        return CUSTOM_GLYPHS[code & 0x07]
    if 0x20 <= code < 0x7E:
        return chr(code)
    if 0xA1 <= code < 0xDF:
        return chr(code + 0xFEC0)  # half-width katakana, in the order of JIS X 0201
    return " " if code <= 0xA0 else "\ufffd"
