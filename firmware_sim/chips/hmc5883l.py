"""A simulated HMC5883L, and the compass of an LSM303DLHC: three magnetometers with noise, I2C registers.

Knows both register maps (Honeywell HMC5883L; ST LSM303DLHC, section 7.2), the gains, overflow, and that the first
result after a change of the gain still has the old one. Knows no boom. Not simulated: self-test, single results, the
lock of half-read results, and the LSM303DLHC's temperature.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from firmware_sim.chips.registers import Registers

CRA, CRB, MODE, DATA, STATUS, IDENTITY, LAST = 0x00, 0x01, 0x02, 0x03, 0x09, 0x0A, 0x0C
H43 = b"\x48\x34\x33"
IDLE = 0x03
RATES_HZ = (0.75, 1.5, 3, 7.5, 15, 30, 75, 220)
GAINS = (1370, 1090, 820, 660, 440, 390, 330, 230)
GAINS_LSM303 = ((1100, 980), (1100, 980), (855, 760), (670, 600), (450, 400), (400, 355), (330, 295), (230, 205))
"""Of x and y, and of z."""
NOISE_UT = 0.2

Field = tuple[float, float, float]


class Hmc5883l(Registers):
    """The chip. `feels_ut` gives the true field along its x, y and z. `lsm303`: the one in an LSM303DLHC."""

    def __init__(
        self,
        clock: Callable[[], float],
        feels_ut: Callable[[], Field],
        *,
        lsm303: bool = False,
        noise_ut: float = NOISE_UT,
        noise: random.Random | None = None,
    ) -> None:
        self.iron_ut: Field = (0.0, 0.0, 0.0)
        """What iron and magnets that turn with the board add."""
        self.identity = H43
        self._clock = clock
        self._feels_ut = feels_ut
        self._gains = GAINS_LSM303 if lsm303 else tuple((gain, gain) for gain in GAINS)
        self._averages = not lsm303
        self._noise_ut = noise_ut
        self._noise = noise or random.Random(43)
        self.brown_out()

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip is then as after power-on: it makes one result, and idles."""
        self._registers = bytearray(LAST + 1)
        self._registers[CRA:DATA] = b"\x10\x20\x01" if self._averages else b"\x10\x20\x03"
        self._began_s = math.inf
        self._measured = 0
        self._gain = self._next_gain = 1

    # --- I2C

    def read(self, count: int) -> bytes:
        self._measure()
        octets = bytearray()
        for _ in range(count):
            at = self._pointer
            octets.append(self.identity[at - IDENTITY] if IDENTITY <= at <= LAST else self._octet(at))
            self._pointer = DATA if at == STATUS - 1 else at + 1  # after the last result comes the first again
        return bytes(octets)

    def _octet(self, register: int) -> int:
        return self._registers[register] if register <= LAST else 0

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if register > MODE:
            return
        self._registers[register] = value
        if register == CRB:
            self._next_gain = value >> 5
        if register == MODE:
            self._began_s, self._measured = (self._clock() if value & 0b11 == 0 else math.inf), 0

    def _measure(self) -> None:
        passed_s = self._clock() - self._began_s
        due = int(passed_s * RATES_HZ[self._registers[CRA] >> 2 & 0b111]) if passed_s > 0.0 else 0
        if due <= self._measured:
            return
        if due > self._measured + 1 or self._measured:
            self._gain = self._next_gain
        self._measured = due
        across, along_z = self._gains[self._gain]
        counts = []
        samples = 1 << (self._registers[CRA] >> 5 & 0b11) if self._averages else 1
        rms_ut = self._noise_ut * math.sqrt(8.0 / samples) if self._averages else self._noise_ut
        for felt, iron, gain in zip(self._feels_ut(), self.iron_ut, (across, across, along_z), strict=True):
            ut = felt + iron + (self._noise.gauss(0.0, rms_ut) if rms_ut else 0.0)
            count = round(ut * gain / 100.0)
            counts.append(count if -2048 <= count <= 2047 else -4096)
        x, y, z = counts
        struct.pack_into(">hhh", self._registers, DATA, x, z, y)
        self._registers[STATUS] = 0x01
