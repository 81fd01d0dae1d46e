"""A potentiometer as an angle sensor: the voltage at its wiper as a share of its supply.

Knows one input of a converter, and the supply as a number or as another input (ratiometric: drift cancels). Does not
know which converter it is, nor degrees: the calibration makes them.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.ports import AnalogInputs, AngleSource, HardwareError

REFERENCE_EVERY_S = 1.0
"""Seconds between two readings of the supply. It drifts slowly; a reading in each cycle would double the bus time."""
LEAST_REFERENCE_V = 0.5
DRIFTS_SHARE = 0.01
"""A supply that has changed by more than this since its last reading is read again: one bad sample would shift every
pot until the next reading."""


class Reference:
    """The pots' supply voltage, measured on another input of the converter every REFERENCE_EVERY_S.

    A new voltage is the middle one of three readings.
    """

    def __init__(self, adc: AnalogInputs, channel: int, clock: Callable[[], float]) -> None:
        self._adc = adc
        self._channel = channel
        self._clock = clock
        self._read_s: float | None = None
        self._volts = 0.0

    def volts(self) -> float:
        """The supply, at most REFERENCE_EVERY_S old. Raises HardwareError if it is missing or cannot be read."""
        now_s = self._clock()
        if self._read_s is None or now_s - self._read_s >= REFERENCE_EVERY_S:
            volts = self._adc.volts(self._channel)
            if abs(volts - self._volts) >= DRIFTS_SHARE * self._volts:
                again = self._adc.volts(self._channel), self._adc.volts(self._channel)
                volts = sorted((volts, *again))[1]
            if volts < LEAST_REFERENCE_V:
                raise HardwareError(f"the pots' supply reads {volts:.2f} V on input {self._channel}: is it wired?")
            self._volts, self._read_s = volts, now_s
        return self._volts


class PotSensor:
    """`supply`: volts across the pot, or the input at which they are measured."""

    source = AngleSource.MEASURED

    def __init__(self, adc: AnalogInputs, channel: int, supply: Reference | float) -> None:
        self._adc = adc
        self._channel = channel
        self._supply = supply

    def read(self) -> float:
        """The share of the supply at the wiper, 0 to 1. Raises HardwareError."""
        supply_v = self._supply.volts() if isinstance(self._supply, Reference) else self._supply
        return self._adc.volts(self._channel) / supply_v
