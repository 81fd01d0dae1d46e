"""Calibration by the two ends of the range: a person turns the axis to each end and says so (GS-232 O, F, O2, F2).

Knows the limits, and the end that came first. Knows no sensor.
"""

from __future__ import annotations

from rotator.control.axis.calibration_table import Calibration, between_ends
from rotator.control.sky.mount import Range
from rotator.faults import Missing


class EndCalibration:
    def __init__(self, limits: Range, missing: tuple[Missing, ...]) -> None:
        self.missing = missing
        """What the axis lacks before it may be aimed."""
        self._limits = limits
        self._first: tuple[bool, float] | None = None
        """The end that came first: whether it is the high one, and its reading."""

    def take(self, raw: float, calibration: Calibration | None, *, high_end: bool) -> Calibration | None:
        """The axis stands at that end and reads `raw`. Returns the new calibration; None: the other end is needed too.

        Raises ValueError where the readings are no two ends.
        """
        if calibration is not None:
            return calibration.with_end(raw, high_end=high_end)
        if self._first is None or self._first[0] == high_end:
            self._first = (high_end, raw)
            return None
        low_raw, high_raw = (self._first[1], raw) if high_end else (raw, self._first[1])
        found = between_ends(low_raw, self._limits.min_deg, high_raw, self._limits.max_deg)
        self.missing = tuple(each for each in self.missing if each is not Missing.CALIBRATION)
        return found
