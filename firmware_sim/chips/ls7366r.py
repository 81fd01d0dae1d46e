"""A simulated LS7366R: a 32-bit counter for two channels of an encoder, with its registers on SPI.

Knows instructions, registers and the power-loss latch (LSI/CSI LS7366R, table 1). Fault: no supply, and the count is
lost. Not simulated: counting without quadrature, the modes x1 and x2, fewer than four bytes, modulo, range limit, the
index, the outputs LFLAG and DFLAG, and the input filter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

CLR, RD, WR, LOAD = range(4)
MDR0, MDR1, DTR, CNTR, OTR, STR = range(1, 7)
WIDTH = {MDR0: 1, MDR1: 1, DTR: 4, CNTR: 4, OTR: 4, STR: 1}
X4, HALTED = 0b11, 0b100
CEN, PLS, UP, SIGN = 0b1000, 0b0100, 0b0010, 0b0001
PHASE = {(False, False): 0, (True, False): 1, (True, True): 2, (False, True): 3}


class Ls7366r:
    """The chip. `levels`: of A and B at first. `catch_up` brings in the edges up to now, by `edge`."""

    def __init__(self, levels: tuple[bool, bool] = (False, False), *, enabled: bool = True) -> None:
        self.enabled = enabled
        """The level at CNT_EN."""
        self.catch_up: Callable[[], None] = lambda: None
        self._levels = list(levels)
        self._gone = False
        self._cs, self._sck = True, False
        self._so: bool | None = None
        self._in = self._count = self._out = 0
        self.power_on()

    def power_on(self) -> None:
        self.registers = dict.fromkeys(WIDTH, 0)
        self._latch, self._up = PLS, 0

    @property
    def gone(self) -> bool:
        """Fault: no supply."""
        return self._gone

    @gone.setter
    def gone(self, gone: bool) -> None:
        self._gone = gone
        self.power_on()

    def kept(self, ahead: int = 0) -> dict[str, float]:
        """What it keeps while it has power, after `ahead` more counts."""
        registers = self.registers | {CNTR: (self.registers[CNTR] + ahead) % (1 << 32)}
        kept = {f"r{key}": float(value) for key, value in registers.items()} | {"pls": float(self._latch)}
        return {} if self._gone else kept

    def put_back(self, kept: Mapping[str, float]) -> None:
        self.registers = {key: int(kept[f"r{key}"]) for key in self.registers}
        self._latch = int(kept["pls"])

    # --- A and B

    def edge(self, channel: int, level: bool) -> None:
        """Channel A, 0, or B, 1, is at this level now."""
        before = PHASE[self._levels[0], self._levels[1]]
        self._levels[channel] = level
        step = (PHASE[self._levels[0], self._levels[1]] - before) % 4
        counts = self.registers[MDR0] & 0b11 == X4 and not self.registers[MDR1] & HALTED and self.enabled
        if counts and not self._gone and step in (1, 3):
            self._up = UP if step == 1 else 0
            self.registers[CNTR] = (self.registers[CNTR] + (1 if step == 1 else -1)) % (1 << 32)

    # --- SPI

    @property
    def so(self) -> bool | None:
        """The level at MISO; None: high impedance."""
        return None if self._gone else self._so

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        if cs != self._cs:
            if cs:
                self._released()
            self._in = self._count = self._out = 0
            self._so = None
        elif not cs and sck and not self._sck:
            self._in, self._count = self._in << 1 | si, self._count + 1
            if self._count == 8 and self._in >> 6 == RD:
                self._out = self._read(self._in >> 3 & 7)
        elif not cs and self._sck and not sck and 8 <= self._count < 40:
            self._so = bool(self._out >> 39 - self._count & 1)
        self._cs, self._sck = cs, sck

    def _read(self, register: int) -> int:
        """What goes out, in the upper bits of four bytes."""
        if self._gone or register not in WIDTH or register == DTR:
            return 0
        self.catch_up()
        if register == CNTR:
            self.registers[OTR] = self.registers[CNTR]
            register = OTR
        value = self._status() if register == STR else self.registers[register]
        return value << 32 - 8 * WIDTH[register]

    def _status(self) -> int:
        counting = CEN if self.enabled and not self.registers[MDR1] & HALTED else 0
        return self._latch | counting | self._up | self.registers[CNTR] >> 31

    def _released(self) -> None:
        if self._count < 8 or self._gone:
            return
        self.catch_up()
        order, data = self._in >> self._count - 8, self._in & (1 << self._count - 8) - 1
        register = order >> 3 & 7
        match order >> 6:
            case 0 if register in (MDR0, MDR1, CNTR):
                self.registers[register] = 0
            case 0 if register == STR:
                self._latch = 0
            case 2 if register in (MDR0, MDR1, DTR) and self._count == 8 + 8 * WIDTH[register]:
                self.registers[register] = data
            case 3 if register == CNTR:
                self.registers[CNTR] = self.registers[DTR]
            case 3 if register == OTR:
                self.registers[OTR] = self.registers[CNTR]
