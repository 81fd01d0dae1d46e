"""The values on the drawings and what follows from them: dividers, end resistors, the one-shot.

Knows Ohm's law and the data sheet named at each formula. Ohms, farads, volts, seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

PI_SUPPLY_V = 3.3
ADC_LIMIT_V = PI_SUPPLY_V + 0.3
"""What an ADS1115 on 3.3 V bears at an input."""

POT_OHM, POT_END_OHM, POT_PULL_OHM = 500, 33, 100_000
"""The F1EFW box: each pot, the resistor at each of its ends, the pull from its wiper to ground."""

DIVIDER_UPPER_OHM, DIVIDER_LOWER_OHM = 56_000, 100_000
"""From 5 V down to what the converter bears."""


def divided_v(volts: float) -> float:
    """What is left behind the divider."""
    return volts * DIVIDER_LOWER_OHM / (DIVIDER_UPPER_OHM + DIVIDER_LOWER_OHM)


@dataclass(frozen=True, slots=True)
class OneShot:
    """A CD74HCT4538: the pulse lasts 0.7 R C from the last trigger on (Texas Instruments SCHS123).

    The data sheet lets 10 kΩ and 0.1 µF last 0.63 to 0.77 ms at 5 V, so the 0.7 is 0.63 to 0.77.
    """

    ohm: float = 330_000
    farad: float = 2.2e-6
    ohm_tolerance: float = 0.01
    farad_tolerance: float = 0.10

    @property
    def pulse_s(self) -> float:
        return 0.7 * self.ohm * self.farad

    @property
    def shortest_s(self) -> float:
        return 0.63 * self.ohm * (1 - self.ohm_tolerance) * self.farad * (1 - self.farad_tolerance)

    @property
    def longest_s(self) -> float:
        return 0.77 * self.ohm * (1 + self.ohm_tolerance) * self.farad * (1 + self.farad_tolerance)


BASE_OHM = 1_000
"""Between the one-shot's output and the transistor."""


@dataclass(frozen=True, slots=True)
class ContactLoop:
    """The loop through a cam's contact on the tower: half-wave rectified from the motors' transformer, an opto's LED.

    A transformer of so little load gives more than is written on it; the resistor bears that too.
    """

    transformer_v: float = 24.0
    farad: float = 100e-6
    ohm: float = 3_300
    diode_v: float = 0.7
    led_v: float = 1.2
    mains_hz: float = 50.0

    @property
    def supply_v(self) -> float:
        return self.transformer_v * 2**0.5 - self.diode_v

    @property
    def led_a(self) -> float:
        return (self.supply_v - self.led_v) / self.ohm

    @property
    def resistor_w(self) -> float:
        return self.led_a**2 * self.ohm

    @property
    def ripple_v(self) -> float:
        """With both contacts closed."""
        return 2 * self.led_a / self.mains_hz / self.farad


SWITCH_PULL_OHM = 1_000
"""From the servo board's OE to 3.3 V: stronger than the 10 kΩ that many boards have from OE to ground."""

BUS_FARAD = 4_700e-6
"""Across the moteus controllers' supply."""


def braked_v(supply_v: float, inertia_kgm2: float, speed_dps: float, farad: float) -> float:
    """The volts on the capacitor after it has taken all of a turning antenna's energy, and no supply took any."""
    joule = 0.5 * inertia_kgm2 * math.radians(speed_dps) ** 2
    return math.sqrt(supply_v**2 + 2 * joule / farad)


METER_FULL_A, METER_SERIES_OHM, METER_TRIMMER_OHM = 1e-3, 2_200, 2_500
"""A 0 to 1 mA meter on an output of 3.3 V: the fixed resistor and the trimmer that sets its full scale."""

LAMP_OHM = 330

KNOB_OHM, KNOB_END_OHM, KNOB_PULL_OHM = 10_000, 680, 1_000_000
"""A panel's knob, the resistor at either end of it, and the one from its wiper to ground."""
