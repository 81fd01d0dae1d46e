"""Which readings can be true: an axis cannot be far from where it was a moment ago.

Knows the latest readings that were believed, how fast the axis turns at most, and how much its readings scatter. Knows
no raw value and no fault.
"""

from __future__ import annotations

from collections import deque

Place = tuple[float, float]
"""A moment in seconds, and the angle in degrees read then."""

SPARK_DEG = 3.0
NOISES = 6.0
"""A reading further off than both, and than the axis can have turned, is a spark."""
AGREE = 3
"""So many sparks in a row that agree with each other are no sparks: the axis is there."""
FASTER = 2.0
"""An axis may be so many times faster than is known."""


def spark_deg(passed_s: float, fastest_dps: float, noise_deg: float) -> float:
    """Two readings further apart than this cannot be the motor's doing."""
    return max(SPARK_DEG, NOISES * noise_deg) + FASTER * fastest_dps * passed_s


class Sparks:
    """`fastest_dps`: how fast the axis turns, as far as it is known; infinite: every reading is believed."""

    def __init__(self, fastest_dps: float) -> None:
        self._fastest_dps = fastest_dps
        self._believed: Place | None = None
        self._off: deque[Place] = deque(maxlen=AGREE)

    def begin_anew(self) -> None:
        """The readings mean other places than before."""
        self._believed = None
        self._off.clear()

    def believe(self, at_s: float, angle_deg: float, noise_deg: float) -> tuple[Place, ...]:
        """The readings that are believed with this new one: none, itself, or some that agree on another place."""
        place = at_s, angle_deg
        if self._believed is None or self._near(self._believed, place, noise_deg):
            self._believed = place
            self._off.clear()
            return (place,)
        while self._off and not self._near(self._off[-1], place, noise_deg):
            self._off.popleft()
        self._off.append(place)
        if len(self._off) < AGREE:
            return ()
        places = tuple(self._off)
        self._believed = place
        self._off.clear()
        return places

    def _near(self, before: Place, place: Place, noise_deg: float) -> bool:
        passed_s = place[0] - before[0]
        return abs(place[1] - before[1]) <= spark_deg(passed_s, self._fastest_dps, noise_deg)
