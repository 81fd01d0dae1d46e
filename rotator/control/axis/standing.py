"""Where an axis stands, how surely, and where something held it while it was driven: a stop, perhaps.

Knows places and the directions in which it was driven there. Does not know what held it, nor any relay.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Direction

SURE_ERRORS = 4.0
"""Two means of more readings are not the same place if they differ by so many standard errors."""
HOLDS_DEG = 1.0
"""So far from where it was held, and no nearer, an axis has surely left what held it."""


@dataclass(frozen=True, slots=True)
class Rest:
    """Where the axis stood: the mean of so many readings."""

    mean_deg: float
    count: int

    def differs(self, other: Rest, noise_deg: float) -> bool:
        """Whether these two are not the same place, for certain."""
        error_deg = noise_deg * math.sqrt(1.0 / self.count + 1.0 / other.count)
        return abs(self.mean_deg - other.mean_deg) > SURE_ERRORS * error_deg


class HeldPlaces:
    """The latest place for each direction."""

    def __init__(self) -> None:
        self._held_deg: dict[Direction, float] = {}

    def note(self, way: Direction, place_deg: float) -> None:
        """It stands there while it is driven that way."""
        self._held_deg[way] = place_deg

    def forget(self, way: Direction) -> None:
        self._held_deg.pop(way, None)

    def forget_all(self) -> None:
        self._held_deg.clear()

    def turned_to(self, place_deg: float) -> None:
        """It was seen to turn: what it has passed does not hold it."""
        kept = self._held_deg.items()
        self._held_deg = {way: held_deg for way, held_deg in kept if (place_deg - held_deg) * way <= HOLDS_DEG}

    def creep(self, by_deg: float) -> None:
        """Where it stands reads differently now: a sensor that drifts, for a motor does not turn so slowly."""
        self._held_deg = {way: held_deg + by_deg for way, held_deg in self._held_deg.items()}

    def left(self, place_deg: float, by_deg: float) -> None:
        """It stands there, and has left each place that is further away."""
        kept = self._held_deg.items()
        self._held_deg = {way: held_deg for way, held_deg in kept if abs(place_deg - held_deg) <= by_deg}

    def hold(self, way: Direction, place_deg: float) -> bool:
        """Whether what held it when it was driven that way may hold it there."""
        held_deg = self._held_deg.get(way)
        return held_deg is not None and (held_deg - place_deg) * way < HOLDS_DEG
