"""From orders for directions to goals for the axes, now and over the next minute.

Knows the direction ordered, where the target is going (`track`), and on which way the antenna follows it (`route`);
`way_goals` makes the goals of that way. Knows nothing of the sender, of faults, or of how an axis reaches its goal.
"""

from __future__ import annotations

import math

from rotator.control.sky.angles import FULL_TURN_DEG, HALF_TURN_DEG, ZENITH_DEG, direction, great_circle_deg
from rotator.control.sky.goal import AimGoal, Goals
from rotator.control.sky.mount import Mount, Unreachable
from rotator.control.sky.plan import OFFSETS_S
from rotator.control.sky.route import LOOKS, STEP_S, Speeds, Way, best_way
from rotator.control.sky.track import Track
from rotator.control.sky.turns import Swings
from rotator.control.sky.way_goals import WayGoals
from rotator.exchange.flight_order import TakeTurn
from rotator.exchange.orders import Aim

PLAN_EVERY_S = 0.5
ROUTE_EVERY_S = 3.0
SURE_AFTER_S = 45.0
"""A track this long predicts the end of the pass well enough. A shorter one is trusted for as long ahead as it has
lasted; there the target stands."""
WAVERS_DEG = 90.0
"""An order this near to the one before may be the same target, which wavers."""
LONGEST_LEAD_S = 15.0
"""A path is known well enough for so long, also from orders in whole degrees (`track`)."""
LEVEL_DEG, LEAVES_DEG = 1.0, 10.0
"""A stream waits at the horizon for a rise only while its orders are this low, and each this near to the one before."""


