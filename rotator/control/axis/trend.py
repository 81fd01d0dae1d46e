"""How fast an axis really turns: a straight line through its latest readings, and how exact that line is.

Knows readings, when they were taken and how much they scatter. Knows no motor, no relay and no rule.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

KEPT_S = 5.0
LEAST_GAP_S = 0.035
"""A reading that comes sooner after the last one is left out: a fast loop would only make the sums longer."""
LONGEST_GAP_S = 0.3
"""After a longer gap the line begins anew: the motion in between is not known."""
JUMP_DEG = 3.0
JUMP_READINGS = 3
"""A reading further off than this, and than the axis can have turned, is a spark, unless so many in a row agree."""

_FIRST_NOISE_DEG = 0.1
_LEAST_NOISE_DEG, _MOST_NOISE_DEG = 0.02, 1.5
_NOISE_STEP = 1.03
_BEND_MEDIAN = 0.6745 * math.sqrt(6.0)
"""The median of |a - 2b + c| for readings with a scatter of one: what a steady motion cannot hide."""


@dataclass(frozen=True, slots=True)
class Slope:
    speed_dps: float
    rough_dps: float
    """Standard error of the speed, from the noise of the readings."""


class Trend:
    def __init__(self) -> None:
        self.noise_deg = _FIRST_NOISE_DEG
        """Scatter of the readings, rms, as seen so far."""
        self._kept: deque[tuple[float, float]] = deque()
        self._strays: list[tuple[float, float]] = []

    @property
    def since_s(self) -> float:
        """Since when there are readings without a gap."""
        return self._kept[0][0] if self._kept else math.inf

    @property
    def last_s(self) -> float:
        return self._kept[-1][0] if self._kept else -math.inf

    def see(self, at_s: float, angle_deg: float, fastest_dps: float) -> bool:
        """A good reading of an axis that turns at most that fast. Returns whether it lies on the line."""
        passed_s = at_s - self.last_s
        if passed_s < LEAST_GAP_S:
            return False
        if passed_s > LONGEST_GAP_S:
            self._begin([(at_s, angle_deg)])
            return True
        if abs(angle_deg - self._kept[-1][1]) > self.jump_deg(passed_s, fastest_dps):
            near_deg = self.jump_deg(LONGEST_GAP_S, fastest_dps)
            self._strays = [stray for stray in self._strays if abs(stray[1] - angle_deg) <= near_deg]
            self._strays.append((at_s, angle_deg))
            if len(self._strays) == JUMP_READINGS:
                # It stays there: the axis is elsewhere than the line says. The line begins anew.
                self._begin(self._strays)
            return False
        self._strays.clear()
        self._kept.append((at_s, angle_deg))
        self._note_noise()
        while at_s - self._kept[0][0] > KEPT_S:
            self._kept.popleft()
        return True

    def jump_deg(self, passed_s: float, fastest_dps: float) -> float:
        """Two readings further apart than this cannot be the motor's doing."""
        return max(JUMP_DEG, 6.0 * self.noise_deg) + 2.0 * fastest_dps * passed_s

    def slope(self, from_s: float) -> Slope | None:
        """The line through the readings from that moment on; None where there are too few."""
        # Times are counted from the last reading: sums of small numbers keep their digits.
        count, sum_t, sum_x, sum_tt, sum_tx = 0, 0.0, 0.0, 0.0, 0.0
        last_s, last_deg = self._kept[-1] if self._kept else (0.0, 0.0)
        for at_s, angle_deg in reversed(self._kept):
            if at_s < from_s:
                break
            t, x = at_s - last_s, angle_deg - last_deg
            count += 1
            sum_t += t
            sum_x += x
            sum_tt += t * t
            sum_tx += t * x
        if count < JUMP_READINGS:
            return None
        spread = sum_tt - sum_t * sum_t / count
        return Slope((sum_tx - sum_t * sum_x / count) / spread, self.noise_deg / math.sqrt(spread))

    def window_s(self, rough_dps: float) -> float:
        """How long the line must be for a standard error of `rough_dps`."""
        gap_s = LEAST_GAP_S
        if len(self._kept) > 1:
            gap_s = (self.last_s - self.since_s) / (len(self._kept) - 1)
        return float((self.noise_deg * math.sqrt(12.0 * gap_s) / rough_dps) ** (2.0 / 3.0))

    def _begin(self, readings: list[tuple[float, float]]) -> None:
        self._kept = deque(readings)
        self._strays = []

    def _note_noise(self) -> None:
        """Follow the median of the bend of three readings in a row: sparks and starting motors hardly change it."""
        if len(self._kept) < 3:
            return
        bend_deg = abs(self._kept[-1][1] - 2.0 * self._kept[-2][1] + self._kept[-3][1])
        above = bend_deg > _BEND_MEDIAN * self.noise_deg
        noise_deg = self.noise_deg * _NOISE_STEP if above else self.noise_deg / _NOISE_STEP
        self.noise_deg = min(max(noise_deg, _LEAST_NOISE_DEG), _MOST_NOISE_DEG)
