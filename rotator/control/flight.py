"""A planned pass while it is flown: the goal of each axis at this moment, and the direction to show; and whether the
orders of a program still agree with the path that is flown in their place.

Knows the plan as ordered. Knows nothing of how it was made, how a satellite was recognised, or of faults.
"""

from __future__ import annotations

from bisect import bisect_right

from hw.ports import Axis
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, great_circle_deg
from rotator.control.sky.goal import EVEN, AimGoal
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range, Unreachable
from rotator.control.sky.plan import OFFSETS_S, Path
from rotator.control.sky.route import Way
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan, Fly
from rotator.exchange.orders import Aim
from rotator.exchange.program_clock import ProgramClock
from rotator.exchange.sources import Source
from rotator.exchange.status import Flown

CLOCK_STEP_S = 0.25
QUIET_S = 20.0
"""A stream has ended after this time without an order. Some programs send only when a whole degree has changed."""


class Following:
    """Whether the orders of a program still agree with the path. `order.stream` must be there; `source` sends it."""

    def __init__(self, order: Fly, source: Source, now_s: float) -> None:
        assert order.stream is not None, "a flight in place of a stream names it"
        self.source = source
        self._path = KnownPath(order.path)
        self._heard_s = now_s
        least_s, most_s = order.stream.ahead_s
        count = int((most_s - least_s) / CLOCK_STEP_S) + 1
        self._clock = ProgramClock((least_s + CLOCK_STEP_S * step for step in range(count)), order.stream.rounding_deg)

    def agrees(self, source: Source, aim: Aim, now_s: float) -> bool:
        """Whether this order is one more of the stream. Any other order ends the flight."""
        azimuth_deg, elevation_deg = aim.azimuth_deg, aim.elevation_deg
        if source != self.source or not aim.engaged or aim.place or azimuth_deg is None or elevation_deg is None:
            return False
        if azimuth_deg > FULL_TURN_DEG or elevation_deg > ZENITH_DEG:  # the program plans by itself
            return False

        def apart_deg(ahead_s: float) -> float:
            path_azimuth_deg, path_elevation_deg = self._path.direction(now_s + ahead_s)
            # Programs send no elevation below zero.
            risen_deg = max(0.0, path_elevation_deg)
            return great_circle_deg(azimuth_deg, elevation_deg, path_azimuth_deg, risen_deg)

        if not self._clock.agrees(apart_deg):
            return False
        self._heard_s = now_s
        return True

    def silent(self, now_s: float) -> bool:
        return now_s - self._heard_s > QUIET_S


STEP_TOLERANCE_DEG = 0.3
"""How near to the place of a step the axis comes to rest. A step is longer."""
AGAIN_S = 0.5
"""How often an axis without relays is given the next piece of its path."""


class Flight:
    """`following`: the stream in whose place the pass is flown; None: the pass itself was ordered.

    Raises Unreachable where the plan leaves the limits of an axis.
    """

    def __init__(self, order: Fly, mount: Mount, following: Following | None = None) -> None:
        self._mount = mount
        _check(order.azimuth, mount.azimuth, Axis.AZIMUTH)
        _check(order.elevation, mount.elevation, Axis.ELEVATION)
        self.following = following
        self._path = KnownPath(order.path)
        self._plans = {Axis.AZIMUTH: order.azimuth, Axis.ELEVATION: order.elevation}
        rises_s = self._path.begin_s if order.rises_s is None else order.rises_s
        sets_s = self._path.end_s if order.sets_s is None else order.sets_s
        self.flown = Flown(
            order.name,
            rises_s,
            sets_s,
            order.expected_error_deg,
            recognised=following is not None,
            beyond_beam=order.beyond_beam,
            table=order.table,
        )
        """The pass, as displays show it."""
        self._given: dict[Axis, int] = {}
        """The number of the step, or of the piece of path, that each axis has."""

    def wanted(self, now_s: float) -> Aim:
        """The target's direction, for the display."""
        return Aim(*self._path.direction(now_s))

    def way(self, now_s: float) -> Way:
        """The way on which the antenna follows the target now."""
        azimuth_deg, elevation_deg = (_angle_deg(plan, now_s) for plan in self._plans.values())
        return Way(azimuth_deg, self._mount.model.over_the_top(elevation_deg))

    def ended(self, now_s: float) -> bool:
        """Whether the flight is over: the target has set, or the stream in whose place the pass is flown has ended.

        A program may send for a while after the target has set.
        """
        if self.following is not None:
            return self.following.silent(now_s)
        return now_s >= self._path.end_s and all(now_s >= _end_s(plan) for plan in self._plans.values())

    def is_pass_of(self, other: Flight) -> bool:
        """Whether the other flight is one more piece of this pass, or the same one planned again."""
        return self.flown.name == other.flown.name and other.flown.begin_s < self.flown.end_s

    def begin_goals_anew(self) -> None:
        """Give the goals of this moment once more."""
        self._given.clear()

    def goals(self, now_s: float) -> dict[Axis, AimGoal]:
        """The goals that begin now."""
        found = {}
        for axis, plan in self._plans.items():
            number = _number(plan, now_s)
            if self._given.get(axis) != number:
                self._given[axis] = number
                found[axis] = _goal(plan, number, now_s)
        return found


def _check(plan: AxisPlan, limits: Range, axis: Axis) -> None:
    for angle_deg in (*plan.angles_deg, *(step.place_deg for step in plan.steps)):
        if not limits.holds(angle_deg):
            raise Unreachable(f"the plan takes {axis.value} to {angle_deg:g}°, beyond its limits")


def _number(plan: AxisPlan, now_s: float) -> int:
    if plan.steps:
        return max(0, bisect_right(plan.steps, now_s, key=lambda step: step.leave_s) - 1)
    return int(now_s // AGAIN_S)


def _goal(plan: AxisPlan, number: int, now_s: float) -> AimGoal:
    if plan.steps:
        return AimGoal(plan.steps[number].place_deg, STEP_TOLERANCE_DEG)
    angles_deg = [_angle_deg(plan, now_s + offset_s) for offset_s in OFFSETS_S]
    return AimGoal(angles_deg[0], STEP_TOLERANCE_DEG, Path(now_s, angles_deg, EVEN))


def _angle_deg(plan: AxisPlan, at_s: float) -> float:
    """Before the plan begins, its first angle; after it has ended, its last one."""
    place = (at_s - plan.begin_s) / PLAN_STEP_S
    index = min(max(int(place), 0), len(plan.angles_deg) - 1)
    after = min(index + 1, len(plan.angles_deg) - 1)
    share = min(max(place - index, 0.0), 1.0)
    return plan.angles_deg[index] * (1 - share) + plan.angles_deg[after] * share


def _end_s(plan: AxisPlan) -> float:
    steps_s = plan.steps[-1].leave_s if plan.steps else 0.0
    return max(steps_s, plan.begin_s + PLAN_STEP_S * len(plan.angles_deg))
