"""Whether a sensor can be believed: one axis's readings in, an angle or a fault out.

Knows the window of plausible readings and how long a bad one may last. Knows no device; it does not switch anything.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis
from rotator.control.calibration import Calibration
from rotator.status import Fault

BAD_FOR_S = 0.12
"""A fault needs this long of bad readings (three at 20 Hz); the very first stops the motor."""
STALE_S = 0.3


@dataclass(frozen=True, slots=True)
class Reading:
    """What a sensor said: its raw value, or why it has none."""

    at_s: float
    raw: float | None
    problem: str = ""


@dataclass(frozen=True, slots=True)
class Window:
    """Readings of a healthy sensor. With end resistors and a wiper pull, a broken wire falls outside."""

    low_raw: float
    high_raw: float


class Sensing:
    """One axis's sensor over time."""

    def __init__(self, axis: Axis, window: Window, calibration: Calibration | None) -> None:
        self._axis = axis
        self._window = window
        self.calibration = calibration
        self.raw: float | None = None
        self.angle_deg: float | None = None
        """The last believable angle; None before the first and without a calibration."""
        self.believable = False
        self._last_good_s: float | None = None
        self._first_s: float | None = None

    def take(self, reading: Reading, now_s: float) -> Fault | None:
        """Note a reading (or the same again, if no new one came). Returns the fault it amounts to, if it does."""
        self._first_s = now_s if self._first_s is None else self._first_s
        problem = self._problem(reading, now_s)
        self.believable = problem is None
        if problem is None:
            self._last_good_s = reading.at_s
            self.raw = reading.raw
            if self.calibration is not None and reading.raw is not None:
                self.angle_deg = self.calibration.degrees(reading.raw)
            return None
        since_s = self._last_good_s if self._last_good_s is not None else self._first_s
        return problem if now_s - since_s >= BAD_FOR_S else None

    def _problem(self, reading: Reading, now_s: float) -> Fault | None:
        low, high = self._window.low_raw, self._window.high_raw
        if reading.raw is None:
            return Fault("sensor silent", self._axis, reading.problem or "no answer", f"an answer in {STALE_S:g} s")
        if now_s - reading.at_s > STALE_S:
            return Fault("sensor late", self._axis, f"last reading {now_s - reading.at_s:.1f} s old", f"{STALE_S:g} s")
        if not low <= reading.raw <= high:
            self.raw = reading.raw
            return Fault("pot open or shorted", self._axis, f"reads {reading.raw:.3f}", f"{low:g} to {high:g}")
        return None
