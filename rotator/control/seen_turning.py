"""How fast an axis turns that the box does not drive: by a welded relay, a hand at the control box, or the wind.

Knows the angles of the last second. Does not know why the axis turns, and stops nothing: the faults do. The speed is
for the screens, on which a person must see at a glance that the antenna turns.
"""

from __future__ import annotations

from collections import deque

WINDOW_S = 1.0
LEAST_S = 0.9
"""Angles over a shorter time show no speed: the antenna may coast a little longer than its known coast."""
SLOWEST_DPS = 0.5
NOISES = 8.0
"""A change of the angle is a turn when it is more than this many times its noise."""


class SeenTurning:
    """The angles of one axis. `note` each, and ask for the speed."""

    def __init__(self) -> None:
        self._angles: deque[tuple[float, float]] = deque()

    def note(self, at_s: float, angle_deg: float | None) -> None:
        """`angle_deg`: None while the sensor is out."""
        if angle_deg is None:
            self._angles.clear()
            return
        self._angles.append((at_s, angle_deg))
        while at_s - self._angles[0][0] > WINDOW_S:
            self._angles.popleft()

    def driven(self) -> None:
        """The axis is driven, or coasts: its present motion was ordered."""
        self._angles.clear()

    def speed_dps(self, noise_deg: float) -> float:
        """Clockwise or up is positive; 0: it stands, as far as can be seen."""
        if not self._angles:
            return 0.0
        (first_s, first_deg), (last_s, last_deg) = self._angles[0], self._angles[-1]
        seconds, moved_deg = last_s - first_s, last_deg - first_deg
        if seconds < LEAST_S or abs(moved_deg) < NOISES * noise_deg:
            return 0.0
        speed_dps = moved_deg / seconds
        return speed_dps if abs(speed_dps) >= SLOWEST_DPS else 0.0