class Pointing:
    """`on_sky` False: the tolerance is in degrees of each axis, and a target that moves is followed order by order."""

    def __init__(
        self, mount: Mount, azimuth_tolerance_deg: float, elevation_tolerance_deg: float, *, on_sky: bool = True
    ) -> None:
        self._mount = mount
        self._on_sky = on_sky
        self._goals = WayGoals(mount, azimuth_tolerance_deg, elevation_tolerance_deg, on_sky=on_sky)
        self._track = Track()
        self._swings = Swings()
        self._way: Way | None = None
        self._planned_s: float | None = None
        self._routed_s: float | None = None
        self._led_until_s = -math.inf
        """Until then a stream at the horizon stays on the turn that the pass needs for whose rise it waits."""
        self.interrupted = False
        """A stop comes before each order, and ends each run within a second: no step of a plan can be made."""
        self.wanted = Aim(None, None)
        """The direction last ordered, as ordered: the display's SAT."""

    def forget(self, *, azimuth: bool = True, elevation: bool = True) -> None:
        """Forget the order on these axes."""
        self._track = Track()  # not cleared: a copy of this may go on with it
        self._way = None
        self._led_until_s = -math.inf
        kept = self.wanted
        self.wanted = Aim(None if azimuth else kept.azimuth_deg, None if elevation else kept.elevation_deg)

    def end_stream(self) -> None:
        """The target stands at the direction last ordered."""
        self._track.end()

    def shift(self, azimuth_deg: float, elevation_deg: float) -> None:
        """A person has shifted all orders by this; the one in force is to be given again."""
        self._track.shift(azimuth_deg, elevation_deg)

    def accompany(self, now_s: float, aim: Aim, way: Way) -> None:
        """A flight leads the antenna on this way. Note the stream's order, to follow the stream after the flight."""
        assert aim.azimuth_deg is not None
        assert aim.elevation_deg is not None
        self._track.note(now_s, aim.azimuth_deg, aim.elevation_deg)
        self._way = way

    def take_turn(self, now_s: float, order: TakeTurn) -> Goals | None:
        """Goals for the order in force, on this turn of azimuth.

        None: that order does not point at the horizon near the place of the rise.
        """
        wanted = self.wanted
        if self._way is None or wanted.azimuth_deg is None or wanted.elevation_deg is None:
            return None
        there_deg, _ = self._mount.on_the_way(
            *direction(wanted.azimuth_deg, wanted.elevation_deg), order.azimuth_deg, flipped=order.flipped
        )
        if wanted.elevation_deg > LEVEL_DEG or abs(there_deg - order.azimuth_deg) > WAVERS_DEG:
            return None
        self._way, self._led_until_s, self._planned_s = Way(there_deg, order.flipped), order.until_s, None
        return self._standing(now_s, settled=False)

    def show(self, aim: Aim) -> None:
        """Show a direction without following it."""
        self.forget()
        self.wanted = aim

    def aim(
        self,
        now_s: float,
        aim: Aim,
        azimuth_deg: float,
        elevation_deg: float,
        *,
        over: bool = False,
        wanted: Aim | None = None,
    ) -> Goals:
        """Goals for an order, with the antenna at these axis angles. Raises Unreachable; then nothing has changed.

        `over`: it is better met over the top. `wanted`: the direction in force, where the sender sees it by the axes'
        own angles; None: as it was ordered.
        """
        assert aim.azimuth_deg is not None, "every order that points has an azimuth"
        before = wanted or self.wanted
        again = (aim.azimuth_deg, aim.elevation_deg) == (before.azimuth_deg, before.elevation_deg)
        again = again and self._way is not None
        # The same order again: stay on the turn chosen, also while the antenna is elsewhere.
        near_deg = self._way.azimuth_deg if again and self._way is not None else azimuth_deg
        axis_azimuth_deg, axis_elevation_deg = self._mount.axis_angles(
            aim.azimuth_deg, aim.elevation_deg, near_deg, over=over
        )
        kept_deg = before.elevation_deg if aim.elevation_deg is None else aim.elevation_deg
        self.wanted = Aim(aim.azimuth_deg, kept_deg)
        self._planned_s = None
        if aim.elevation_deg is None or axis_elevation_deg is None:
            self._track.clear()
            self._way = self._calm_way(now_s, aim, Way(axis_azimuth_deg, flipped=False), azimuth_deg)
            # The antenna may still be on its way down from an order before.
            heights_deg = (elevation_deg,) if kept_deg is None else (elevation_deg, kept_deg)
            return self._goals.azimuth_alone(self._way, heights_deg)
        if aim.place:
            self._track.clear()
        self._track.note(now_s, aim.azimuth_deg, aim.elevation_deg)
        moving = self._track.moving(now_s)
        if self._led_until_s > now_s and _leaves(before, aim):
            self._led_until_s = -math.inf
        # An elevation above 90 names the way itself, and so does the one after it that comes back across the zenith.
        named = self._is_over(aim) or self._is_over(before)
        if self._way is not None and not named and (moving or self._led_until_s > now_s):
            # The antenna stays on its way, also while it is elsewhere.
            flown_deg, _ = self._mount.on_the_way(
                *direction(aim.azimuth_deg, aim.elevation_deg), self._way.azimuth_deg, flipped=self._way.flipped
            )
            self._way = Way(flown_deg, self._way.flipped)
            self._swings.forgo()
        elif not again:
            flipped = self._mount.model.over_the_top(axis_elevation_deg)
            self._way = self._calm_way(now_s, aim, Way(axis_azimuth_deg, flipped), azimuth_deg)
        return self._standing(now_s, settled=not moving)

    def park(self) -> Goals:
        """Goals for the park position. Raises Unreachable; then nothing has changed."""
        try:
            azimuth_deg, elevation_deg = self._mount.parked()
        except Unreachable as reason:
            raise Unreachable(f"the park position cannot be reached: {reason}") from reason
        self.forget()
        self.wanted = Aim(self._mount.park_azimuth_deg, self._mount.park_elevation_deg)
        return self._goals.at(azimuth_deg, elevation_deg)

    def raise_to(self, elevation_deg: float, azimuth_deg: float) -> AimGoal:
        """The goal for an order of elevation alone, with azimuth where it is."""
        self.wanted = Aim(self.wanted.azimuth_deg, elevation_deg)
        return self._goals.elevation_alone(azimuth_deg, elevation_deg)

    def look_ahead(self, now_s: float, speeds: Speeds, *, had_path: bool) -> Goals | None:
        """New goals where the target moves or has stopped; None: the present goals stay."""
        if self._way is None:
            return None
        if not self._track.moving(now_s):
            ended = had_path or (not self._on_sky and self._planned_s is not None)
            self._planned_s = None
            return self._standing(now_s, settled=True) if ended or self._swings.due(now_s) else None
        if self._planned_s is not None and now_s - self._planned_s < PLAN_EVERY_S:
            return None
        self._planned_s = now_s
        self._choose_way(now_s, speeds)
        if not self._on_sky:
            return self._standing(now_s, settled=False)
        if self.interrupted:
            return self._goals.towards(self._way, *self._track.direction(now_s + self._lead_s(now_s)))
        directions = [self._track.direction(now_s + offset_s) for offset_s in OFFSETS_S]
        return self._goals.along(now_s, self._way, directions)

    def _lead_s(self, now_s: float) -> float:
        """How far ahead of the target the antenna waits for it, so that it is as much too early as too late."""
        pace_dps = great_circle_deg(*self._track.direction(now_s), *self._track.direction(now_s + 1.0))
        return min(self._goals.tolerance_deg / 2 / max(pace_dps, 1e-3), LONGEST_LEAD_S)

    def _is_over(self, aim: Aim) -> bool:
        """Whether the order names the way over the top, and elevation reaches it."""
        elevation_deg = aim.elevation_deg or 0.0
        return elevation_deg > ZENITH_DEG and self._mount.elevation.holds(elevation_deg)

    def _choose_way(self, now_s: float, speeds: Speeds) -> None:
        assert self._way is not None
        if self._led_until_s > now_s:
            return
        if (self.wanted.azimuth_deg or 0.0) > FULL_TURN_DEG or self._is_over(self.wanted):  # the sender names its way
            return
        if self._routed_s is not None and now_s - self._routed_s < ROUTE_EVERY_S:
            return
        self._routed_s = now_s
        age_s = self._track.age_s(now_s)
        trusted_s = age_s if age_s < SURE_AFTER_S else math.inf
        directions = [self._track.direction(now_s)]
        for look in range(1, LOOKS):
            direction = self._track.direction(now_s + min(look * STEP_S, trusted_s))
            if direction[1] < 0:
                break
            directions.append(direction)
        # A program that flips itself has decided already.
        may_flip = (self.wanted.elevation_deg or 0.0) <= ZENITH_DEG
        way = best_way(self._mount, directions, self._way, speeds, may_flip=may_flip)
        # A young track may be a target that wavers: a swing for it waits as any other does.
        if way != self._way and (age_s >= SURE_AFTER_S or self._swings.may_begin(now_s)):
            self._way = way

    def _calm_way(self, now_s: float, aim: Aim, way: Way, azimuth_deg: float) -> Way:
        """The way to a new order. If only a swing right round leads there, and swings must wait: the present way.

        A swing that has only begun is broken off if the way back is nearer.
        """
        assert aim.azimuth_deg is not None
        if self._way is None or aim.azimuth_deg > FULL_TURN_DEG:  # the sender names the overlap
            return way
        there = direction(aim.azimuth_deg, aim.elevation_deg or 0.0)
        kept_deg, _ = self._mount.on_the_way(*there, self._way.azimuth_deg, flipped=self._way.flipped)
        turns_over = way.flipped is not self._way.flipped
        if not turns_over and abs(way.azimuth_deg - kept_deg) <= HALF_TURN_DEG:
            self._swings.forgo()
            return way
        wavers = abs(kept_deg - self._way.azimuth_deg) <= WAVERS_DEG
        if self._way.flipped and not way.flipped and not self._mount.flip:
            wavers = False  # over the top only for an order that names it
        if not wavers or self._swings.may_begin(now_s):
            return way
        waits_deg = self._mount.azimuth.nearest(kept_deg)
        if not turns_over and abs(way.azimuth_deg - azimuth_deg) < abs(waits_deg - azimuth_deg):
            self._swings.break_off()
            return way
        return Way(kept_deg, self._way.flipped)

    def _standing(self, now_s: float, *, settled: bool) -> Goals:
        """Goals for the last order, on the way chosen. For a target that has settled beyond the end of its turn the
        antenna turns round."""
        wanted = self.wanted
        assert self._way is not None
        assert wanted.azimuth_deg is not None
        near_deg = self._mount.azimuth.nearest(self._way.azimuth_deg)
        settled = settled and self._led_until_s <= now_s
        if settled and near_deg != self._way.azimuth_deg and self._swings.may_begin(now_s):
            axis_deg, raised_deg = self._mount.axis_angles(wanted.azimuth_deg, wanted.elevation_deg, near_deg)
            flipped = self._way.flipped if raised_deg is None else self._mount.model.over_the_top(raised_deg)
            self._way = Way(axis_deg, flipped)
        if wanted.elevation_deg is None:
            return self._goals.azimuth_alone(self._way)
        return self._goals.towards(self._way, wanted.azimuth_deg, wanted.elevation_deg)


def _leaves(before: Aim, aim: Aim) -> bool:
    """Whether the order is for another target than the one before."""
    if before.azimuth_deg is None or aim.azimuth_deg is None:
        return True
    ends = (before.azimuth_deg, before.elevation_deg or 0.0), (aim.azimuth_deg, aim.elevation_deg or 0.0)
    return great_circle_deg(*ends[0], *ends[1]) > LEAVES_DEG
