"""The way of one DC motor behind an H-bridge to its lower end, where its limit switch opens or an index shows.

Knows where the encoder has the axis, and what shows the end. The motor is off in the round of the loop in which the end
shows; where that was counts, not where the motor comes to rest. Knows no line and no clock: moments are arguments.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from hw.drives.bridge_axis import Amiss, BridgeAxis, Course
from hw.drives.end_homing import EndHoming

NEAR_COUNTS = 2.0


@dataclass(frozen=True, slots=True)
class BridgeEnd:
    """`shows`: whether the axis is at its end, at `end_deg`. `speed_dps`: of the way there. `span_deg`: of the range.

    `place`: told where the axis stands once its end is found.
    """

    shows: Callable[[], bool]
    end_deg: float
    speed_dps: float
    span_deg: float
    place: Callable[[float], None]


class BridgeHoming:
    """Call `step` in each round of the loop, until `over` or the command has expired."""

    def __init__(self, axis: BridgeAxis, end: BridgeEnd) -> None:
        self.over = False
        self.until_s = float("-inf")
        self._axis = axis
        self._end = end
        self._homing = EndHoming(self, end.span_deg, NEAR_COUNTS * axis.spec.count_deg)
        self._now_s = 0.0
        self._place_deg = 0.0
        self._shows = False
        self._met_deg: float | None = None
        """Where the end showed on this way down."""

    def step(self, now_s: float, angle_deg: float, *, stands: bool) -> None:
        """`stands`: the motor is off, and the encoder does not count."""
        self._now_s, self._place_deg, self._shows = now_s, angle_deg, self._end.shows()
        if self._met_deg is None and self._down and self._shows:
            self._meet()
        if self._met_deg is None or stands:
            self._homing.step(angle_deg, self._met_deg, self.until_s - now_s, stands=stands, at_end=self._shows)

    @property
    def _down(self) -> bool:
        course = self._axis.course
        return course is not None and course.rate_dps < 0.0

    def _meet(self) -> None:
        self._met_deg = self._place_deg
        self._axis.stop()

    # --- hw.drives.end_homing.HomingAxis

    def begin_down(self) -> None:
        self._met_deg = None

    def run_down(self, left_s: float) -> None:
        course, until_s = self._axis.course, self._now_s + left_s
        if course is not None and self._down:
            self._axis.course = replace(course, until_s=until_s)
        else:
            self._axis.course = Course(self._place_deg, -self._end.speed_dps, self._now_s, until_s)

    def run_back(self, goal_deg: float, left_s: float) -> None:
        self._met_deg = None
        self._axis.course = Course(goal_deg, 0.0, self._now_s, self._now_s + left_s)

    def found_home(self) -> None:
        assert self._met_deg is not None, "its end has shown"
        self._stop()
        self._end.place(self._end.end_deg + self._place_deg - self._met_deg)

    def not_home(self, why: str) -> None:
        self._stop()
        self._axis.amiss = Amiss.HOMING, why

    def _stop(self) -> None:
        self._axis.stop()
        self.over = True
