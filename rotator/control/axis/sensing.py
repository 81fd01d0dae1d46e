"""Whether a sensor can be believed: one axis's readings in, an angle or a fault out.

Knows the window of plausible readings, how long a bad one may last and how often a reading may jump. Knows no device,
and stops nothing.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.faults import Fault, FaultKind, Notice

BAD_FOR_S = 0.1
"""Bad readings are a fault after this time (three readings at 20 Hz). The first one stops the motor."""
STALE_S = 0.2
"""A reading older than this does not show where the antenna is now."""
JUMP_DEG = 5.0
JUMPS = 3
JUMPS_WITHIN_S = 0.3
"""A spark is two jumps, out and back. One more jump within this time means a loose wire."""
UNCALIBRATED_SPAN_DEG = 360.0
"""A pot's whole range counts as so many degrees until it is calibrated."""


@dataclass(frozen=True, slots=True)
class Condition:
    """What a rotor reports of one of its axes beside the angle."""

    fault: Fault | None = None
    """What is wrong with the axis now, as the rotor itself knows."""
    latched: bool = False
    """The rotor itself keeps that fault until it is acknowledged."""
    notice: Notice | None = None
    """What a person should know though it stops nothing."""
    lost: str = ""
    """Why the axis has to be homed before its angle is known; empty: the angle is right."""
    scale: int = 0
    """When this number changes, the same reading means another place from then on."""
    settling: bool = False
    """The axis does not follow yet, for a reason that passes by itself."""
    changes: int = 0
    """How often its contact has changed."""
    closed: bool = False
    """Its contact is closed since the last of these changes."""
    ends: frozenset[Direction] = frozenset()
    """The directions that a limit switch forbids."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What a sensor read: its raw value, or why there is none (`problem`); and the condition of the axis."""

    at_s: float
    raw: float | None
    problem: str = ""
    condition: Condition = Condition()


@dataclass(frozen=True, slots=True)
class Window:
    """Readings of a healthy sensor. With end resistors and a pulled wiper, a broken wire reads outside."""

    low_raw: float
    high_raw: float
    pot: bool = True
    """The sensor is a pot. With a broken wire a chip does not answer; a pot answers with a wrong reading."""

    @property
    def blind(self) -> bool:
        """Whether a broken wire of the pot would read like an angle, because there are no end resistors."""
        return self.pot and (self.low_raw <= 0.0 or self.high_raw >= 1.0)


ANYTHING = Window(-math.inf, math.inf, pot=False)
"""A sensor in degrees that reports itself when it cannot be believed."""


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
        """Whether the latest reading is a good one."""
        self.fresh = False
        """Whether the latest reading is a good one that had not been taken before."""
        self.believed_s: float | None = None
        """When the latest good reading was taken."""
        self._bad_since_s: float | None = None
        self._last: tuple[float, float] | None = None
        self._jumped: Fault | None = None
        self._jumps: deque[tuple[float, float]] = deque(maxlen=JUMPS)

    def take(self, reading: Reading, now_s: float) -> Fault | None:
        """Take a reading, or the same one again where no new one came. Returns the fault that it shows, if any."""
        problem = self._problem(reading, now_s)
        jumping = self._jumping(reading)
        self.believable = problem is None
        self.fresh = problem is None and reading.at_s != self.believed_s
        if problem is None:
            self.believed_s = reading.at_s
            self._bad_since_s = None
            self.raw = reading.raw
            if self.calibration is not None and reading.raw is not None:
                self.angle_deg = self.calibration.degrees(reading.raw)
            return jumping
        if self._bad_since_s is None:
            self._bad_since_s = now_s
        return problem if now_s - self._bad_since_s >= BAD_FOR_S else jumping

    def _problem(self, reading: Reading, now_s: float) -> Fault | None:
        low, high = self._window.low_raw, self._window.high_raw
        if reading.raw is None:
            return Fault(
                FaultKind.SENSOR_SILENT, self._axis, reading.problem or "no answer", f"an answer in {STALE_S:g} s"
            )
        if now_s - reading.at_s > STALE_S:
            age = f"last reading {now_s - reading.at_s:.1f} s old"
            return Fault(FaultKind.SENSOR_LATE, self._axis, age, f"{STALE_S:g} s")
        if not low <= reading.raw <= high:
            self.raw = reading.raw
            return Fault(FaultKind.POT_OPEN, self._axis, f"reads {reading.raw:.3f}", f"{low:g} to {high:g}")
        return None

    def _jumping(self, reading: Reading) -> Fault | None:
        """Out, back, and out again: no motor does that, even where each reading is plausible."""
        # No answer counts as a place too, far from any other.
        raw = reading.raw if reading.raw is not None and math.isfinite(reading.raw) else -1.0
        angle_deg = self.calibration.degrees(raw) if self.calibration else raw * UNCALIBRATED_SPAN_DEG
        if self._last is not None and reading.at_s <= self._last[0]:
            return self._jumped
        if self._last is not None and reading.at_s - self._last[0] <= JUMPS_WITHIN_S:
            jump_deg = angle_deg - self._last[1]
            if abs(jump_deg) > JUMP_DEG:
                self._jumps.append((reading.at_s, jump_deg))
        self._last, self._jumped = (reading.at_s, angle_deg), None
        if len(self._jumps) < JUMPS or reading.at_s - self._jumps[0][0] > JUMPS_WITHIN_S:
            return None
        sizes_deg = [jump_deg for _, jump_deg in self._jumps]
        if min(sizes_deg) > 0 or max(sizes_deg) < 0:
            return None  # all one way: that may be a fast rotor
        measured = f"by {max(map(abs, sizes_deg)):.0f}°, {JUMPS} times in {JUMPS_WITHIN_S:g} s"
        self._jumped = Fault(FaultKind.POT_JUMPS, self._axis, measured, f"{JUMP_DEG:g}° from one reading to the next")
        return self._jumped
