"""A simulated magnet over a chip that reads its angle: the angle in steps with noise, the field, the magnet's faults.

Knows no register and no axis.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from enum import Enum

DETECTED_MT = 8.0


class MagnetFault(Enum):
    """Faults of the magnet."""

    NONE = ""
    MISSING = "magnet-missing"
    WEAK = "magnet-weak"
    STRONG = "magnet-strong"


FIELD_MT = {MagnetFault.NONE: 60.0, MagnetFault.MISSING: 1.0, MagnetFault.WEAK: 15.0, MagnetFault.STRONG: 150.0}


class OverMagnet:
    """A chip over its magnet. `turn` gives the magnet's angle in turns; 2.25 reads like 0.25."""

    def __init__(
        self, turn: Callable[[], float], *, noise_deg_rms: float = 0.015, noise: random.Random | None = None
    ) -> None:
        self.fault = MagnetFault.NONE
        self._turn = turn
        self._noise_turn_rms = noise_deg_rms / 360.0
        self._noise = noise or random.Random(5600)

    @property
    def field_mt(self) -> float:
        return FIELD_MT[self.fault]

    def steps(self, a_turn: int) -> int:
        """The angle now, of so many steps to a turn."""
        if self.field_mt < DETECTED_MT:
            return self._noise.randrange(a_turn)  # without a magnet the angle is random
        return round((self._turn() + self._noise.gauss(0.0, self._noise_turn_rms)) * a_turn) % a_turn

    def gain(self, weakest_mt: float, strongest_mt: float, most: int) -> int:
        """The gain that makes up for the field: `most` for the weakest and below, 0 for the strongest and above."""
        lacking = (strongest_mt - self.field_mt) / (strongest_mt - weakest_mt)
        return round(most * max(0.0, min(1.0, lacking)))
