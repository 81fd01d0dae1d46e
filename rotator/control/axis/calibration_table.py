"""From a sensor's own reading to degrees on the axis's scale, by a table of points.

Knows straight lines between points. Knows no sensor, no axis and no file.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from hw.interpolation import PiecewiseLinear
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Missing

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


BEYOND_DEG = 1.0
"""An axis may stand this far beyond its calibrated ends, by its coast and the noise of its sensor."""


class EndCalibration:
    """By the two ends of the range: a person turns the axis to each end and says so (GS-232 O, F, O2, F2).

    An end is taken further in, for a narrower range, and never further out: what a link sends widens no limit.
    `configured`: the calibration in the configuration; None: the axis has none yet.
    """

    def __init__(self, limits: Range, missing: tuple[Missing, ...], configured: Calibration | None) -> None:
        self.missing = missing
        """What the axis lacks before it may be aimed."""
        self._limits = limits
        self._configured = configured
        self._first: tuple[bool, float] | None = None
        """The end that came first: whether it is the high one, and its reading."""

    def take(self, raw: float | None, calibration: Calibration | None, *, high_end: bool) -> Calibration | None:
        """The axis stands at that end and reads `raw`. Returns the new calibration; None: the other end is needed too.

        Raises ValueError where the readings are not two ends, or `raw` is None: the sensor has no good reading.
        """
        if raw is None:
            raise ValueError("the sensor has no believable reading")
        if self._configured is not None:
            self._refuse_beyond(self._configured, raw)
        if calibration is not None:
            return calibration.with_end(raw, high_end=high_end)
        if self._first is None or self._first[0] == high_end:
            self._first = (high_end, raw)
            return None
        low_raw, high_raw = (self._first[1], raw) if high_end else (raw, self._first[1])
        found = between_ends(low_raw, self._limits.min_deg, high_raw, self._limits.max_deg)
        self.missing = tuple(each for each in self.missing if each is not Missing.CALIBRATION)
        return found

    @staticmethod
    def _refuse_beyond(configured: Calibration, raw: float) -> None:
        (_, low_deg), (_, high_deg) = configured.points[0], configured.points[-1]
        angle_deg = configured.degrees(raw)
        if not low_deg - BEYOND_DEG <= angle_deg <= high_deg + BEYOND_DEG:
            raise ValueError(
                f"it stands at {angle_deg:.1f}°, outside of its calibrated {low_deg:g} to {high_deg:g}; "
                "only `rotator calibrate` takes an end further out"
            )
