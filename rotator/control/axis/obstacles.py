"""What may hold an axis: its stops, beyond the limits, and what has held it last in each direction.

Knows places, the limits, and the directions in which the axis was driven. Does not know what held it, nor any relay.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.control.sky.mount import Range

RESTS_BEYOND_DEG, STOP_BEYOND_DEG = 0.7, 1.0
"""An axis may come to rest beyond its limit, by its coast. Its stop is further beyond."""
HOLDS_DEG = 1.0
"""An axis that is this far past the place where it was held is free of what held it."""


class Obstacles:
    """`limits`: None: not known."""

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

    def left(self, place_deg: float) -> None:
        """The axis was moved by itself, stands here now, and has left each place that is not near."""
        kept = self._held_deg.items()
        self._held_deg = {way: held_deg for way, held_deg in kept if abs(place_deg - held_deg) <= HOLDS_DEG}

    def free(self, way: Direction, place_deg: float, beyond_deg: float = RESTS_BEYOND_DEG) -> bool:
        """Whether a powered motor could turn on in this direction from here, so far beyond its limit at most."""
        held_deg = self._held_deg.get(way)
        held = held_deg is not None and (held_deg - place_deg) * way < HOLDS_DEG
        if self._limits is None:
            return not held
        limit_deg = self._limits.max_deg if way > 0 else self._limits.min_deg
        return not held and (place_deg - limit_deg) * way <= beyond_deg
