"""A simulated AS5600: a magnet over a chip with twelve bits a turn, I2C registers.

Knows the register map (ams AS5600), how the gain follows the magnet, the faults of a magnet, and the command that burns
settings. Knows no axis. Not simulated: the analog output, the low-power modes, the filters, and the hysteresis at the
ends of a narrowed range.
"""

from __future__ import annotations

import random
from collections.abc import Callable

from firmware_sim.chips.magnet import DETECTED_MT, OverMagnet

ZMCO, ZPOS, MPOS, MANG, CONF = 0x00, 0x01, 0x03, 0x05, 0x07
STATUS, RAW_ANGLE, ANGLE, AGC, MAGNITUDE = 0x0B, 0x0C, 0x0E, 0x1A, 0x1B
BURN = 0xFF
HELD = (RAW_ANGLE, ANGLE, MAGNITUDE)
"""At these registers the pointer does not move on: each read returns the same two bytes, newly measured."""

WEAKEST_MT, STRONGEST_MT = 30.0, 90.0
GAIN_MAX_3V3 = 128
"""Largest gain with a supply of 3.3 V; with 5 V it is 255."""
STEPS = 4096


class As5600(OverMagnet):
    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.015, noise: random.Random | None = None
    ) -> None:
        super().__init__(turn, noise_deg_rms=noise_deg_rms, noise=noise)
        self.burns: list[int] = []
        """The values written to BURN. A real chip keeps burnt settings for ever."""
        self._settings = bytearray(CONF + 2)
        self._pointer = 0
        self._held = False

    # --- I2C

    def write(self, data: bytes) -> None:
        if not data:
            return
        self._pointer = data[0]
        self._held = self._pointer in HELD
        for register, value in enumerate(data[1:], self._pointer):
            if register == BURN:
                self.burns.append(value)
            elif ZPOS <= register < len(self._settings):
                self._settings[register] = value

    def read(self, count: int) -> bytes:
        if self._held:
            return (self._word(self._pointer) * (count // 2 + 1))[:count]
        octets = bytes(self._octet(register & 0xFF) for register in range(self._pointer, self._pointer + count))
        self._pointer = (self._pointer + count) & 0xFF
        return octets

    # --- registers

    def _octet(self, register: int) -> int:
        if register < len(self._settings):
            return self._settings[register]
        if register == STATUS:
            return self._status()
        if register == AGC:
            return self.gain(WEAKEST_MT, STRONGEST_MT, GAIN_MAX_3V3)
        for word in HELD:
            if register in (word, word + 1):
                return self._word(word)[register - word]
        return 0

    def _word(self, register: int) -> bytes:
        match register:
            case 0x0C:
                value = self.steps(STEPS)
            case 0x0E:
                value = self._narrowed(self.steps(STEPS))
            case _:
                value = round(min(self.field_mt * 30.0, STEPS - 1))
        return value.to_bytes(2, "big")

    def _narrowed(self, raw: int) -> int:
        """ANGLE: the range from ZPOS to MPOS becomes 0 to 4095; outside it, the nearer end."""
        zero, end = (int.from_bytes(self._settings[at : at + 2], "big") % STEPS for at in (ZPOS, MPOS))
        width = (end - zero) % STEPS or STEPS
        beyond = (raw - zero) % STEPS
        if beyond > width:
            return 0 if beyond - width > STEPS - beyond else STEPS - 1
        return min(beyond * STEPS // width, STEPS - 1)

    def _status(self) -> int:
        field_mt = self.field_mt
        detected, weak, strong = field_mt >= DETECTED_MT, field_mt < WEAKEST_MT, field_mt > STRONGEST_MT
        return detected << 5 | weak << 4 | strong << 3
