"""The axis angles to which an order of a drill may lead, and the goals that follow.

Knows turns, shifts by the panel, the way over the top, and targets that waver. Does not know which orders have effect.
"""

from __future__ import annotations

from collections.abc import Callable
from collections.abc import Set as AbstractSet

from benchmarks.drills.goals import TURN_DEG, ZENITH_DEG, AxisOrders, Goal, Ranges
from benchmarks.drills.script import Event
from benchmarks.drills.shifts import Shifts
from benchmarks.drills.wavering import Wavering

STREAM_S = 12.0
"""Two aims of one sender within this time belong to a stream, whose target moves between them."""


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
        self.shifts = Shifts()
        self._wavering: dict[str, Wavering] = {}
        """By sender, and under "" for all senders together: orders without effect then hide no moving target."""

    def rescaled(self) -> None:
        """The ranges are others."""
        self._wavering.clear()

    def forget(self) -> None:
        """All orders end."""
        for wavering in self._wavering.values():
            wavering.forget()

    def aim(self, event: Event, axis: str, angles_deg: tuple[float, ...], ends_deg: tuple[float, ...] = ()) -> None:
        if axis == self._lacking:
            return
        if event.who in self._recognised:
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

    def may_shift_over_top(self) -> bool:
        goals = self._axes["elevation"].goals.values()
        angles_deg = [angle_deg for goal in goals for angle_deg in goal.angles_deg]
        return any(max(self.shifts.shifted("elevation", angle_deg)) > ZENITH_DEG for angle_deg in angles_deg)

    def aim_elevation(self, event: Event, elevation_deg: float) -> None:
        span = self._ranges["elevation"]
        shifted_deg = self.shifts.shifted("elevation", elevation_deg)
        angles_deg = tuple(angle for each in shifted_deg for angle in span.elevations_deg(each))
        before = self._axes["elevation"].goals.get(event.who)
        if before and event.what == "aim" and event.number(0) > TURN_DEG:
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self.aim(event, "elevation", angles_deg)

    def aim_azimuth(self, event: Event, elevation_deg: float) -> None:
        """Enter the goal of azimuth. An order beyond 360° may be refused: the older order then stays, for both axes."""
        turns_deg = [
            angle_deg
            for shifted_deg in self.shifts.shifted("azimuth", event.number(0))
            for angle_deg in self._ranges["azimuth"].turns_deg(shifted_deg, elevation_deg)
        ]
        span = self._ranges["azimuth"]
        watched = [self._wavering.setdefault(who, Wavering(span.low_deg, span.high_deg)) for who in ("", event.who)]
        found_deg = {end_deg for each in watched for end_deg in each.ends(event.at_s, turns_deg, elevation_deg)}
        ends_deg = tuple(found_deg)
        angles_deg = tuple(angle for angle in turns_deg if span.low_deg - 1.0 <= angle <= span.high_deg + 1.0)
        before = self._axes["azimuth"].goals.get(event.who)
        if before and (event.number(0) > TURN_DEG or not angles_deg):
            angles_deg = (*angles_deg, *before.angles_deg) if before.angles_deg else ()
        self.aim(event, "azimuth", angles_deg, ends_deg)
