"""Where an axis is by the mean of its latest readings: one reading alone scatters too much.

Knows readings, in order of time. Knows no motor.
"""

from __future__ import annotations

from collections import deque

READINGS = 5
SETTLES_S = 0.6
"""After a run the relay has opened, the axis has come to rest and the mean has followed within this time."""


class Smoothed:
    """Give it every good reading of one axis (`see`), in order of time."""

    def __init__(self) -> None:
        self._latest: deque[float] = deque(maxlen=READINGS)

    def see(self, angle_deg: float) -> None:
        self._latest.append(angle_deg)

    def forget(self) -> None:
        """The readings mean other places than before."""
        self._latest.clear()

    @property
    def mean_deg(self) -> float | None:
        """The mean; None: there are too few readings."""
        return sum(self._latest) / READINGS if len(self._latest) == READINGS else None
