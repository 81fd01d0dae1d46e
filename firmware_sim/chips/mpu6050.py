"""A simulated MPU6050: three accelerometers with noise, I2C registers.

Knows the register map (InvenSense RM-MPU-6000A), sleep and reset, the ranges, and how noise depends on the low-pass
filter. Knows no boom. Not simulated: the gyroscopes (they read 0), the FIFO, interrupts, and the filter's delay.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from firmware_sim.chips.registers import Registers

CONFIG, ACCEL_CONFIG, ACCEL_OUT, POWER_1, WHO_AM_I = 0x1A, 0x1C, 0x3B, 0x6B, 0x75
RESET_BIT, SLEEP_BIT = 0x80, 0x40
IDENTITY = 0x68
BANDWIDTH_HZ = (260, 184, 94, 44, 21, 10, 5, 260)
STEPS_PER_G = (16384, 8192, 4096, 2048)
WAKE_UP_S = 0.03
"""Time after sleep in which the outputs do not change."""

Acceleration = tuple[float, float, float]


class Mpu6050(Registers):
    """The chip. `feels_g` gives the true acceleration along its x, y and z: at rest, 1 g upwards."""

    def __init__(
        self,
        clock: Callable[[], float],
        feels_g: Callable[[], Acceleration],
        *,
        noise_g_per_root_hz: float = 400e-6,
        noise: random.Random | None = None,
    ) -> None:
        self.shaken_g = 0.0
        """Fault `shaken`: acceleration from a motor or the wind, rms on each axis."""
        self.offset_g: Acceleration = (0.0, 0.0, 0.0)
        """The zero offsets: a new chip has up to 0.05 g on x and y, 0.08 g on z."""
        self.identity = IDENTITY
        self._clock = clock
        self._feels_g = feels_g
        self._noise_g = noise_g_per_root_hz
        self._noise = noise or random.Random(6050)
        self.brown_out()

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip is then as after power-on: asleep, with outputs 0."""
        self._registers = bytearray(0x80)
        self._registers[POWER_1] = SLEEP_BIT
        self._runs_from_s = math.inf

    # --- I2C

    def read(self, count: int) -> bytes:
        self._sample()
        asked = range(self._pointer, self._pointer + count)
        self._pointer = asked.stop & 0x7F
        return bytes(self.identity if at == WHO_AM_I else self._registers[at & 0x7F] for at in asked)

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if ACCEL_OUT <= register < ACCEL_OUT + 14 or register == WHO_AM_I or register >= len(self._registers):
            return  # read only
        if register == POWER_1 and value & RESET_BIT:
            self.brown_out()
            return
        slept = self._asleep
        self._registers[register] = value
        if self._asleep:
            self._runs_from_s = math.inf
        elif slept:
            self._runs_from_s = self._clock() + WAKE_UP_S

    @property
    def _asleep(self) -> bool:
        return bool(self._registers[POWER_1] & SLEEP_BIT)

    def _sample(self) -> None:
        if self._clock() < self._runs_from_s:
            return
        # A first-order low-pass filter lets through as much noise as an ideal one of pi/2 times its bandwidth.
        noise_bandwidth_hz = BANDWIDTH_HZ[self._registers[CONFIG] & 0b111] * math.pi / 2
        noise_g = self._noise_g * math.sqrt(noise_bandwidth_hz)
        rms_g = math.hypot(noise_g, self.shaken_g)
        steps = STEPS_PER_G[self._registers[ACCEL_CONFIG] >> 3 & 0b11]
        counts = [
            max(-32768, min(32767, round((felt + offset + self._noise.gauss(0.0, rms_g)) * steps)))
            for felt, offset in zip(self._feels_g(), self.offset_g, strict=True)
        ]
        struct.pack_into(">hhh", self._registers, ACCEL_OUT, *counts)
