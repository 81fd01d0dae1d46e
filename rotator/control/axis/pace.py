"""How fast a positioned axis turns, and where it would come to rest: bounds, from its latest readings.

Knows readings, the drive's speed and how hard it brakes. Where the angle is only modelled, the motor may be slower than
the model: so it may be anywhere from where it was for certain to where the model has it. Knows no goal and no sector.
"""

from __future__ import annotations

import math
from collections import deque

from hw.ports import AngleSource
from rotator.control.axis.reach import FASTER_THAN_FILE
from rotator.control.axis.settings import PositionedSettings
from rotator.control.sky.mount import Range

SLOWEST_SHARE = 0.3
"""A motor whose angle is modelled turns at this share of its speed at least."""
OVER_S = 0.15
"""The speed is taken over this time. Within it the drive may have gathered more."""
OBEYS_S = 0.1
"""A drive obeys within this time."""
STANDS_DEG = 0.3
"""An axis without a known acceleration stands when its readings of that time differ by less."""


class Pace:
    """Give it every good reading (`see`) and every place to which the drive is sent (`sent`), in order of time."""

    def __init__(self, settings: PositionedSettings) -> None:
        self._settings = settings
        self._modelled = settings.source is AngleSource.MODELLED
        self._readings: deque[tuple[float, float]] = deque(maxlen=16)
        self._behind: Range | None = None
        """Where a modelled axis may be: at its model, or behind it, on either side where the model has turned back."""
        self._place_deg: float | None = None
        """Where the axis was sent last, to rest there."""
        self._stops = False
        """The axis had room to brake, so it will not overshoot."""

    def see(self, at_s: float, angle_deg: float) -> None:
        """A new good reading."""
        behind = self._behind or Range(angle_deg, angle_deg)
        follows_deg = (
            SLOWEST_SHARE * self._settings.speed_dps * (at_s - self._readings[-1][0] if self._readings else 0.0)
        )
        self._behind = Range(min(angle_deg, behind.min_deg + follows_deg), max(angle_deg, behind.max_deg - follows_deg))
        self._readings.append((at_s, angle_deg))

    def sent(self, now_s: float, place_deg: float) -> None:
        """The axis is sent to rest at `place_deg` from now on."""
        if not self._readings:
            return
        if place_deg != self._place_deg:
            self._place_deg, self._stops = place_deg, False
        ahead_deg, span = place_deg - self._readings[-1][1], self._braking_span(now_s)
        near_deg = self._settings.near_deg
        able = span.max_deg <= place_deg + near_deg if ahead_deg > 0 else span.min_deg >= place_deg - near_deg
        self._stops = self._stops or able

    def moves_on(self) -> None:
        """The target moves: the axis may go beyond the place to which it was sent last."""
        self._place_deg, self._stops = None, False

    def span(self, now_s: float) -> Range:
        """Where the axis may be from now until it rests, if it must stop now. Needs a reading."""
        span = self._braking_span(now_s)
        if not self._stops or self._modelled or self._place_deg is None:
            return span
        angle_deg, near_deg, place_deg = self._readings[-1][1], self._settings.near_deg, self._place_deg
        least_deg, most_deg = span.min_deg, span.max_deg
        if place_deg >= angle_deg - near_deg:
            most_deg = max(angle_deg, min(most_deg, place_deg + near_deg))
        if place_deg <= angle_deg + near_deg:
            least_deg = min(angle_deg, max(least_deg, place_deg - near_deg))
        return Range(least_deg, most_deg)

    def _braking_span(self, now_s: float) -> Range:
        at_s, angle_deg = self._readings[-1]
        span = Range(angle_deg, angle_deg)
        if self._modelled:
            assert self._behind is not None
            return self._behind.widened(self._settings.near_deg)
        blind_s = now_s - at_s + OBEYS_S
        for speed_dps in self._speeds_dps(at_s, angle_deg):
            ahead_deg = abs(speed_dps) * blind_s + self.braking_deg(speed_dps)
            span = span.spanning(angle_deg + math.copysign(ahead_deg, speed_dps))
        return span

    def braking_deg(self, speed_dps: float) -> float:
        """How far it takes to come to rest from that speed."""
        accel_dps2 = self._settings.accel_dps2
        return speed_dps**2 / (2.0 * accel_dps2) if accel_dps2 else 0.0

    def _speeds_dps(self, at_s: float, angle_deg: float) -> tuple[float, ...]:
        """The least and the greatest speed that it may have."""
        before_s, before_deg = next(each for each in self._readings if each[0] >= at_s - OVER_S - 1e-6)
        fastest_dps, accel_dps2 = FASTER_THAN_FILE * self._settings.speed_dps, self._settings.accel_dps2
        gone_deg = angle_deg - before_deg
        if accel_dps2 is None:
            return () if abs(gone_deg) < STANDS_DEG else (math.copysign(fastest_dps, gone_deg),)
        speed_dps = gone_deg / (at_s - before_s) if at_s > before_s else 0.0
        more_dps = accel_dps2 * OVER_S
        return max(speed_dps - more_dps, -fastest_dps), min(speed_dps + more_dps, fastest_dps)
