"""How a motor was seen to turn its axis in the latest run, and how fast it turns by what its runs have shown.

Knows the readings of a run, and that they scatter: a speed counts only where it is certain. Does not know what the
run shows of the relays.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hw.ports import Direction
from rotator.control.axis.observed_motion import ObservedMotion
from rotator.control.axis.trend import Slope

SLOWED_SHARE = 0.6
"""An axis slower than this share of its run's speed has lost its current."""
POWERED_SHARE, POWERED_BELIEVED_SHARE = 0.5, 0.2
"""A powered motor turns at this share of its speed at least: of the measured speed, or of the believed one."""
END_WINDOWS_S = (0.25, 0.5, 1.0, 2.0, 4.0)
"""The end of a run is looked at for these times, one after the other, until its speed is certain."""
MEASURED_AFTER_S = 0.6
"""A run as long as this shows the motor's speed; in a shorter one it is still gathering it."""
STEADY_S = 1.5
"""After this time the motor runs at its full speed, and the run's last second shows it exactly."""
BLIND_S = 1.0
"""An axis may turn without being seen to turn, in short runs of this length in all."""
SHORTEST_WINDOW_S, LONGEST_WINDOW_S = 0.3, 4.5
"""An axis is watched for this long before it is taken to stand: longer where the readings scatter more. What they have
not shown after the longest time they do not show."""
HELD_UNSEEN_S = 0.3
"""An axis that was held for a shorter time at the end of a run seems to turn until the end."""
EXTRAPOLATED_AFTER_S = 0.2
"""If the last reading is older, the angle is extrapolated."""
EXACT_ERRORS = 6.0
"""A speed is measured when it is this many times its standard error."""


@dataclass(frozen=True, slots=True)
class EndedRun:
    """The latest run, when its relay was switched off."""

    direction: Direction
    off_s: float
    lasted_s: float
    line: Slope | None
    """How the axis turned when the run ended; None: it was not seen to turn."""
    angle_deg: float
    """Where the axis was then."""


class SeenRun:
    """Tell it when a run begins and ends, and of each reading in between, in order of time."""

    def __init__(self, seen: ObservedMotion) -> None:
        self._seen = seen
        self.line: Slope | None
        """How the present run turns the axis; None: it is not seen to turn."""
        self.ended: EndedRun | None
        self.turned_s = -math.inf
        """When the axis was last seen to turn in a run."""
        self.blind_s = 0.0
        """For how long relays were closed since the axis was last seen to turn."""
        self._fastest_dps: float
        """The fastest that the axis has turned in this run, for certain."""
        self._measured: dict[Direction, float] = {}
        self.measured_dps: float | None = None
        """The slower of the speeds that the latest runs have shown; None: no run has shown one."""
        self.begin()

    @property
    def motor_dps(self) -> float:
        """The measured speed; before the first measurement, the believed one."""
        return self.measured_dps or self._seen.believed_dps

    @property
    def powered_dps(self) -> float:
        """The least speed of a powered motor."""
        measured_dps = self.measured_dps
        if measured_dps is None:
            return POWERED_BELIEVED_SHARE * self._seen.believed_dps
        return POWERED_SHARE * measured_dps

    @property
    def unseen_s(self) -> float:
        """A powered motor may go unseen this long because of noise."""
        return max(HELD_UNSEEN_S, self._seen.trend.window_s(self.powered_dps / 3.5))

    @property
    def longest_blind_s(self) -> float:
        """A powered motor turns its axis in sight within this time."""
        return max(BLIND_S, 1.5 * self.unseen_s)

    def begin(self) -> None:
        self.line = self.ended = None
        self._fastest_dps = 0.0

    def see(self, at_s: float) -> None:
        """A reading was taken while a relay is closed."""
        self.line = self._turning(at_s, self._seen.relays.begun_s)
        if self.line is not None:
            if abs(self.line.speed_dps) >= 2.0 * EXACT_ERRORS * self.line.error_dps:
                self._fastest_dps = max(self._fastest_dps, abs(self.line.speed_dps) - 2.0 * self.line.error_dps)
            self.turned_s, self.blind_s = at_s, 0.0

    def end(self, now_s: float, direction: Direction, lasted_s: float, angle_deg: float) -> None:
        if self.line is None:
            self.blind_s += now_s - max(now_s - lasted_s, self.turned_s)
        line, self.line = self.line, None
        # In a run that went on without readings the motor may have gathered speed unseen.
        unseen_s = now_s - self.turned_s if now_s - self.turned_s > EXTRAPOLATED_AFTER_S else 0.0
        if line is not None and lasted_s - unseen_s >= MEASURED_AFTER_S:
            line = self._exactly(line, now_s) if lasted_s >= STEADY_S else line
            if abs(line.speed_dps) >= EXACT_ERRORS * line.error_dps:
                self._measured[direction] = abs(line.speed_dps)
                self.measured_dps = min(self._measured.values())
        self.ended = EndedRun(direction, now_s, lasted_s, line, angle_deg)

    def seen_after_gap(self, at_s: float, gap_s: float, angle_deg: float) -> None:
        """The first reading after a gap, with no relay closed. A computer that stood still switched the relay off when
        it went on, just before this reading: where the axis was then is seen, in place of extrapolated.
        """
        ended = self.ended
        if ended is not None and at_s - gap_s < ended.off_s and at_s <= ended.off_s + EXTRAPOLATED_AFTER_S:
            self.ended = replace(ended, angle_deg=angle_deg)

    def stands(self, at_s: float, since_s: float) -> bool:
        """Whether the readings since this moment show that no powered motor turns the axis."""
        trend = self._seen.trend
        window_s = max(SHORTEST_WINDOW_S, trend.window_s(self.powered_dps / 6.0))
        # The line counts as flat while the axis still moved in its first half: its last readings must be later.
        window_s = min(window_s + 2.0 * self._seen.behind_s, LONGEST_WINDOW_S)
        if at_s - window_s < max(since_s + self._seen.behind_s, trend.since_s):
            return False
        slope = trend.slope(at_s - window_s)
        return slope is not None and abs(slope.speed_dps) + slope.error_dps < self.powered_dps

    def _turning(self, at_s: float, since_s: float) -> Slope | None:
        """How fast the axis turns just now, for certain."""
        trend = self._seen.trend
        for window_s in END_WINDOWS_S:
            slope = trend.slope(max(since_s, at_s - window_s))
            if slope is None:
                continue
            if abs(slope.speed_dps) + 3.0 * slope.error_dps < max(self.powered_dps, POWERED_SHARE * self._fastest_dps):
                return None  # it stands, though the longer windows still contain its motion
            if abs(slope.speed_dps) < 3.5 * slope.error_dps:
                continue
            # The axis may have stopped within this window: then the window's end is slower than the whole.
            latest = trend.slope(max(since_s, at_s - max(END_WINDOWS_S[0], window_s / 4.0)))
            if latest is None:
                return None
            going_dps = latest.speed_dps * math.copysign(1.0, slope.speed_dps) + 2.0 * latest.error_dps
            return slope if going_dps >= SLOWED_SHARE * abs(slope.speed_dps) else None
        return None

    def _exactly(self, line: Slope, now_s: float) -> Slope:
        """The same speed from a longer stretch, where the axis did not change its speed within it."""
        longer = self._seen.trend.slope(now_s - 1.0)
        steady = longer is not None and abs(longer.speed_dps - line.speed_dps) <= 3.0 * line.error_dps
        return longer if longer is not None and steady and longer.error_dps < line.error_dps else line
