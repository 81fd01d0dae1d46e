"""A simulated PCA9685: sixteen pulse outputs, one oscillator, I2C registers.

Knows the register map (NXP PCA9685 rev. 4), sleep and restart, and the pulse width and duty cycle at each output. Knows
no servo and no meter. Not simulated: the all-call and sub-addresses, the software reset, the OE pin, the phase of a
pulse, the moment at which a new value becomes effective, and the test mode. The settings of MODE2 (inversion, open
drain) and the switch to an external clock can be written and read, and have no effect.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

from firmware_sim.buses.i2c import Nack

MODE1, MODE2, LED0, LED_END, ALL_LED, PRE_SCALE = 0x00, 0x01, 0x06, 0x46, 0xFA, 0xFE
RESTART_BIT, EXTCLK_BIT, AI_BIT, SLEEP_BIT = 0x80, 0x40, 0x20, 0x10
FULL_BIT = 0x10
LEAST_PRESCALE = 3
STEPS = 4096
STABLE_S = 500e-6
"""The oscillator's start after sleep."""


class Pca9685:
    """The chip. `osc_hz` is its oscillator's real frequency."""

    def __init__(self, clock: Callable[[], float], *, osc_hz: float = 25e6) -> None:
        self.osc_hz = osc_hz
        self.before_change: list[Callable[[], None]] = []
        """Called before a write that may change an output: the parts behind it first use the old pulse up to now."""
        self.early_writes = 0
        """Number of bytes written to outputs before the oscillator was stable, which the datasheet does not allow."""
        self._clock = clock
        self._lock = threading.RLock()
        self._supply = True
        self._reset()

    def _reset(self) -> None:
        self._pointer = 0
        self._registers = bytearray(256)
        self._registers[MODE1], self._registers[MODE2] = 0x11, 0x04
        self._registers[2:6] = bytes([0xE2, 0xE4, 0xE8, 0xE0])  # SUBADR1 to 3, ALLCALLADR
        self._registers[LED0:LED_END] = bytes([0, 0, 0, FULL_BIT]) * 16
        self._registers[PRE_SCALE] = 0x1E
        self._restart = False
        self._awake_s = float("-inf")

    # --- the bench

    @property
    def supply(self) -> bool:
        return self._supply

    @supply.setter
    def supply(self, on: bool) -> None:
        """Fault when False: without VCC the chip does not answer, and no output works. The return of VCC is a reset."""
        self._catch_up()
        with self._lock:
            if on and not self._supply:
                self._reset()
            self._supply = on

    def register(self, register: int) -> int:
        return self._registers[register]

    def put_back(self, registers: Mapping[int, int]) -> None:
        """What the registers held when the last program ended: the chip has had its supply since. Empty: it had not."""
        for number, value in registers.items():
            self._registers[number] = value

    def period_s(self) -> float:
        return (self._registers[PRE_SCALE] + 1) * STEPS / self.osc_hz

    def high_share(self, channel: int) -> float:
        """Duty cycle of an output, 0 to 1."""
        with self._lock:
            on_l, on_h, off_l, off_h = self._registers[LED0 + 4 * channel : LED0 + 4 * channel + 4]
            if not self._supply or off_h & FULL_BIT:
                return 0.0
            if on_h & FULL_BIT:
                return 1.0
            if self._registers[MODE1] & SLEEP_BIT or self._restart:
                return 0.0
            on, off = on_l | (on_h & 0x0F) << 8, off_l | (off_h & 0x0F) << 8
            return (off - on) % STEPS / STEPS

    def pulse_us(self, channel: int) -> float | None:
        """The width of the pulse at an output in µs; None while the output is constantly low or high."""
        share = self.high_share(channel)
        return share * self.period_s() * 1e6 if 0.0 < share < 1.0 else None

    # --- I2C

    def write(self, data: bytes) -> None:
        if data:
            self._catch_up()
        with self._lock:
            self._check_supply()
            if not data:
                return
            self._pointer = data[0]
            for value in data[1:]:
                self._put(self._pointer, value)
                self._advance()

    def read(self, count: int) -> bytes:
        with self._lock:
            self._check_supply()
            return bytes(self._next() for _ in range(count))

    def _next(self) -> int:
        value = 0 if ALL_LED <= self._pointer < PRE_SCALE else self._registers[self._pointer]
        if self._pointer == MODE1:
            value |= RESTART_BIT if self._restart else 0
        self._advance()
        return value

    def _advance(self) -> None:
        if self._registers[MODE1] & AI_BIT:
            self._pointer = 0 if self._pointer == LED_END - 1 else (self._pointer + 1) & 0xFF

    def _put(self, register: int, value: int) -> None:
        if register == MODE1:
            self._set_mode(value)
        elif register == PRE_SCALE:
            if self._registers[MODE1] & SLEEP_BIT:
                self._registers[PRE_SCALE] = max(value, LEAST_PRESCALE)
        elif LED0 <= register < LED_END:
            self._put_output(register, value)
        elif ALL_LED <= register < PRE_SCALE:
            for output in range(16):
                self._put_output(LED0 + 4 * output + register - ALL_LED, value)
        elif register < LED0:
            self._registers[register] = value

    def _put_output(self, register: int, value: int) -> None:
        self._restart = False
        awake = not self._registers[MODE1] & SLEEP_BIT
        self.early_writes += awake and self._clock() < self._awake_s + STABLE_S
        high_byte = (register - LED0) % 2 == 1
        self._registers[register] = value & 0x1F if high_byte else value

    def _set_mode(self, value: int) -> None:
        before = self._registers[MODE1]
        running = any(self.pulse_us(output) is not None for output in range(16))
        if value & SLEEP_BIT and not before & SLEEP_BIT:
            self._restart = running
        elif not value & SLEEP_BIT and before & SLEEP_BIT:
            self._awake_s = self._clock()
        elif value & RESTART_BIT and not value & SLEEP_BIT and self._clock() >= self._awake_s + STABLE_S:
            self._restart = False
        self._registers[MODE1] = value & ~RESTART_BIT | before & EXTCLK_BIT  # EXTCLK stays until a reset

    def _check_supply(self) -> None:
        if not self._supply:
            raise Nack

    def _catch_up(self) -> None:
        """Let the parts behind the outputs use the old pulse up to now.

        Called without the chip's lock: these parts take the rotor's lock and then read the pulse. Order of locks: first
        the rotor, then the chip.
        """
        for catch_up in self.before_change:
            catch_up()
