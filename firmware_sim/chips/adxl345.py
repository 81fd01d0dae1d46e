"""A simulated ADXL345: three accelerometers with noise, I2C registers.

Knows the register map (Analog Devices ADXL345), standby, the ranges in both resolutions, and how noise depends on the
data rate. Knows no boom. Not simulated: the FIFO, interrupts, taps, offset registers, sleep, the filter's delay.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from firmware_sim.chips.registers import Registers

DEVID, BW_RATE, POWER_CTL, DATA_FORMAT, DATAX0, LAST = 0x00, 0x2C, 0x2D, 0x31, 0x32, 0x39
IDENTITY = 0xE5
MEASURE, FULL_RES, LEFT = 0x08, 0x08, 0x04
RATE_100_HZ = 0x0A
NOISE_STEPS = (0.75, 0.75, 1.1)
"""Rms at 100 Hz, in steps of 3.9 mg; it grows with the root of the bandwidth."""
TURN_ON_S = 1.1e-3
"""And one period of the data rate."""

Acceleration = tuple[float, float, float]


class Adxl345(Registers):
    """The chip. `feels_g` gives the true acceleration along its x, y and z: at rest, 1 g upwards."""

    def __init__(
        self,
        clock: Callable[[], float],
        feels_g: Callable[[], Acceleration],
        *,
        noisy: bool = True,
        noise: random.Random | None = None,
    ) -> None:
        self.shaken_g = 0.0
        """Fault `shaken`: acceleration from a motor or the wind, rms on each axis."""
        self.offset_g: Acceleration = (0.0, 0.0, 0.0)
        """The zero offsets: a new chip has up to 0.15 g on x and y, 0.25 g on z; 0.035 and 0.04 g are usual."""
        self.identity = IDENTITY
        self._clock = clock
        self._feels_g = feels_g
        self._noisy = noisy
        self._noise = noise or random.Random(345)
        self.brown_out()

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip is then as after power-on: in standby, with outputs 0."""
        self._registers = bytearray(LAST + 1)
        self._registers[BW_RATE] = RATE_100_HZ
        self._runs_from_s = math.inf

    # --- I2C

    def read(self, count: int) -> bytes:
        self._sample()
        asked = range(self._pointer, self._pointer + count)
        self._pointer = asked.stop
        return bytes(self.identity if at == DEVID else self._registers[at] if at <= LAST else 0 for at in asked)

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if not 0x1D <= register <= DATA_FORMAT and register != 0x38:
            return  # read only, or reserved
        self._registers[register] = value
        if register == POWER_CTL:
            self._runs_from_s = self._clock() + TURN_ON_S + 1.0 / self._rate_hz if value & MEASURE else math.inf

    @property
    def _rate_hz(self) -> float:
        return 3200.0 / float(1 << (15 - (self._registers[BW_RATE] & 0x0F)))

    def _sample(self) -> None:
        if self._clock() < self._runs_from_s:
            return
        kind = self._registers[DATA_FORMAT]
        finer = 0 if kind & FULL_RES else kind & 0b11
        """In ten bits a wider range has coarser steps; in full resolution it has more bits."""
        bits = 10 + (kind & 0b11 if kind & FULL_RES else 0)
        louder = math.sqrt(max(self._rate_hz, 12.5) / 100.0) if self._noisy else 0.0
        counts = []
        for felt, offset, steps in zip(self._feels_g(), self.offset_g, NOISE_STEPS, strict=True):
            noise_g = math.hypot(steps / 256.0 * louder, self.shaken_g)
            felt_g = felt + offset + (self._noise.gauss(0.0, noise_g) if noise_g else 0.0)
            count = round(felt_g * (256 >> finer))
            count = max(-(1 << bits - 1), min((1 << bits - 1) - 1, count))
            counts.append(count << 16 - bits if kind & LEFT else count)
        struct.pack_into("<hhh", self._registers, DATAX0, *counts)
