"""Whether a sensor can be believed: one axis's readings in, an angle or a fault out.

Knows what a bad reading is (no answer, too old, outside of the window, too far from the one before), how long bad ones
may last, how many there may be and how often a reading may jump. Knows no device, and stops nothing.
"""

from __future__ import annotations

import math
from collections import deque

from hw.ports import Axis
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import LOOK_S, LOOKED_AT, TOO_MANY_BAD, BadReadings, Reading, Window
from rotator.control.axis.sparks import SeenAt, Sparks
from rotator.exchange.faults import Fault, FaultKind, Notice

BAD_FOR_S = 0.09
"""Bad readings are a fault after this time (the third one in a row at 20 Hz, the sixth at 50 Hz)."""
COUNTED_IN_A_ROW = 2
"""Longer gaps do not enter this count; BAD_FOR_S handles them."""
RIDDEN_S = 0.16
"""A running motor may go on for this long after the last good reading."""
STALE_S = 0.2
"""A reading older than this does not show where the antenna is now."""
JUMP_DEG = 5.0
JUMPS = 3
JUMPS_WITHIN_S = 0.3
"""A spark is two jumps, out and back. One more jump within this time means a loose wire."""
JUMP_LIMIT = f"{JUMP_DEG:g}° more than its motor can turn"
MOVES, MOVES_WITHIN_S = 3, 120.0
"""A sensor whose readings jump to another place and stay there this often does not show where the axis is."""
JUMPED_SHOWN_S = 60.0
JUMPED = Notice("its readings jumped to another place and stay there: look at the sensor and its wires", "JUMPED")
UNCALIBRATED_SPAN_DEG = 360.0
"""Until a pot is calibrated its whole range counts as this many degrees."""


