"""How a moteus moves its set point: a trapezoid of speed towards a target, which may move too.

Knows positions, speeds and limits, in revolutions and seconds. Knows no registers, no modes and no position bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

STEP_S = 1e-3
"""The step of the calculation while it accelerates; a real controller calculates at 15 to 30 kHz."""


@dataclass(frozen=True, slots=True)
class Target:
    """At `position_rev` at the moment `at_s`, with the constant speed `velocity_rev_s`. NaN as position: speed only."""

    position_rev: float
    velocity_rev_s: float
    at_s: float
    velocity_limit_rev_s: float = math.inf
    accel_limit_rev_s2: float = math.inf

    def position_at(self, now_s: float) -> float:
        return self.position_rev + self.velocity_rev_s * (now_s - self.at_s)

    @property
    def speed_rev_s(self) -> float:
        return max(-self.velocity_limit_rev_s, min(self.velocity_limit_rev_s, self.velocity_rev_s))


@dataclass(slots=True)
class SetPoint:
    """Ordered position and speed of the shaft at the moment `now_s`."""

    position_rev: float
    velocity_rev_s: float
    now_s: float
    arrived: bool = False
    """True: it has the position and the speed of the target."""

    def advance(self, target: Target, until_s: float) -> None:
        while self.now_s < until_s and not self.arrived:
            self._step(target, min(STEP_S, until_s - self.now_s))
        if self.arrived and self.now_s < until_s:
            self.position_rev += self.velocity_rev_s * (until_s - self.now_s)
            self.now_s = until_s

    def _step(self, target: Target, seconds: float) -> None:
        gain_rev_s = target.accel_limit_rev_s2 * seconds
        wanted_rev_s = self._wanted_rev_s(target, gain_rev_s)
        before_rev_s = self.velocity_rev_s
        self.velocity_rev_s += max(-gain_rev_s, min(gain_rev_s, wanted_rev_s - before_rev_s))
        self.position_rev += (before_rev_s + self.velocity_rev_s) / 2 * seconds
        self.now_s += seconds
        self._settle(target, gain_rev_s, seconds)

    def _wanted_rev_s(self, target: Target, gain_rev_s: float) -> float:
        if math.isnan(target.position_rev):
            return target.speed_rev_s
        gap_rev = target.position_at(self.now_s) - self.position_rev
        if math.isinf(target.accel_limit_rev_s2):
            closing_rev_s = math.inf if gap_rev else 0.0
        else:  # the speed that can still be braked to zero over the gap, less half a step's change
            half = gain_rev_s / 2
            closing_rev_s = math.sqrt(2 * target.accel_limit_rev_s2 * abs(gap_rev) + half * half) - half
        wanted_rev_s = target.velocity_rev_s + math.copysign(closing_rev_s, gap_rev)
        return max(-target.velocity_limit_rev_s, min(target.velocity_limit_rev_s, wanted_rev_s))

    def _settle(self, target: Target, gain_rev_s: float, seconds: float) -> None:
        even = abs(self.velocity_rev_s - target.speed_rev_s) <= max(gain_rev_s, 1e-12)
        if math.isnan(target.position_rev):
            self.arrived = self.velocity_rev_s == target.speed_rev_s
            return
        gap_rev = target.position_at(self.now_s) - self.position_rev
        reach_rev = max(gain_rev_s * seconds, 1e-9)
        unlimited = math.isinf(target.accel_limit_rev_s2) and abs(gap_rev) <= target.velocity_limit_rev_s * seconds
        if target.speed_rev_s == target.velocity_rev_s and (unlimited or (even and abs(gap_rev) <= reach_rev)):
            self.position_rev, self.velocity_rev_s = target.position_at(self.now_s), target.velocity_rev_s
            self.arrived = True
