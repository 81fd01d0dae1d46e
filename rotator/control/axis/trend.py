"""How fast an axis really turns: a straight line through its latest readings, and how exact that line is; and how fast
one turns that the box does not drive.

Knows readings, when they were taken and how much they scatter. Knows no motor, no relay and no rule. Readings may be
missing: the line lies through the others.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.sparks import SeenAt, spark_deg

KEPT_S = 5.0
LEAST_GAP_S = 0.035
"""A reading that comes sooner after the last one is left out: a fast loop would only make the sums longer."""
LONGEST_GAP_S = 0.3
"""After a longer gap a new line begins: the motion in between is not known."""
LEAST_READINGS = 3
"""A line needs this many readings."""

LONE_DEG, LONE_NOISES = 1.5, 6.0
"""A reading is a spark if it lies further than this angle, and than this many times the noise, from the one before and
from the one after, and further than the axis turns in between. It was too small to be seen at once. No motor turns out
and back so soon, and it would tilt the line."""

_FIRST_NOISE_DEG = 0.1
_FIRST_READINGS = 20
"""The first estimate of the noise is the mean scatter of this many readings."""
_MEAN = 0.7979
"""The mean of the absolute value of normal noise with an rms of 1."""
_LEAST_NOISE_DEG, _MOST_NOISE_DEG = 0.02, 1.5
_NOISE_STEP = 1.03
_MEDIAN = 0.6745
"""The median of the absolute value of normal noise with an rms of 1."""


@dataclass(frozen=True, slots=True)
class Slope:
    """How fast the line rises, in degrees a second."""

    speed_dps: float
    error_dps: float
    """Standard error of the speed, from the noise of the readings."""
    at_s: float = 0.0
    place_deg: float = 0.0
    """The middle of the line."""

    @property
    def way(self) -> Direction:
        return Direction.PLUS if self.speed_dps > 0 else Direction.MINUS


class Trend:
    """Give it every good reading of one axis (`see`), in order of time. Speeds are in degrees a second.

    `behind_s`: a reading shows a time that began at most so long ago. What two share does not scatter between them.
    """

    def __init__(self, behind_s: float = 0.0) -> None:
        self._shared_s = behind_s + LEAST_GAP_S
        self.noise_deg = _FIRST_NOISE_DEG
        """Scatter of the readings, rms, as seen up to now; of independent ones that would make as exact a line."""
        self._kept: deque[SeenAt] = deque()
        self._first: list[float] = []
        """The distance of each of the first readings from the line through its neighbours, scaled to the noise."""

    @property
    def since_s(self) -> float:
        """Since when there are readings without a gap."""
        return self._kept[0][0] if self._kept else math.inf

    @property
    def last_s(self) -> float:
        return self._kept[-1][0] if self._kept else -math.inf

    def see(self, at_s: float, angle_deg: float, fastest_dps: float, *, steady: bool = True) -> bool:
        """A good reading of an axis that turns at most that fast. Returns whether the line was continued, or begun.

        A new line begins where the axis cannot have turned so far. `steady`: its scatter may be learnt.
        """
        passed_s = at_s - self.last_s
        if passed_s < LEAST_GAP_S:
            return False
        turns_deg = spark_deg(passed_s, fastest_dps, self.noise_deg)
        if passed_s > LONGEST_GAP_S or abs(angle_deg - self._kept[-1][1]) > turns_deg:
            self._kept.clear()
        self._kept.append((at_s, angle_deg))
        if len(self._kept) >= LEAST_READINGS:
            if self._lone(fastest_dps):
                del self._kept[-2]
            elif steady:
                self._note_noise()
        while at_s - self._kept[0][0] > KEPT_S:
            self._kept.popleft()
        return True

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
        if count < LEAST_READINGS:
            return None
        spread = sum_tt - sum_t * sum_t / count
        middle_s, middle_deg = last_s + sum_t / count, last_deg + sum_x / count
        speed_dps = (sum_tx - sum_t * sum_x / count) / spread
        return Slope(speed_dps, self.noise_deg / math.sqrt(spread), middle_s, middle_deg)

    def place_deg(self, at_s: float, half_s: float) -> float | None:
        """The mean of the readings around that moment; None: there are none."""
        near = [angle_deg for seen_s, angle_deg in self._kept if abs(seen_s - at_s) <= half_s]
        return sum(near) / len(near) if near else None

    def _lone(self, fastest_dps: float) -> bool:
        """Whether the reading before the latest one lies apart from both its neighbours, on one side."""
        if len(self._first) < _FIRST_READINGS:
            return False
        (before_s, before_deg), (_, angle_deg), (after_s, after_deg) = list(self._kept)[-LEAST_READINGS:]
        out_deg, back_deg = angle_deg - before_deg, angle_deg - after_deg
        least_deg = max(LONE_DEG, LONE_NOISES * self.noise_deg) + fastest_dps * (after_s - before_s)
        return out_deg * back_deg > 0.0 and min(abs(out_deg), abs(back_deg)) > least_deg

    def _note_noise(self) -> None:
        """Follow the median of how far a reading is off the line through its nearest neighbours that share nothing with
        it: starting motors hardly change it."""
        alike = sum(self.last_s - seen_s < self._shared_s for seen_s, _ in self._kept)
        apart = list(self._kept)[::-alike]
        if len(apart) < LEAST_READINGS:
            return
        (after_s, after_deg), (at_s, angle_deg), (before_s, before_deg) = apart[:3]
        share = (at_s - before_s) / (after_s - before_s)
        off_deg = abs(angle_deg - before_deg - share * (after_deg - before_deg)) * math.sqrt(alike)
        scatter = math.sqrt(1.0 + share**2 + (1.0 - share) ** 2)
        if len(self._first) < _FIRST_READINGS:
            self._first.append(off_deg / scatter)
            first_deg = sum(self._first) / len(self._first) / _MEAN
            self.noise_deg = min(max(_FIRST_NOISE_DEG, first_deg), _MOST_NOISE_DEG)
            return
        above = off_deg > _MEDIAN * scatter * self.noise_deg
        noise_deg = self.noise_deg * _NOISE_STEP if above else self.noise_deg / _NOISE_STEP
        self.noise_deg = min(max(noise_deg, _LEAST_NOISE_DEG), _MOST_NOISE_DEG)


WINDOW_S = 1.0
LEAST_S = 0.9
"""Angles over a shorter time show no speed: the antenna may coast a little longer than its known coast."""
SLOWEST_DPS = 0.5
NOISES = 8.0
"""A change of the angle is a turn when it is more than this many times its noise."""


class SeenTurning:
    """How fast an axis turns that the box does not drive: by a welded relay, a hand at the control box, or the wind.

    The speed is for the screens, on which a person must see at a glance that the antenna turns; the faults stop it.
    `note` each of its angles, and ask for the speed.
    """

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
