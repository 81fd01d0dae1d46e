"""A simulated MT6701: a magnet over a chip of fourteen bits a turn, at its I2C or at its synchronous serial interface.

Knows the registers of the angle, and the 24 bits of an answer on SSI with their checksum (MagnTek MT6701, "I2C Read
Angle Registers", "SSI Interface"). Not simulated: programming, the outputs ABZ, UVW and OUT, and the push of a button.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from firmware_sim.chips.magnet import OverMagnet
from firmware_sim.chips.shifted import Shifted

WEAKEST_MT, STRONGEST_MT = 20.0, 100.0
STRONG, WEAK, TRACK_LOST = 0b0001, 0b0010, 0b1000


class Mt6701(OverMagnet):
    """On I2C."""

    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.03, noise: random.Random | None = None
    ) -> None:
        super().__init__(turn, noise_deg_rms=noise_deg_rms, noise=noise)
        self.written: list[bytes] = []
        self._pointer = 0

    def write(self, data: bytes) -> None:
        if data:
            self._pointer = data[0]
            self.written += [data] if data[1:] else []

    def read(self, count: int) -> bytes:
        angle = (self.steps(1 << 14) << 2).to_bytes(2, "big")
        octets = bytes(angle[at - 3] if at in (3, 4) else 0 for at in range(self._pointer, self._pointer + count))
        self._pointer += count
        return octets


class Mt6701Ssi(OverMagnet, Shifted):
    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.03, noise: random.Random | None = None
    ) -> None:
        OverMagnet.__init__(self, turn, noise_deg_rms=noise_deg_rms, noise=noise)
        Shifted.__init__(self)
        self.track_lost = False

    def answer(self) -> tuple[int, int]:
        field = WEAK if self.field_mt < WEAKEST_MT else STRONG if self.field_mt > STRONGEST_MT else 0
        bits = self.steps(1 << 14) << 4 | field | (TRACK_LOST if self.track_lost else 0)
        return bits << 6 | _checksum(bits), 24


def _checksum(bits: int) -> int:
    """A shift register of six bits with feedback, x⁶ + x + 1: the most significant bit goes in first."""
    register = 0
    for place in range(17, -1, -1):
        feedback = register >> 5 ^ bits >> place & 1
        register = (register << 1 & 0x3F) ^ (0b000011 if feedback else 0)
    return register
