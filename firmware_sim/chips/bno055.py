"""A simulated BNO055: a compass that needs time to start, to change its mode and to calibrate itself.

Knows the register map of page 0 (Bosch BST-BNO055-DS000), the modes CONFIG and NDOF, and the faults of compasses and of
the Raspberry Pi's I2C. Knows no rotor. Not simulated: the raw sensors, other modes, interrupts, and the effect of the
axis map.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable

from firmware_sim.buses.i2c import Nack

PAGE_ID, EULER, CALIB_STAT, SYS_STATUS, UNIT_SEL, OPR_MODE = 0x07, 0x1A, 0x35, 0x39, 0x3B, 0x3D
SYS_TRIGGER, AXIS_MAP_CONFIG, AXIS_MAP_SIGN, OFFSETS = 0x3F, 0x41, 0x42, 0x55
REGISTERS = 0x6B
CONFIG, NDOF = 0x00, 0x0C
IDENTITIES = bytes([0xA0, 0xFB, 0x32, 0x0F, 0x11, 0x03, 0x15])
ALWAYS_WRITABLE = (PAGE_ID, OPR_MODE, SYS_TRIGGER)

POWER_ON_S, RESET_S = 0.4, 0.65
INTO_CONFIG_S, OUT_OF_CONFIG_S = 0.019, 0.007
FUSION_HZ = 100
FIRST_ANGLES_S = 0.05
LEARNT_S = {"system": 15.0, "gyroscope": 3.0, "accelerometer": 8.0, "magnetometer": 12.0}
"""Time until the calibration of each part reaches 3 while the antenna turns; a fifth of it after a restore."""
LEARNT = struct.pack("<11h", -12, 30, -7, 210, -145, 88, -1, 2, 0, 1000, 730)
"""Offsets of accelerometer, magnetometer and gyroscope, and the two radii."""
UNLEARNT_DEG = 70.0
"""Error of the heading before the magnetometer is calibrated."""


class Bno055:
    """The chip. `heading_deg` gives its true angle from magnetic north; the chip adds noise."""

    def __init__(
        self,
        clock: Callable[[], float],
        heading_deg: Callable[[], float],
        *,
        roll_deg: Callable[[], float] = lambda: 0.0,
        pitch_deg: Callable[[], float] = lambda: 0.0,
        noise_deg_rms: float = 0.3,
        noise: random.Random | None = None,
    ) -> None:
        self.bit7_share = 0.0
        """Fault `bits-corrupted`: the share of the read bytes that arrive with bit 7 set."""
        self.nack_share = 0.0
        """Fault `busy`: the share of the transfers without an acknowledge."""
        self.learns = True
        """Fault `not-calibrated`, when False: the antenna was not turned, and the chip never calibrates itself."""
        self.hard_iron_deg = 0.0
        """Fault `steel-near`: the largest error of the heading, reached once to each side in a turn."""
        self.wander_deg = 0.0
        """Fault `magnetic-disturbance`: amplitude of a swing of the heading with a period of seven seconds."""
        self.system_error = 0
        """Fault `system-error`: the code in SYS_ERR."""
        self.identity = IDENTITIES[0]
        self._clock = clock
        self._truth = (heading_deg, roll_deg, pitch_deg)
        self._noise_deg = noise_deg_rms
        self._noise = noise or random.Random(55)
        self._boot(POWER_ON_S)

    def brown_out(self) -> None:
        """Fault: the supply dips. The chip then starts as after power-on."""
        self._boot(POWER_ON_S)

    def _boot(self, duration_s: float) -> None:
        self._answers_from_s = self._clock() + duration_s
        self._registers = bytearray(REGISTERS)
        self._registers[UNIT_SEL] = 0x80
        self._registers[AXIS_MAP_CONFIG] = 0x24
        self._pointer = 0
        self._mode, self._next_mode, self._mode_from_s = CONFIG, CONFIG, -math.inf
        self._restored = False
        self._sampled = -1
        self._euler = bytes(6)

    # --- I2C

    def write(self, data: bytes) -> None:
        self._acknowledge()
        self._pointer = data[0] if data else self._pointer
        for register, value in enumerate(data[1:], self._pointer):
            self._set(register, value)

    def read(self, count: int) -> bytes:
        self._acknowledge()
        octets = bytes(self._octet(register) for register in range(self._pointer, self._pointer + count))
        self._pointer += count
        return bytes(octet | 0x80 if self._noise.random() < self.bit7_share else octet for octet in octets)

    def _acknowledge(self) -> None:
        if self._clock() < self._answers_from_s or self._noise.random() < self.nack_share:
            raise Nack
        if self._clock() >= self._mode_from_s:
            self._mode = self._next_mode
        self._sample()

    # --- registers

    def _set(self, register: int, value: int) -> None:
        if register == PAGE_ID:
            self._registers[PAGE_ID] = value & 1
        elif self._registers[PAGE_ID] or register >= REGISTERS:
            return
        elif register == OPR_MODE:
            self._switch(value & 0x0F)
        elif register == SYS_TRIGGER and value & 0x20:
            self._boot(RESET_S)
        elif register >= UNIT_SEL and self._mode == CONFIG:
            self._registers[register] = value
            self._restored = self._restored or register >= OFFSETS

    def _switch(self, mode: int) -> None:
        if mode == self._next_mode or CONFIG not in (mode, self._mode):
            return
        self._next_mode = mode
        self._mode_from_s = self._clock() + (INTO_CONFIG_S if mode == CONFIG else OUT_OF_CONFIG_S)

    def _octet(self, register: int) -> int:
        if register == PAGE_ID:
            return self._registers[PAGE_ID]
        if self._registers[PAGE_ID] or register >= REGISTERS:
            return 0
        if register == 0:
            return self.identity
        if register < len(IDENTITIES):
            return IDENTITIES[register]
        if EULER <= register < EULER + 6:
            return self._euler[register - EULER]
        match register:
            case 0x35:
                return self._calibrated()
            case 0x36:
                return 0x0F  # all self-tests passed
            case 0x39:
                return 1 if self.system_error else 5 if self._mode == NDOF else 0
            case 0x3A:
                return self.system_error
            case 0x3D:
                return self._mode
        if register >= OFFSETS and self._calibrated() == 0xFF:
            return LEARNT[register - OFFSETS]
        return self._registers[register]

    # --- fusion

    def _calibrated(self) -> int:
        if not self.learns:
            return 0
        turned_s = (self._clock() - self._answers_from_s) * (5.0 if self._restored else 1.0)
        stat = 0
        for learnt_s in LEARNT_S.values():
            stat = stat << 2 | max(0, min(3, int(3.0 * turned_s / learnt_s)))
        return stat

    def _sample(self) -> None:
        """Fusion: new angles every 10 ms. Reads in between get the same angles."""
        tick = int(self._clock() * FUSION_HZ)
        if self._mode != NDOF or self._clock() < self._mode_from_s + FIRST_ANGLES_S or tick == self._sampled:
            return
        self._sampled = tick
        heading_deg, roll_deg, pitch_deg = (truth() for truth in self._truth)
        heading_deg += self.hard_iron_deg * math.sin(math.radians(heading_deg))
        heading_deg += self.wander_deg * math.sin(math.tau * self._clock() / 7.0)
        if self._calibrated() & 3 == 0:
            heading_deg += UNLEARNT_DEG
        if self._registers[UNIT_SEL] & 0x80:
            pitch_deg = -pitch_deg
        heading = round((heading_deg + self._noise.gauss(0.0, self._noise_deg)) * 16) % 5760
        self._euler = struct.pack("<hhh", heading, round(roll_deg * 16), round(pitch_deg * 16))
