"""Calibration by the two ends of the range: a person turns the axis to each end and says so (GS-232 O, F, O2, F2).

Knows the limits, the calibration that a person gave the axis, and the end that came first. Knows no sensor. An end is
taken further in, for a narrower range, and never further out: what a link sends widens no limit.
"""

from __future__ import annotations

from rotator.control.axis.calibration_table import Calibration, between_ends
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Missing

BEYOND_DEG = 1.0
"""An axis may stand this far beyond its calibrated ends, by its coast and the noise of its sensor."""


class EndCalibration:
    """`configured`: the calibration in the configuration; None: the axis has none yet."""

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
