"""How fast a motor with a speed output turns: slowly at first, slowly before its goal, and never above its level.

Knows one motor's speeds, as shares of its full speed. Knows no angle and no target, only how far the goal is.
"""

from __future__ import annotations

import math

from rotator.control.axis.settings import SpeedSettings

LEVELS = 4
"""X1 of a GS-232 is the lowest speed, X4 full speed."""
CRAWLS_S = 0.5
"""It has had its lowest speed for so long when it is switched off: its coast is then always the same."""
GAIN_PER_S = 2.0
"""For a degree behind a target that moves, so many degrees a second more."""


class Throttle:
    """`share` is the speed from now on; without `settings` it is always 1."""

    def __init__(self, settings: SpeedSettings | None) -> None:
        self._settings = settings
        self._lowest = settings.lowest_share if settings else 1.0
        self._most = 1.0
        self._at_s: float | None = None
        self.share = self._lowest

    def limit(self, level: int) -> None:
        """1 to 4."""
        self._most = self._lowest + (1.0 - self._lowest) * (level - 1) / (LEVELS - 1)

    def rest(self) -> None:
        """The motor is off: the next run begins at the lowest speed."""
        self._at_s, self.share = None, self._lowest

    def towards(self, now_s: float, left_s: float) -> None:
        """The motor runs, and its goal is `left_s` away at full speed."""
        if (settings := self._settings) is None:
            return
        lowest = self._lowest
        brakes = 1.0 - lowest, max(settings.slow_down_s, 1e-3)
        away_s = max(0.0, left_s - lowest * CRAWLS_S)
        self._speed_up(now_s, math.sqrt(lowest * lowest + 2.0 * brakes[0] / brakes[1] * away_s))

    def along(self, now_s: float, rate: float, behind_s: float) -> bool:
        """Along with a target that moves at this share of full speed, and is `behind_s` ahead at full speed.

        False: the motor cannot turn so slowly.
        """
        if self._settings is None or rate < self._lowest:
            return False
        self._speed_up(now_s, rate + GAIN_PER_S * behind_s)
        return True

    def mean(self, way_s: float) -> float:
        """The mean speed of a run that takes `way_s` at full speed."""
        if (settings := self._settings) is None:
            return 1.0
        # From the lowest speed to the highest of this run and back to it, and the way that this takes.
        ramps_s = (settings.slow_start_s + settings.slow_down_s) / (1.0 - self._lowest)
        highest = self._lowest
        if ramps_s:
            highest = min(self._most, math.sqrt(self._lowest**2 + 2.0 * way_s / ramps_s))
        ramps_way_s = ramps_s * (highest**2 - self._lowest**2) / 2.0
        takes_s = ramps_s * (highest - self._lowest) + max(0.0, way_s - ramps_way_s) / highest
        return way_s / takes_s if takes_s else self._lowest

    def _speed_up(self, now_s: float, wanted: float) -> None:
        assert self._settings is not None
        past_s = 0.0 if self._at_s is None else now_s - self._at_s
        gathered = self.share + (1.0 - self._lowest) * past_s / max(self._settings.slow_start_s, 1e-3)
        self._at_s = now_s
        self.share = max(self._lowest, min(wanted, gathered, self._most))
