"""The values on the drawings and what follows from them: dividers, end resistors, the one-shot.

Knows Ohm's law and the data sheet named at each formula. Ohms, farads, volts, seconds.
"""

from __future__ import annotations

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
