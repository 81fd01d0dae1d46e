"""Which readings can be true: an axis cannot be far from where it was a moment ago.

Knows the latest readings that were believed, how fast the axis turns at most, and how much its readings scatter. Knows
no raw value and no fault.
"""

from __future__ import annotations

import math
from collections import deque

SeenAt = tuple[float, float]
"""A moment in seconds, and the angle in degrees read then."""

SPARK_DEG = 3.0
SPARK_NOISES = 6.0
"""A spark is a reading further off than this angle, this many times the noise, and the furthest turn of the axis."""
AGREEING_SPARKS = 3
"""This many sparks in a row that agree with each other are not sparks: the axis is there."""
FASTER_THAN_KNOWN = 2.0
"""How many times faster than known an axis may be."""


def spark_deg(passed_s: float, fastest_dps: float, noise_deg: float) -> float:
    """Two readings further apart than this cannot be the motor's doing."""
    return max(SPARK_DEG, SPARK_NOISES * noise_deg) + FASTER_THAN_KNOWN * fastest_dps * passed_s


class Sparks:
    """`fastest_dps`: how fast the axis turns, as far as it is known; infinite: every reading is believed."""

    def __init__(self, fastest_dps: float) -> None:
        self._fastest_dps = fastest_dps
        self._believed: SeenAt | None = None
        """The angle, and the earliest moment at which the axis may have been there."""
        self._off: deque[tuple[SeenAt, SeenAt]] = deque(maxlen=AGREEING_SPARKS)
        """Readings that were not believed, each also with its earliest moment."""

    def begin_anew(self) -> None:
        """The readings mean other places than before."""
        self._believed = None
        self._off.clear()

    def believe(self, at_s: float, angle_deg: float, noise_deg: float, since_s: float = math.inf) -> tuple[SeenAt, ...]:
        """Returns the readings that are believed now: none, the new one, or some that agree on another place.

        `since_s`: if earlier than `at_s`, the reading is of an unknown moment between the two.
        """
        place, earliest = (at_s, angle_deg), (min(at_s, since_s), angle_deg)
        if self._believed is None or self._near(self._believed, place, noise_deg):
            self._believed = earliest
            self._off.clear()
            return (place,)
        while self._off and not self._near(self._off[-1][1], place, noise_deg):
            self._off.popleft()
        self._off.append((place, earliest))
        if len(self._off) < AGREEING_SPARKS:
            return ()
        places = tuple(each for each, _ in self._off)
        self._believed = earliest
        self._off.clear()
        return places

    def _near(self, before: SeenAt, place: SeenAt, noise_deg: float) -> bool:
        passed_s = place[0] - before[0]
        return abs(place[1] - before[1]) <= spark_deg(passed_s, self._fastest_dps, noise_deg)
