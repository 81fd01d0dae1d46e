"""Where an axis stands, how surely, and what may hold it there.

Knows places, the limits, and the directions in which the axis was driven. Does not know what held it, nor any relay.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.sky.mount import Range

SURE_ERRORS = 4.0
"""Two means differ for certain if they are this many standard errors apart."""
KEPT_READINGS = 20
LANDED_READINGS = 3
"""When the axis is first taken to stand, only this many of the latest readings are sure to be later than its coast."""
BEYOND_DEG = 0.5
"""An axis may come to rest this far beyond its limit: its stop is further beyond."""
STOP_BEYOND_DEG = 1.0
"""A stop is at least this far beyond its limit."""
HOLDS_DEG = 1.0
"""An axis that is this far past the place where it was held is free of what held it."""


@dataclass(frozen=True, slots=True)
class Rest:
    """A place where the axis stood: the mean of `count` readings."""

    mean_deg: float
    count: int

    def differs(self, other: Rest, noise_deg: float) -> bool:
        """Whether these two are different places for certain."""
        error_deg = noise_deg * math.sqrt(1.0 / self.count + 1.0 / other.count)
        return abs(self.mean_deg - other.mean_deg) > SURE_ERRORS * error_deg


class RestPlace:
    """Where the axis stands since its relays opened, and where it was before it was driven without being seen to turn.

    Give it the readings without a relay on (`see`), and each reading at which the axis is found to stand (`stand`).
    """

    def __init__(self) -> None:
        self.at_deg: float | None = None
        """Where the axis stands; None: it has not come to rest yet, or it has been moved."""
        self.since_s: float | None = None
        """Since when it stands there."""
        self._readings: deque[float] = deque(maxlen=KEPT_READINGS)
        """The latest readings since all relays opened."""
        self._rest: Rest
        """By those readings, when the axis was last found to stand."""
        self._start: Rest | None = None
        """Where the axis was before the first run that was not seen to turn it; None: the latest run was seen to."""
        self._at_start = False
        """The axis has not been driven since it stood at `_start`."""

    def driven(self) -> None:
        """A relay closes."""
        self._readings.clear()
        self._at_start = False
        self.moved()

    def moved(self) -> None:
        """The axis does not stand at its last place any more."""
        self.at_deg = self.since_s = None

    def turned(self) -> None:
        """A run was seen to turn it."""
        self._start = None

    def held(self, mean_deg: float, count: int) -> None:
        """A run does not turn it: it stands where the mean of these readings is."""
        self._start = self._start or Rest(mean_deg, count)

    def see(self, angle_deg: float) -> None:
        self._readings.append(angle_deg)

    def stand(self, at_s: float) -> float:
        """The axis stands now. Returns how far its place reads from the last one: the drift of its sensor."""
        if self.since_s is None:
            self.since_s = at_s
            while len(self._readings) > LANDED_READINGS:
                self._readings.popleft()
        rest = self._rest = Rest(sum(self._readings) / len(self._readings), len(self._readings))
        drift_deg = 0.0 if self.at_deg is None else rest.mean_deg - self.at_deg
        self.at_deg = rest.mean_deg
        if self._start is not None:
            self._start = Rest(self._start.mean_deg + drift_deg, self._start.count)
        return drift_deg

    def left_deg(self, noise_deg: float) -> float | None:
        """The place that it has left in runs that were not seen to turn it; None: it may be there still.

        From then on it counts as standing here. Call it after `stand`.
        """
        rest, start = self._rest, self._start
        if start is None or self._at_start:
            self._start, self._at_start = rest, True
        elif rest.differs(start, noise_deg):
            self._start, self._at_start = rest, True
            return start.mean_deg
        return None


class Obstacles:
    """What may hold the axis: its stops, beyond the limits, and what held it last in each direction.

    `limits`: None: not known.
    """

    def __init__(self, limits: Range | None) -> None:
        self._limits = limits
        self._held_deg: dict[Direction, float] = {}
        """Where something held it, by the direction in which it was driven."""

    def note(self, way: Direction, place_deg: float) -> None:
        """The axis stands there while it is driven that way."""
        self._held_deg[way] = place_deg

    def forget(self, way: Direction) -> None:
        self._held_deg.pop(way, None)

    def forget_all(self) -> None:
        self._held_deg.clear()

    def turned_to(self, place_deg: float) -> None:
        """The axis was seen to turn to this place: nothing held it where it has passed."""
        kept = self._held_deg.items()
        self._held_deg = {way: held_deg for way, held_deg in kept if (place_deg - held_deg) * way <= HOLDS_DEG}

    def drift(self, by_deg: float) -> None:
        """The same places read differently now: the sensor drifts. No motor turns so slowly."""
        self._held_deg = {way: held_deg + by_deg for way, held_deg in self._held_deg.items()}

    def left(self, place_deg: float, by_deg: float) -> None:
        """The axis stands here, and has left each place that is further away than `by_deg`."""
        kept = self._held_deg.items()
        self._held_deg = {way: held_deg for way, held_deg in kept if abs(place_deg - held_deg) <= by_deg}

    def free(self, way: Direction, place_deg: float, beyond_deg: float = BEYOND_DEG) -> bool:
        """Whether a powered motor could turn on in this direction from here, so far beyond its limit at most."""
        held_deg = self._held_deg.get(way)
        held = held_deg is not None and (held_deg - place_deg) * way < HOLDS_DEG
        if self._limits is None:
            return not held
        limit_deg = self._limits.max_deg if way > 0 else self._limits.min_deg
        return not held and (place_deg - limit_deg) * way <= beyond_deg
