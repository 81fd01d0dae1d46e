"""From a sensor's own reading to degrees on the axis's scale, by a table of points.

Knows straight lines between points. Knows no sensor, no axis and no file.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from hw.interpolation import PiecewiseLinear

LEAST_SPAN_RAW = 0.05
"""Two ends closer than this share of the sensor's range are the same place measured twice."""


@dataclass(frozen=True, slots=True)
class Calibration:
    """Points (raw, degrees), degrees rising, raw strictly rising or strictly falling. Raises ValueError else."""

    points: tuple[tuple[float, float], ...]
    _line: PiecewiseLinear = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        turned = tuple((degrees, raw) for raw, degrees in self.points)
        object.__setattr__(self, "_line", PiecewiseLinear(turned, "degrees", "readings"))

    def degrees(self, raw: float) -> float:
        """The axis angle for a reading; beyond the ends the last line goes on."""
        return self._line.inverse(raw)

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
