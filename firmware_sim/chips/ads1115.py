"""A simulated ADS1115: four inputs, one 16-bit converter, I2C registers.

Knows the register map (TI SBAS444), the time of a conversion, and how volts become counts. Knows no pots and no angles.
Not simulated: the comparator. The thresholds can be written and read, and there is no ALERT pin.
"""

from __future__ import annotations

import random
import threading
from collections.abc import Callable
from typing import NamedTuple

CONVERSION, CONFIG, LO_THRESH, HI_THRESH = range(4)
CONFIG_RESET = 0x8583

OS_BIT = 0x8000
SINGLE_SHOT_BIT = 0x0100
FULL_SCALE_V = (6.144, 4.096, 2.048, 1.024, 0.512, 0.256, 0.256, 0.256)
RATE_SPS = (8, 16, 32, 64, 128, 250, 475, 860)
PINS: tuple[tuple[int, int | None], ...] = (
    (0, 1),
    (0, 3),
    (1, 3),
    (2, 3),
    (0, None),
    (1, None),
    (2, None),
    (3, None),
)
"""Inputs at the positive and the negative side of the converter, by setting of the multiplexer; None is GND."""

WAKE_UP_S = 25e-6
COUNTS = 32768
CLAMP_V = 0.3  # beyond this, the protection diodes conduct


class _Conversion(NamedTuple):  # forty of these in each simulated second: a tuple is made faster
    config: int
    ends_at_s: float


class Ads1115:
    """The chip. `inputs` give the volts at AIN0 to AIN3; a conversion samples them when it ends.

    The simulation runs only at a read or a write: a conversion that ended earlier samples the inputs only then. For an
    exact sample in simulated time, call `settle` at the moment that `due_s` returns.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        *,
        vdd_v: float = 3.3,
        oscillator_error: float = 0.0,
        noise_v_rms: float = 0.0,
        noise: random.Random | None = None,
    ) -> None:
        self.inputs: list[Callable[[], float]] = [lambda: 0.0] * 4
        self.vdd_v = vdd_v
        self.oscillator_error = oscillator_error
        """Relative error of the conversion time. +0.1 is 10 % longer, the datasheet's limit."""
        self.noise_v_rms = noise_v_rms
        self.frozen = False
        """Fault: conversions end as usual, but the result does not change."""
        self.early_reads = 0
        """Number of reads of the conversion register in single-shot mode before the end of the conversion."""
        self._clock = clock
        self._noise = noise or random.Random(1115)
        self._lock = threading.RLock()
        self._pointer = CONVERSION
        self._registers = [0x0000, CONFIG_RESET, 0x8000, 0x7FFF]
        self._single_shot = True
        self._running: _Conversion | None = None

    # --- I2C

    def write(self, data: bytes) -> None:
        with self._lock:
            self.settle()
            if data:
                self._pointer = data[0] & 0x03
            if len(data) < 3:
                return  # the pointer alone, or a register cut short, which the chip drops
            value = int.from_bytes(data[1:3], "big")
            if self._pointer == CONFIG:
                self._configure(value)
            elif self._pointer != CONVERSION:  # which is read only
                self._registers[self._pointer] = value

    def read(self, count: int) -> bytes:
        with self._lock:
            self.settle()
            value = self._registers[self._pointer]
            if self._pointer == CONFIG:
                value = value & ~OS_BIT | (0 if self._running else OS_BIT)
            elif self._pointer == CONVERSION and self._running and self._single_shot:
                self.early_reads += 1
            octets = value.to_bytes(2, "big")
            return octets if count == 2 else (octets * (count // 2 + 1))[:count]

    # --- conversions

    def due_s(self) -> float | None:
        """Moment of the end of the running conversion; None while the chip is powered down."""
        return self._running.ends_at_s if self._running else None

    def settle(self) -> None:
        """Finish the conversions that have ended by now."""
        if self._running is None:
            return
        with self._lock:
            now_s = self._clock()
            while self._running and now_s >= self._running.ends_at_s:
                done, self._running = self._running, None
                if not self._single_shot:
                    done = self._latest_by(now_s, done)
                    self._running = _Conversion(self._registers[CONFIG], done.ends_at_s + self._period_s)
                self._finish(done.config)

    def _configure(self, value: int) -> None:
        # A running conversion keeps its settings. The chip ignores a start order until its end.
        self._registers[CONFIG] = value
        self._single_shot = bool(value & SINGLE_SHOT_BIT)
        if self._running is None and (value & OS_BIT or not self._single_shot):
            self._running = _Conversion(value, self._clock() + WAKE_UP_S + self._period_s)

    def _latest_by(self, now_s: float, first: _Conversion) -> _Conversion:
        """The last of the conversions in continuous mode that ended up to `now_s`."""
        more = int((now_s - first.ends_at_s) / self._period_s)
        if more == 0:
            return first
        return _Conversion(self._registers[CONFIG], first.ends_at_s + more * self._period_s)

    def _finish(self, config: int) -> None:
        if not self.frozen:
            self._registers[CONVERSION] = self._measure(config) & 0xFFFF

    def _measure(self, config: int) -> int:
        positive, negative = PINS[config >> 12 & 0b111]
        volts = self._pin_v(positive)
        if negative is not None:
            volts -= self._pin_v(negative)
        if self.noise_v_rms:
            volts += self._noise.gauss(0.0, self.noise_v_rms)
        counts = round(volts / FULL_SCALE_V[config >> 9 & 0b111] * COUNTS)
        return max(-COUNTS, min(COUNTS - 1, counts))

    def _pin_v(self, pin: int) -> float:
        return max(-CLAMP_V, min(self.vdd_v + CLAMP_V, self.inputs[pin]()))

    @property
    def _period_s(self) -> float:
        return (1.0 + self.oscillator_error) / RATE_SPS[self._registers[CONFIG] >> 5 & 0b111]
