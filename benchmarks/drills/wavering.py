"""A target that wavers across the end of the azimuth range: for a while the antenna may wait for it at that end.

Knows the rule of docs/pointing.md: the first swing right round begins at once, each further one within two minutes
waits, up to 96 s, for a target that stays. Knows axis angles alone, and no order but those that it is given.
"""

from __future__ import annotations

WAVERS_DEG = 90.0
"""No nearer to its predecessor than this, an order is another target."""
REMEMBERS_S = 120.0 + 96.0
"""So long after the last wish for a swing, the next one may have to wait."""


class Wavering:
    def __init__(self, low_deg: float, high_deg: float) -> None:
        self._low_deg, self._high_deg = low_deg, high_deg
        self._before_deg: tuple[float, ...] = ()
        """Where the order before could be met, also beyond the range."""
        self._swung_s = float("-inf")

    def forget(self) -> None:
        """Nothing is ordered any more; the swings made count on."""
        self._before_deg = ()

    def ends(self, now_s: float, turns_deg: list[float]) -> tuple[float, ...]:
        """The ends of the range where the target may be waited for. `turns_deg`: all angles that show there, on every
        turn, also beyond the range."""
        near_deg = [
            angle_deg
            for angle_deg in turns_deg
            if any(abs(angle_deg - other_deg) <= WAVERS_DEG for other_deg in self._before_deg)
        ]
        beyond_deg = [angle_deg for angle_deg in near_deg if not self._low_deg <= angle_deg <= self._high_deg]
        within_deg = [angle_deg for angle_deg in turns_deg if self._low_deg <= angle_deg <= self._high_deg]
        may_wait = bool(beyond_deg) and now_s - self._swung_s <= REMEMBERS_S
        if beyond_deg:
            self._swung_s = now_s
        self._before_deg = (*within_deg, *(beyond_deg if may_wait else ()))
        if not may_wait:
            return ()
        return tuple({min(max(angle_deg, self._low_deg), self._high_deg) for angle_deg in beyond_deg})
