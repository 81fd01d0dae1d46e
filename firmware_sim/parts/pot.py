"""The potentiometer on a rotor's shaft: shaft angle in, wiper volts out.

Knows the pot's ends, its non-linearity, its noise and its faults. Knows no motor and no converter.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from enum import Enum


class PotFault(Enum):
    """How a pot fails."""

    NONE = "none"
    OPEN = "open"
    SHORTED = "shorted"
    STUCK = "stuck"
    REVERSED = "reversed"


@dataclass(frozen=True, slots=True)
class PotSpec:
    """A pot between ground and its supply. `low_ratio` and `high_ratio`: the wiper at the ends of travel, as shares of
    the supply, with end resistors included.
    """

    low_deg: float
    high_deg: float
    low_ratio: float = 0.05
    high_ratio: float = 0.95
    noise_deg: float = 0.0
    """Gaussian noise, rms, new at each reading."""
    bow_deg: float = 0.0
    """How far the middle of the travel is off a straight line."""
    pull_ratio: float = 0.0
    """The converter's reading when the wire to the wiper breaks: its pull resistor sets it."""


@dataclass(slots=True)
class SimPot:
    """One pot on `supply_v` volts; `chance` makes its noise."""

    spec: PotSpec
    supply_v: float
    fault: PotFault = PotFault.NONE
    jump_deg: float = 0.0
    """Fault: added to the next reading only, as by a spark on the wire."""
    loose_deg: float = 0.0
    """Fault: each reading is off by a random angle up to this, either way, as with a loose wire."""
    chance: random.Random = field(default_factory=lambda: random.Random(1))
    _stuck_ratio: float = 0.0

    def volts(self, shaft_deg: float) -> float:
        """Wiper voltage with the shaft at `shaft_deg`."""
        return self.ratio(shaft_deg) * self.supply_v

    def ratio(self, shaft_deg: float) -> float:
        """The wiper as a share of the supply, 0 to 1."""
        match self.fault:
            case PotFault.OPEN:
                return self.spec.pull_ratio
            case PotFault.SHORTED:
                return 1.0
            case PotFault.STUCK:
                return self._stuck_ratio
            case _:
                ratio = self._healthy(shaft_deg)
                return 1.0 - ratio if self.fault is PotFault.REVERSED else ratio

    def stick(self, shaft_deg: float) -> None:
        """Fault: from now on the wiper stays where it is while the shaft turns."""
        self._stuck_ratio = self._healthy(shaft_deg)
        self.fault = PotFault.STUCK

    def _healthy(self, shaft_deg: float) -> float:
        spec = self.spec
        span_deg = spec.high_deg - spec.low_deg
        travel = (shaft_deg - spec.low_deg) / span_deg
        seen_deg = shaft_deg + spec.bow_deg * 4 * travel * (1 - travel) + self.jump_deg
        self.jump_deg = 0.0
        if self.loose_deg:
            seen_deg += self.chance.uniform(-self.loose_deg, self.loose_deg)
        if spec.noise_deg:
            seen_deg += self.chance.gauss(0.0, spec.noise_deg)
        share = (seen_deg - spec.low_deg) / span_deg
        ratio = spec.low_ratio + (spec.high_ratio - spec.low_ratio) * share
        return min(max(ratio, 0.0), 1.0)
