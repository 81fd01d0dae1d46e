"""The PCA9685, sixteen 12-bit pulse outputs on I2C: pulse widths for servos, duty cycles for panel meters.

Knows the chip's registers (NXP PCA9685 rev. 4, section 7.3). Does not know what its outputs are wired to. The chip has
no watchdog: its pulses go on after the program has ended.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.ports import HardwareError, I2CBus

MODE1 = 0x00
MODE2 = 0x01
LED0_ON_L = 0x06
ALL_LED_ON_L = 0xFA
PRE_SCALE = 0xFE

SLEEP = 1 << 4
AUTO_INCREMENT = 1 << 5
RESTART = 1 << 7
TOTEM_POLE = 1 << 2
"""All other bits of MODE2 are zero: outputs are not inverted, and change together at the STOP of a write."""

CHANNELS = 16
TICKS = 4096
FULL = 1 << 4
"""In ON_H: always on. In OFF_H: always off. With both set, the output is off."""

_LEAST_PRESCALE, _GREATEST_PRESCALE = 3, 255
_OSCILLATOR_START_S = 1e-3
"""Twice the start time in the datasheet (section 7.3.1)."""


class Pca9685:
    """One chip. `frequency_hz`: pulses a second. `osc_hz`: the real frequency of its oscillator, on many boards 26 to
    27 MHz. `sleep` waits for the oscillator.

    Raises HardwareError for a frequency that the chip cannot make: outside 24 to 1526 Hz with 25 MHz.
    """

    def __init__(
        self,
        bus: I2CBus,
        address: int,
        sleep: Callable[[float], None],
        *,
        frequency_hz: float = 50.0,
        osc_hz: float = 25e6,
    ) -> None:
        self._bus = bus
        self._address = address
        self._sleep = sleep
        self._prescale = round(osc_hz / (TICKS * frequency_hz)) - 1
        if not _LEAST_PRESCALE <= self._prescale <= _GREATEST_PRESCALE:
            low_hz, high_hz = (osc_hz / (TICKS * (end + 1)) for end in (_GREATEST_PRESCALE, _LEAST_PRESCALE))
            raise HardwareError(f"{self}: it cannot make {frequency_hz:g} Hz, only {low_hz:.0f} to {high_hz:.0f} Hz")
        self.tick_us = (self._prescale + 1) / osc_hz * 1e6
        """The smallest step of a pulse's width, in microseconds."""

    def __str__(self) -> str:
        return f"PCA9685 at 0x{self._address:02x}"

    def start(self) -> None:
        """Set the chip up from any state, with every output off. Raises HardwareError when it does not answer."""
        self._write(MODE1, SLEEP | AUTO_INCREMENT)  # the frequency can be set only in sleep
        self._write(ALL_LED_ON_L, 0, 0, 0, FULL)
        self._write(PRE_SCALE, self._prescale)
        self._write(MODE2, TOTEM_POLE)
        self._write(MODE1, AUTO_INCREMENT)
        self._sleep(_OSCILLATOR_START_S)

    def check(self) -> None:
        """Raises HardwareError when a dip of the supply has reset the chip: all outputs are then off."""
        mode = self._read(MODE1) & ~RESTART
        if mode != AUTO_INCREMENT or self._read(PRE_SCALE) != self._prescale:
            raise HardwareError(f"{self}: it has been reset, its outputs are off; check its 3.3 V supply")

    @property
    def goes_on(self) -> bool:
        """Whether it runs as an earlier program has set it up: its outputs have gone on. Raises HardwareError."""
        return self._read(MODE1) == AUTO_INCREMENT and self._read(PRE_SCALE) == self._prescale

    def width_us(self, channel: int) -> float | None:
        """The width of the pulse that it makes; None: no pulse. Raises HardwareError."""
        register = bytes([LED0_ON_L + 4 * channel])
        on_l, on_h, off_l, off_h = self._bus.write_read(self._address, register, 4)
        ticks = (off_l | off_h << 8) - (on_l | on_h << 8)
        return ticks * self.tick_us if 0 < ticks < TICKS else None

    def pulse(self, channel: int, width_us: float) -> None:
        """A pulse of this width in each period. Raises HardwareError: no answer, or an impossible width."""
        ticks = round(width_us / self.tick_us)
        if not 0 < ticks < TICKS:
            raise HardwareError(
                f"{self}: the pulse must be longer than 0 and shorter than the period; {width_us:g} µs was asked"
            )
        self._set(channel, 0, ticks)

    def duty(self, channel: int, share: float) -> None:
        """On for this share of each period; below 0 counts as 0, above 1 as 1. Raises HardwareError."""
        ticks = round(share * TICKS)
        if ticks <= 0:
            self.off(channel)
        elif ticks >= TICKS:
            self._set(channel, FULL << 8, 0)
        else:
            self._set(channel, 0, ticks)

    def off(self, channel: int) -> None:
        """No pulse from now on. Raises HardwareError."""
        self._set(channel, 0, FULL << 8)

    def _set(self, channel: int, on: int, off: int) -> None:
        if not 0 <= channel < CHANNELS:
            raise HardwareError(f"{self}: there is no output {channel}; they are 0 to 15")
        self._write(LED0_ON_L + 4 * channel, *on.to_bytes(2, "little"), *off.to_bytes(2, "little"))

    def _write(self, register: int, *values: int) -> None:
        self._bus.write(self._address, bytes([register, *values]))

    def _read(self, register: int) -> int:
        return self._bus.write_read(self._address, bytes([register]), 1)[0]
