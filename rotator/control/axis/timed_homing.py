"""Finding the low end stop of an axis from which nothing comes back: it runs against it for longer than the way takes.

Knows what the relays do, and how long the way may be. The motor's own end switch stops it at the stop. Cannot see that
it is there: a motor that does not run is taken for one that has arrived.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from hw.ports import Direction
from rotator.control.axis.readings import LOOK_S, Condition

RESERVE_SHARE, RESERVE_S = 1.1, 3.0
"""The motor runs for this much longer than the way to its stop should take: it is slow in the cold."""


@dataclass(frozen=True, slots=True)
class TimedHomingSettings:
    """What homing needs to know of an axis that is reckoned by time."""

    home_deg: float
    """The angle of the low stop."""
    travel_deg: float
    """From stop to stop."""
    speed_dps: float
    """Towards the low stop."""
    coast_s: float
    """From the relay's opening until the motor stands."""
    rest_deg: tuple[float, float] = (-math.inf, math.inf)
    """It may come to rest everywhere: there is no contact that could show anything."""
    period_s: ClassVar[float] = 0.0

    def begin(self, furthest_deg: float | None) -> TimedHoming:
        """The way to the stop from at most `furthest_deg`; None: from anywhere."""
        way_deg = self.travel_deg
        if furthest_deg is not None:
            way_deg = min(max(furthest_deg - self.home_deg, 0.0), way_deg)
        return TimedHoming(self, RESERVE_SHARE * way_deg / self.speed_dps + RESERVE_S)


class TimedHoming:
    """One axis. Call `step` every cycle for the direction to drive, until it has `homed`."""

    failure = ""
    """Nothing shows a failure."""

    def __init__(self, settings: TimedHomingSettings, runs_s: float) -> None:
        self.home_deg = settings.home_deg
        self.homed = False
        self._coast_s = settings.coast_s
        self._left_s = runs_s
        """How much longer its relay has to be closed."""
        self._rests_s = 0.0
        """For how long it has been open since then."""
        self._at_s: float | None = None
        self.begun = False
        """The motor has been driven for it."""

    def step(self, now_s: float, driven: Direction, _condition: Condition) -> Direction:
        """The direction to drive now. `driven`: what the relays really do. Only time in which they do it counts."""
        past_s = 0.0 if self._at_s is None else min(now_s - self._at_s, LOOK_S)
        self._at_s = now_s
        if driven is Direction.MINUS:
            self.begun, self._left_s = True, self._left_s - past_s
        if self._left_s > 0.0:
            return Direction.MINUS
        self._rests_s = self._rests_s + past_s if driven is Direction.OFF else 0.0
        self.homed = self.homed or self._rests_s >= self._coast_s
        return Direction.OFF
