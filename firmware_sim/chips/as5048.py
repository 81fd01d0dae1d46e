"""Simulated AS5048A (SPI) and AS5048B (I2C): a magnet over a chip of fourteen bits a turn.

Knows registers, diagnostics, the frames on SPI, and the error flag (ams AS5048, figures 19 to 22, 30). Not simulated:
programming, a zero position, PWM, a daisy chain, and the time that a chip needs to start.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from firmware_sim.chips.magnet import OverMagnet
from firmware_sim.chips.shifted import Shifted

WEAKEST_MT, STRONGEST_MT = 30.0, 70.0
OCF, COMP_LOW, COMP_HIGH = 0b0001, 0b0100, 0b1000
FRAMING, INVALID, PARITY = 0b001, 0b010, 0b100
READ = 1 << 14


class _As5048(OverMagnet):
    @property
    def agc(self) -> int:
        return self.gain(WEAKEST_MT, STRONGEST_MT, 255)

    @property
    def diagnostics(self) -> int:
        flags = {0: COMP_LOW, 255: COMP_HIGH}
        return OCF | flags.get(self.agc, 0)

    @property
    def magnitude(self) -> int:
        return round(min(self.field_mt * 60.0, 0x3FFF))


class As5048a(_As5048, Shifted):
    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.06, noise: random.Random | None = None
    ) -> None:
        OverMagnet.__init__(self, turn, noise_deg_rms=noise_deg_rms, noise=noise)
        Shifted.__init__(self)
        self.written: list[int] = []
        """Frames that would write a register."""
        self._errors = 0
        self._next = 0

    def answer(self) -> tuple[int, int]:
        word = self._next | (1 << 14 if self._errors else 0)
        return word | word.bit_count() % 2 << 15, 16

    def took(self, word: int, bits: int) -> None:
        self._next = 0
        if bits != 16:
            self._errors |= FRAMING
        elif word.bit_count() % 2:
            self._errors |= PARITY
        elif word & READ:
            self._next = self._register(word & 0x3FFF)
        elif word:
            self.written.append(word)

    def _register(self, address: int) -> int:
        match address:
            case 0x3FFF:
                return self.steps(1 << 14)
            case 0x3FFE:
                return self.magnitude
            case 0x3FFD:
                return self.diagnostics << 8 | self.agc
            case 0x0001:
                errors, self._errors = self._errors, 0
                return errors
            case 0x0000 | 0x0003 | 0x0016 | 0x0017:
                return 0
        self._errors |= INVALID
        return 0


class As5048b(_As5048):
    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.06, noise: random.Random | None = None
    ) -> None:
        super().__init__(turn, noise_deg_rms=noise_deg_rms, noise=noise)
        self.written: list[bytes] = []
        self._pointer = 0

    def write(self, data: bytes) -> None:
        if data:
            self._pointer = data[0]
            self.written += [data] if data[1:] else []

    def read(self, count: int) -> bytes:
        angle, magnitude = self.steps(1 << 14), self.magnitude
        pairs = [self.agc, self.diagnostics, magnitude >> 6, magnitude & 0x3F, angle >> 6, angle & 0x3F]
        registers = bytes(0xFA) + bytes(pairs)
        octets = bytes(registers[(self._pointer + place) & 0xFF] for place in range(count))
        self._pointer = (self._pointer + count) & 0xFF
        return octets
