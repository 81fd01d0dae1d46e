"""The axis angles to which an order of a drill may lead, and the goals that follow.

Knows turns, the way over the top, and that a target which moves may be waited for at an end of the range. Does not
know which orders have effect.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from collections.abc import Set as AbstractSet

from benchmarks.drills.goals import TURN_DEG, ZENITH_DEG, AxisOrders, Goal, Ranges
from benchmarks.drills.script import Event

STREAM_S = 12.0
"""Two aims of one sender within this time belong to a stream, whose target moves between them."""
REMEMBERS_S = 120.0 + 96.0
"""Within this time after a target has moved the antenna may wait for it at an end of the range, or unwind there ahead
of it (docs/pointing.md)."""


class AimAngles:
    """`axes`: the orders in force, into which the goals are entered. `lacking`: the axis that was never set up; it gets
    no goal.

    `recognised`: the programs whose streams may be flown as planned. `over_top`: whether the antenna stands over the
    top.
    """

    def __init__(
        self,
        axes: dict[str, AxisOrders],
        ranges: dict[str, Ranges],
        recognised: AbstractSet[str],
        *,
        lacking: str,
        over_top: Callable[[], bool],
    ) -> None:
        self._axes = axes
        self._ranges = ranges
        self._recognised = recognised
        self._lacking = lacking
        self._over_top = over_top
        self.shifted = False
        """The panel has shifted the target in AUTO: by how much is not followed, until the mode changes."""
        self._azimuth_deg = math.nan
        self._moved_s = -math.inf
        """When an order last named another azimuth than the one before it."""

    def aim(self, event: Event, axis: str, angles_deg: tuple[float, ...], ends_deg: tuple[float, ...] = ()) -> None:
        if axis == self._lacking:
            return
        if event.who in self._recognised or self.shifted:
            self._axes[axis].goals[event.who] = Goal(said_s=event.at_s)
            return
        goals, rate_dps = self._axes[axis].goals, 0.0
        before = goals.get(event.who)
        if before and before.angles_deg and angles_deg and 0 < event.at_s - before.said_s < STREAM_S:
            nearest_deg = min(abs(angle - other) for angle in angles_deg for other in before.angles_deg)
            rate_dps = nearest_deg / (event.at_s - before.said_s)
        goals[event.who] = Goal(angles_deg, ends_deg, said_s=event.at_s, rate_dps=rate_dps)

    @property
    def shows_over_top(self) -> bool:
        """Whether the antenna stands over the top, or may go there."""
        goals = self._axes["elevation"].goals.values()
        over = any(angle_deg > ZENITH_DEG for goal in goals for angle_deg in goal.angles_deg)
        return over or self._ranges["azimuth"].flips or self._over_top()

    def aim_elevation(self, event: Event, elevation_deg: float) -> None:
        span = self._ranges["elevation"]
        angles_deg = span.elevations_deg(elevation_deg)
        before = self._axes["elevation"].goals.get(event.who)
        if before and event.what == "aim" and event.number(0) > TURN_DEG:
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self.aim(event, "elevation", angles_deg)

    def aim_azimuth(self, event: Event, elevation_deg: float) -> None:
        """Enter the goal of azimuth. An order beyond 360° may be refused: the older order then stays, for both axes."""
        span = self._ranges["azimuth"]
        turns_deg = span.turns_deg(event.number(0), elevation_deg)
        if event.number(0) != self._azimuth_deg:
            self._moved_s = -math.inf if math.isnan(self._azimuth_deg) else event.at_s
            self._azimuth_deg = event.number(0)
        ends_deg = (span.low_deg, span.high_deg) if event.at_s - self._moved_s < REMEMBERS_S else ()
        angles_deg = tuple(angle for angle in turns_deg if span.low_deg - 1.0 <= angle <= span.high_deg + 1.0)
        before = self._axes["azimuth"].goals.get(event.who)
        if before and (event.number(0) > TURN_DEG or not angles_deg):
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self.aim(event, "azimuth", angles_deg, ends_deg)
