"""The potentiometer on a rotor's shaft: shaft angle in, wiper volts out.

Knows the ratio at the pot's ends, its non-linearity, its noise and its faults. Knows no motor and no time. Of the
converter it knows only that its input reads as ground when the wire to the wiper breaks. Not simulated: the load of the
converter on the wiper, and a dead arc.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from enum import Enum

from firmware_sim.sporadic import Sporadic

SPIKE_DEG = 90.0
"""How far off a reading with a spike is, to either side."""
BURST = 4
"""How many readings in a row a burst takes."""


class PotFault(Enum):
    """How a pot fails."""

    NONE = "none"
    OPEN = "open"
    """The wire to the wiper is broken: the converter's input reads as ground."""
    SHORTED = "shorted"
    """The wiper is connected to the supply."""
    STUCK = "stuck"
    """The wiper does not follow the shaft."""
    REVERSED = "reversed"
    """The wires at the ends are swapped."""


@dataclass(frozen=True, slots=True)
class PotSpec:
    """A pot between ground and its supply. `low_ratio` and `high_ratio`: the wiper voltage at `low_deg` and `high_deg`
    as a share of the supply, end resistors included.
    """

    low_deg: float
    high_deg: float
    low_ratio: float = 0.05
    high_ratio: float = 0.95
    noise_deg: float = 0.0
    """Gaussian noise of each reading, rms."""
    bow_deg: float = 0.0
    """Non-linearity: error in the middle of the travel. It falls to 0 at both ends."""


@dataclass(slots=True)
class SimPot:
    """One pot on `supply_v` volts. `chance` is the source of its noise."""

    spec: PotSpec
    supply_v: float
    fault: PotFault = PotFault.NONE
    jump_deg: float = 0.0
    """Fault: error of the next reading only, as from a spark on the wire."""
    loose_deg: float = 0.0
    """Fault: largest error of each reading, random and to both sides, as from a loose wire."""
    crackles: Sporadic = field(default_factory=Sporadic)
    """Fault: the wiper lifts for one reading, which is as of a broken wire."""
    spikes: Sporadic = field(default_factory=Sporadic)
    """Fault: one reading is far off, but plausible."""
    bursts: Sporadic = field(default_factory=lambda: Sporadic(BURST))
    """Fault: the wiper lifts for some readings."""
    drift_deg: float = 0.0
    """Fault: with each reading the error grows by as much."""
    chance: random.Random = field(default_factory=lambda: random.Random(1))
    _drifted_deg: float = 0.0
    _stuck_ratio: float = 0.0

    def volts(self, shaft_deg: float) -> float:
        """Wiper voltage with the shaft at `shaft_deg`."""
        return self.ratio(shaft_deg) * self.supply_v

    def ratio(self, shaft_deg: float) -> float:
        """The wiper as a share of the supply, 0 to 1."""
        if self.crackles.strikes() or self.bursts.strikes():
            return 0.0
        fault = self.fault
        if fault is PotFault.NONE:
            return self._healthy(shaft_deg)
        match fault:
            case PotFault.OPEN:
                return 0.0
            case PotFault.SHORTED:
                return 1.0
            case PotFault.STUCK:
                return self._stuck_ratio
            case PotFault.REVERSED:
                return 1.0 - self._healthy(shaft_deg)

    def break_down(self, fault: PotFault, shaft_deg: float) -> None:
        """Begin that fault with the shaft at `shaft_deg`; NONE ends it. A stuck wiper then stays at that angle."""
        if fault is PotFault.STUCK:
            self._stuck_ratio = self._healthy(shaft_deg)
        self.fault = fault

    def disturb_once(self, error_deg: float) -> None:
        """Add an error to the next reading only."""
        self.jump_deg = error_deg

    def _healthy(self, shaft_deg: float) -> float:
        spec = self.spec
        span_deg = spec.high_deg - spec.low_deg
        travel = (shaft_deg - spec.low_deg) / span_deg
        seen_deg = shaft_deg + spec.bow_deg * 4 * travel * (1 - travel) + self.jump_deg
        self.jump_deg = 0.0
        self._drifted_deg = self._drifted_deg + self.drift_deg if self.drift_deg else 0.0
        seen_deg += self._drifted_deg
        if self.spikes.strikes():
            seen_deg += self.chance.choice((-SPIKE_DEG, SPIKE_DEG))
        if self.loose_deg:
            seen_deg += self.chance.uniform(-self.loose_deg, self.loose_deg)
        if spec.noise_deg:
            seen_deg += self.chance.gauss(0.0, spec.noise_deg)
        share = (seen_deg - spec.low_deg) / span_deg
        ratio = spec.low_ratio + (spec.high_ratio - spec.low_ratio) * share
        return min(max(ratio, 0.0), 1.0)