class Sensing:
    """One axis's sensor over time. `fastest_dps`: the speed of its motor; infinite: the readings never jump."""

    def __init__(
        self, axis: Axis, window: Window, calibration: Calibration | None, fastest_dps: float = math.inf
    ) -> None:
        self._axis = axis
        self._window = window
        self.calibration = calibration
        self.raw: float | None = None
        self.angle_deg: float | None = None
        """The last believable angle; None before the first and without a calibration."""
        self.believable = False
        """Whether the latest reading is a good one."""
        self.places: tuple[SeenAt, ...] = ()
        """The angles that the latest reading shows for the first time, each with its moment: one, or none; or some at
        once where the axis turns out to be somewhere else. Without a calibration, in degrees of the sensor's span."""
        self._sparks = Sparks(fastest_dps)
        self._rate = BadReadings()
        self._seen_s = -math.inf
        """When the latest reading was taken, a bad one too."""
        self._missed = 0
        self._in_a_row = 0
        """How many bad readings have come since the last good one."""
        self._off_line: Fault | None = None
        """The latest reading is a spark."""
        self._loose: Fault | None = None
        """There is a spark among the bad readings since the last good one."""
        self.believed_s = -math.inf
        """When the latest good reading was taken."""
        self._bad_since_s: float | None = None
        """Since when the readings are bad, in `_looked_s`."""
        self._looked_s, self._now_s = 0.0, -math.inf
        """For how long the box has looked at this axis, in which time evidence counts; and when it looked last."""
        self._slept_until_s = -math.inf
        """When the box went on after it had stood still."""
        self._last: SeenAt | None = None
        self._jumped: Fault | None = None
        self._jumps: deque[SeenAt] = deque(maxlen=JUMPS)
        self._moved_s: deque[float] = deque(maxlen=MOVES)

    @property
    def notice(self) -> Notice | None:
        """What a person should know of the sensor though it stops nothing."""
        jumped = bool(self._moved_s) and self._seen_s - self._moved_s[-1] < JUMPED_SHOWN_S
        return self._rate.notice or (JUMPED if jumped else None)

    @property
    def ridden_until_s(self) -> float:
        """Until when a motor that runs may go on with the last good reading."""
        return math.inf if self.believable else self.believed_s + RIDDEN_S

    def begin_anew(self, calibration: Calibration | None) -> None:
        """The scale has changed: from now on the same reading means another place."""
        self.calibration = calibration
        self._sparks.begin_anew()
        self._last = None
        self._jumps.clear()
        self._moved_s.clear()

    def take(self, reading: Reading, now_s: float, noise_deg: float = 0.0) -> Fault | None:
        """Take a reading, or the same one again where no new one came. Returns the fault that it shows, if any.

        `noise_deg`: the scatter of the readings, rms.
        """
        if now_s - self._now_s > LOOK_S:
            self._slept_until_s = now_s
        self._looked_s += min(now_s - self._now_s, LOOK_S)
        self._now_s = now_s
        new = reading.at_s > self._seen_s
        missed, self._missed = reading.condition.missed > self._missed, reading.condition.missed
        self._seen_s = max(self._seen_s, reading.at_s)
        self.places = ()
        angle_deg = self._degrees(reading.raw) if new and reading.raw is not None else None
        jumping = self._jumping(reading.at_s, angle_deg)
        problem = self._problem(reading, now_s) or self._spark(reading, angle_deg, noise_deg)
        self.believable = problem is None
        if problem is None:
            self.believed_s, self._bad_since_s, self._loose = reading.at_s, None, None
        elif self._bad_since_s is None:
            self._bad_since_s = self._looked_s
        lasts = self._bad_since_s is not None and self._looked_s - self._bad_since_s >= BAD_FOR_S
        # Bad readings that last, and faults that the rotor reports, are faults by themselves: they do not count here.
        # What the box itself slept through is no fault of the sensor.
        slept = (missed or reading.late) and reading.since_s <= self._slept_until_s
        if new and not lasts and not slept and reading.condition.fault is None:
            bad = problem is not None or missed
            self._in_a_row = self._in_a_row + 1 if bad else 0
            if self._in_a_row <= COUNTED_IN_A_ROW:
                self._rate.note(reading.at_s, bad=bad)
        return jumping or ((self._loose or problem) if lasts else self._too_many(now_s, problem))

    def _problem(self, reading: Reading, now_s: float) -> Fault | None:
        low, high = self._window.low_raw, self._window.high_raw
        if reading.late:
            return Fault(FaultKind.SENSOR_LATE, self._axis, reading.problem, f"{STALE_S:g} s")
        if reading.raw is None:
            return Fault(
                FaultKind.SENSOR_SILENT, self._axis, reading.problem or "no answer", f"an answer in {STALE_S:g} s"
            )
        if now_s - reading.at_s > STALE_S:
            age = f"last reading {now_s - reading.at_s:.1f} s old"
            return Fault(FaultKind.SENSOR_LATE, self._axis, age, f"{STALE_S:g} s")
        if not (low <= reading.raw <= high and math.isfinite(reading.raw)):
            self.raw = reading.raw
            return Fault(FaultKind.POT_OPEN, self._axis, f"reads {reading.raw:.3f}", f"{low:g} to {high:g}")
        return None

    def _spark(self, reading: Reading, angle_deg: float | None, noise_deg: float) -> Fault | None:
        """A plausible reading: is it the place of the axis? If so, it counts from now on."""
        if angle_deg is None:
            return self._off_line
        places = self._sparks.believe(reading.at_s, angle_deg, noise_deg, reading.since_s)
        if not places:
            measured = f"from {self._degrees(self.raw or 0.0):.0f}° to {angle_deg:.0f}° in a moment"
            self._off_line = Fault(FaultKind.POT_JUMPS, self._axis, measured, JUMP_LIMIT)
            self._loose = self._loose or self._off_line
            return self._off_line
        self._off_line = None
        self.raw = reading.raw
        self.places = places
        if self.calibration is not None:
            self.angle_deg = angle_deg
        if len(places) > 1:
            self._moved_s.append(reading.at_s)
        return None

    def _too_many(self, now_s: float, latest: Fault | None) -> Fault | None:
        """The fault of too many bad readings, or of readings that jumped to another place too often."""
        if len(self._moved_s) == MOVES and now_s - self._moved_s[0] < MOVES_WITHIN_S:
            self._moved_s.clear()
            measured = f"to another place, {MOVES} times in {MOVES_WITHIN_S:g} s"
            return Fault(FaultKind.POT_JUMPS, self._axis, measured, JUMP_LIMIT)
        count = self._rate.count
        if not self._rate.too_many(now_s):
            return None
        last = f", now {latest.name}" if latest else ""
        measured = f"{count} of the last {LOOKED_AT}{last}"
        return Fault(FaultKind.BAD_READINGS, self._axis, measured, f"{TOO_MANY_BAD} of {LOOKED_AT}")

    def _degrees(self, raw: float) -> float:
        raw = raw if math.isfinite(raw) else -1.0
        return self.calibration.degrees(raw) if self.calibration else raw * UNCALIBRATED_SPAN_DEG

    def _jumping(self, at_s: float, angle_deg: float | None) -> Fault | None:
        """Out, back, and out again: no motor does that, even where each reading is plausible. None: no new reading."""
        if angle_deg is None:
            return self._jumped
        if self._last is not None and at_s - self._last[0] <= JUMPS_WITHIN_S:
            jump_deg = angle_deg - self._last[1]
            if abs(jump_deg) > JUMP_DEG:
                self._jumps.append((at_s, jump_deg))
        self._last, self._jumped = (at_s, angle_deg), None
        if len(self._jumps) < JUMPS or at_s - self._jumps[0][0] > JUMPS_WITHIN_S:
            return None
        sizes_deg = [jump_deg for _, jump_deg in self._jumps]
        if abs(sum(sizes_deg)) == sum(map(abs, sizes_deg)):
            return None  # all one way: that may be a fast rotor
        measured = f"by {max(map(abs, sizes_deg)):.0f}°, {JUMPS} times in {JUMPS_WITHIN_S:g} s"
        self._jumped = Fault(FaultKind.POT_JUMPS, self._axis, measured, f"{JUMP_DEG:g}° from one reading to the next")
        return self._jumped
