"""A simulated QMC5883L: three magnetometers with noise, I2C registers.

Knows the register map (QST QMC5883L), its rates and ranges, overflow, and what a read does to the bits of the status.
Knows no boom. Not simulated: the temperature, interrupts, and the roll-over of the pointer.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from firmware_sim.chips.registers import Registers

STATUS, CONTROL_1, CONTROL_2, PERIOD, CHIP_ID, LAST = 0x06, 0x09, 0x0A, 0x0B, 0x0D, 0x0D
DRDY, OVL, DOR = 0x01, 0x02, 0x04
IDENTITY = 0xFF
RATES_HZ = (10, 50, 100, 200)
STEPS_PER_UT = (120, 30)
"""By range: 2 G, 8 G."""
NOISE_UT = 0.2
"""Rms with 512 samples in a result; each halving makes it larger by the root of two."""

Field = tuple[float, float, float]


class Qmc5883l(Registers):
    """The chip. `feels_ut` gives the true field along its x, y and z."""

    def __init__(
        self,
        clock: Callable[[], float],
        feels_ut: Callable[[], Field],
        *,
        noise_ut: float = NOISE_UT,
        noise: random.Random | None = None,
    ) -> None:
        self.iron_ut: Field = (0.0, 0.0, 0.0)
        """What iron and magnets that turn with the board add."""
        self.identity = IDENTITY
        self._clock = clock
        self._feels_ut = feels_ut
        self._noise_ut = noise_ut
        self._noise = noise or random.Random(5883)
        self.brown_out()

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip is then as after power-on: it waits, and measures nothing."""
        self._registers = bytearray(LAST + 1)
        self._began_s = math.inf
        self._measured = 0

    # --- I2C

    def read(self, count: int) -> bytes:
        self._measure()
        octets = bytearray()
        for register in range(self._pointer, self._pointer + count):
            octets.append(self.identity if register == CHIP_ID else self._registers[register] if register < LAST else 0)
            if register == STATUS:
                self._registers[STATUS] &= ~DOR
            elif register < STATUS:
                self._registers[STATUS] &= ~DRDY
        self._pointer += count
        return bytes(octets)

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if register == CONTROL_2 and value & 0x80:
            self.brown_out()
        elif CONTROL_1 <= register <= PERIOD:
            self._registers[register] = value
            if register == CONTROL_1:
                self._began_s, self._measured = (self._clock() if value & 0b11 == 1 else math.inf), 0

    def _measure(self) -> None:
        """The results that are due since the last read: the latest of them stays."""
        control = self._registers[CONTROL_1]
        passed_s = self._clock() - self._began_s
        due = int(passed_s * RATES_HZ[control >> 2 & 0b11]) if passed_s > 0.0 else 0
        if due <= self._measured:
            return
        self._measured = due
        steps = STEPS_PER_UT[control >> 4 & 1]
        rms_ut = self._noise_ut * math.sqrt(1 << (control >> 6))
        counts = [
            round((felt + iron + (self._noise.gauss(0.0, rms_ut) if rms_ut else 0.0)) * steps)
            for felt, iron in zip(self._feels_ut(), self.iron_ut, strict=True)
        ]
        over = any(not -32768 <= count <= 32767 for count in counts) * OVL
        late = self._registers[STATUS] & DRDY and DOR
        struct.pack_into("<hhh", self._registers, 0, *(max(-32768, min(32767, count)) for count in counts))
        self._registers[STATUS] = DRDY | over | late
