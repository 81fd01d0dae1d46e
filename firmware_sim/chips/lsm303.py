"""The simulated accelerometer of an LSM303DLHC: noise, power-down, I2C registers.

Knows its register map (ST LSM303DLHC, section 7.1). Knows no boom. Not simulated: the FIFO, interrupts, clicks, the
high-pass filter, big-endian results, and the filter's delay.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

CTRL_1, CTRL_4, STATUS, OUT_X_L, LAST = 0x20, 0x23, 0x27, 0x28, 0x3F
EACH_NEXT = 0x80
RATES_HZ = (0, 1, 10, 25, 50, 100, 200, 400)
MG_PER_STEP = (1, 2, 4, 12)
"""In twelve bits, by range: 2, 4, 8, 16 g."""
NOISE_G = 220e-6 * math.sqrt(11.0 * math.pi / 2.0)
"""220 µg per root Hz, over the bandwidth of high resolution at 100 Hz."""
RESULTS_UNTIL_RIGHT = 7

Acceleration = tuple[float, float, float]


class Lsm303Accelerometer:
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
        """The zero offsets: a new chip has 0.06 g."""
        self._clock = clock
        self._feels_g = feels_g
        self._noise_g = NOISE_G if noisy else 0.0
        self._noise = noise or random.Random(303)
        self._pointer, self._goes_on = 0, False
        self.brown_out()

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip is then as after power-on: powered down, with outputs 0."""
        self._registers = bytearray(LAST + 1)
        self._registers[CTRL_1] = 0x07
        self._runs_from_s = math.inf

    # --- I2C

    def write(self, data: bytes) -> None:
        if not data:
            return
        self._pointer, self._goes_on = data[0] & 0x7F, bool(data[0] & EACH_NEXT)
        for value in data[1:]:
            self._set(self._pointer, value)
            self._pointer += self._goes_on

    def read(self, count: int) -> bytes:
        self._sample()
        octets = bytearray()
        for _ in range(count):
            octets.append(self._registers[self._pointer] if self._pointer <= LAST else 0)
            self._pointer += self._goes_on
        return bytes(octets)

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if not CTRL_1 <= register <= 0x26 and not 0x2E <= register <= LAST:
            return
        self._registers[register] = value
        if register == CTRL_1:
            rate_hz = RATES_HZ[value >> 4] if value >> 4 < len(RATES_HZ) else 1344
            self._runs_from_s = self._clock() + RESULTS_UNTIL_RIGHT / rate_hz if rate_hz else math.inf

    def _sample(self) -> None:
        if self._clock() < self._runs_from_s:
            return
        mg = MG_PER_STEP[self._registers[CTRL_4] >> 4 & 0b11]
        rms_g = math.hypot(self._noise_g, self.shaken_g)
        counts = []
        for place, (felt, offset) in enumerate(zip(self._feels_g(), self.offset_g, strict=True)):
            felt_g = felt + offset + (self._noise.gauss(0.0, rms_g) if rms_g else 0.0)
            count = max(-2048, min(2047, round(felt_g * 1000.0 / mg))) << 4  # at the left of sixteen bits
            counts.append(count if self._registers[CTRL_1] >> place & 1 else 0)
        struct.pack_into("<hhh", self._registers, OUT_X_L, *counts)
        self._registers[STATUS] = 0x0F
