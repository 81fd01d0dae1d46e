"""From a sensor's own reading to degrees on the axis's scale, by a table of points.

Knows straight lines between points. Knows no sensor, no axis and no file.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace
from itertools import pairwise

LEAST_SPAN_RAW = 0.05
"""Two ends closer than this share of the sensor's range are the same place measured twice."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """Points (raw, degrees), degrees rising, raw strictly rising or strictly falling. Raises ValueError else."""

    points: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        if len(self.points) < 2:  # a line has two ends
            raise ValueError("needs two points or more")
        if any(b[1] <= a[1] for a, b in pairwise(self.points)):
            raise ValueError("degrees must rise from point to point")
        steps = [b[0] - a[0] for a, b in pairwise(self.points)]
        if not (all(step > 0 for step in steps) or all(step < 0 for step in steps)):
            raise ValueError("readings must rise, or fall, all the way")

    def degrees(self, raw: float) -> float:
        """The axis angle for a reading; beyond the ends the last line goes on."""
        rising = self.points if self.points[-1][0] > self.points[0][0] else self.points[::-1]
        at = bisect_right(rising, raw, 1, len(rising) - 1, key=lambda point: point[0])
        (raw_a, deg_a), (raw_b, deg_b) = rising[at - 1], rising[at]
        return deg_a + (raw - raw_a) * (deg_b - deg_a) / (raw_b - raw_a)

    def with_end(self, raw: float, *, high_end: bool) -> Calibration:
        """The same curve with one end found at another reading: stretched, its shape kept. Raises ValueError."""
        old_low, old_high = self.points[0][0], self.points[-1][0]
        low, high = (old_low, raw) if high_end else (raw, old_high)
        if abs(high - low) < LEAST_SPAN_RAW or (high > low) != (old_high > old_low):
            raise ValueError(f"the ends would read {low:.3f} and {high:.3f}: too close, or the wrong way round")
        stretch = (high - low) / (old_high - old_low)
        return replace(self, points=tuple((low + (r - old_low) * stretch, deg) for r, deg in self.points))


def between_ends(low_raw: float, low_deg: float, high_raw: float, high_deg: float) -> Calibration:
    """The straight line through two ends. Raises ValueError where they are no two ends."""
    if abs(high_raw - low_raw) < LEAST_SPAN_RAW:
        raise ValueError(f"the ends read {low_raw:.3f} and {high_raw:.3f}: too close to be two ends")
    return Calibration(((low_raw, low_deg), (high_raw, high_deg)))
