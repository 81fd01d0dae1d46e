"""The goals of both axes, led round forbidden sectors: from place to place, and beside a sector that holds the target.

Knows what the axes were asked for, where they are, and the way on which they go. Without sectors each goal goes to its
axis as it is. What keeps the antenna out of a sector for certain is the `fence`; this finds the way.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis
from rotator.control.axis.port import ControlledAxis
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG
from rotator.control.sky.detour import BESIDE_DEG, Detour, Detours
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Mount
from rotator.control.sky.plan import Path
from rotator.control.sky.route import Speeds
from rotator.control.sky.sectors import Box, Place
from rotator.exchange.faults import Notice
from rotator.exchange.orders import Aim

PLACE_TOLERANCE_DEG = 0.8 * BESIDE_DEG
"""How near to a place on its way an axis has to come."""
SAME_DEG = 0.25
"""A target that has moved by less needs no new way."""
LONG_DEG = 200.0
"""Without ends a target further away than this has a shorter way. Near half a turn it keeps to the way begun."""
SAME_SIDE_DEG = 20.0
"""A target that has moved by less is still gone to by the same way round."""
MORE_ROOM_DEG = 0.1
"""If a motor needs this much more room before a sector than was known, the ways are computed anew."""


class GoingRound:
    def __init__(self, mount: Mount, axes: Mapping[Axis, ControlledAxis]) -> None:
        self._mount = mount
        self._axes = axes
        self._room_deg = self._room()
        self._turn_deg = 0.0
        """Where the turn begins on which the antenna is, on a scale without ends; else 0."""
        self._side_deg: float | None = None
        """On such a scale: the place of a target that it goes to by the long way round."""
        self.detours = self._detours() if mount.sectors else None
        self._wishes: dict[Axis, AimGoal] = {}
        """The goals as asked for."""
        self._target: Place | None = None
        self._detour: Detour | None = None
        """The rest of the way to that target; None: straight on."""
        self._stopped: set[Axis] = set()
        """Axes that an order or a fault has stopped since the latest order. They stay there, even if they block the
        other axis."""
        self._waits_deg: dict[Axis, float] = {}
        """Angle at which the moving axis waits while the stopped axis blocks it."""
        self._noticed: dict[Axis, Notice] = {}

    def wish(self, axis: Axis) -> AimGoal | None:
        """The goal as ordered; None: the axis does not aim."""
        aiming = self._axes[axis].aiming
        return self._wishes.get(axis, aiming) if aiming is not None and self.detours is not None else aiming

    def led_from_deg(self, axis: Axis) -> float | None:
        """The target as ordered, while the axis is led to another place; None: it goes to its target, or has none."""
        aiming, wish = self._axes[axis].aiming, self.wish(axis)
        return wish.target_deg if aiming and wish and wish.target_deg != aiming.target_deg else None

    def turn(self, now_s: float, aim: Aim, from_deg: float) -> tuple[float, bool]:
        """Near which azimuth the target is to be met, and whether over the top: where the way takes the least time.

        Without sectors, or where no place is free: the nearest turn, as the mount knows it.
        """
        azimuth_deg, elevation_deg = aim.azimuth_deg, aim.elevation_deg
        if self.detours is None or azimuth_deg is None or elevation_deg is None:
            return from_deg, False
        if azimuth_deg > FULL_TURN_DEG or elevation_deg > ZENITH_DEG:  # the sender names the place
            return from_deg, False
        self._keep_room()
        here = self._here(now_s)
        if not here.known:
            return from_deg, False
        ways = [
            (self.detours.seconds(here, (side_deg, raised_deg)), over, abs(side_deg - from_deg), side_deg)
            for place_deg, raised_deg, over in self._mount.places(azimuth_deg, elevation_deg)
            for side_deg in self._sides(place_deg, from_deg)
        ]
        # Over the top only where no other place is free.
        ways = [way for way in ways if math.isfinite(way[0])]
        if not ways:
            return from_deg, False
        _, over, _, place_deg = min(ways, key=lambda way: (way[1], way[0], way[2]))
        return place_deg, over

    def aim(self, axis: Axis, goal: AimGoal) -> None:
        """Go there from now on. An order may move the other axis out of the way too."""
        self._stopped.clear()
        self._waits_deg.clear()
        if axis is Axis.AZIMUTH:
            goal = self._short(goal, goal.target_deg)
        self._axes[axis].aim(goal)
        if self.detours is not None:
            self._wishes[axis] = goal

    def _short(self, goal: AimGoal, place_deg: float) -> AimGoal:
        """Without ends: this goal of the azimuth, now at that place, on the turn that is nearest to the antenna."""
        stands_deg = self._axes[Axis.AZIMUTH].angle_deg
        by_deg = 0.0 if stands_deg is None else self._mount.near_deg(place_deg, stands_deg) - place_deg
        return goal.mapped(lambda angle_deg: angle_deg + by_deg) if by_deg else goal

    def _sides(self, place_deg: float, from_deg: float) -> list[float]:
        """Both ways round to a place, where the axis has no ends: first the short one."""
        near_deg = self._mount.near_deg(place_deg, from_deg)
        long_deg = near_deg - math.copysign(FULL_TURN_DEG, near_deg - from_deg)
        return [near_deg, long_deg] if self._mount.azimuth.endless else [place_deg]

    def stop(self, axes: tuple[Axis, ...]) -> None:
        """These axes stay where they are until the next order."""
        self._stopped.update(axes)

    def forget_paths(self) -> None:
        """Keep the present targets: how they move on is not known any more."""
        for axis in self._axes.values():
            axis.forget_path()
        self._wishes = {axis: goal.standing() for axis, goal in self._wishes.items()}

    def notices(self, axis: Axis) -> tuple[Notice, ...]:
        return (self._noticed[axis],) if axis in self._noticed else ()

    def lead(self, now_s: float) -> None:
        """Give each axis the goal of this moment."""
        if self.detours is None:
            goal, stands_deg = self._axes[Axis.AZIMUTH].aiming, self._axes[Axis.AZIMUTH].angle_deg
            if self._mount.azimuth.endless and goal is not None and stands_deg is not None:
                place_deg = _place_deg(goal, now_s)
                if abs(place_deg - stands_deg) > LONG_DEG:
                    self._axes[Axis.AZIMUTH].aim(self._short(goal, place_deg))
            return
        self._keep_room()
        # A fault has stopped its axis. Its acknowledgement orders no motion of it.
        self.stop(tuple(axis for axis, control in self._axes.items() if control.fault))
        wishes = {axis: wish for axis in Axis if (wish := self.wish(axis)) is not None}
        self._wishes = dict(wishes)
        self._noticed.clear()
        # An axis that jogs or homes is not led round sectors: the fence stops it in time.
        free = all(axis in wishes or not self._axes[axis].busy for axis in Axis)
        here = self._here(now_s)
        if not wishes or not free or not here.known:
            self._target = self._detour = None
            self._give(wishes)
            return
        azimuth_deg, elevation_deg = (
            _place_deg(wishes[axis], now_s) if axis in wishes else here.of(axis).middle_deg for axis in Axis
        )
        if self._mount.azimuth.endless and Axis.AZIMUTH in wishes:
            side_deg = self._side(here, (azimuth_deg, elevation_deg))
            by_deg, azimuth_deg = side_deg - azimuth_deg, side_deg
            wishes[Axis.AZIMUTH] = wishes[Axis.AZIMUTH].mapped(lambda angle_deg: angle_deg + by_deg)
            self._wishes = dict(wishes)
        target = azimuth_deg, elevation_deg
        if self.detours.free(here, target):
            self._target = self._detour = None
            self._give(wishes)
            return
        if not self._stopped <= wishes.keys():
            self._wait(wishes, here)
            return
        for axis in Axis:
            if axis not in wishes:
                # This axis moves out of the way, and comes back.
                wishes[axis] = self._wishes[axis] = AimGoal(here.of(axis).middle_deg, PLACE_TOLERANCE_DEG)
        self._go(wishes, self._way(here, target), target)

    def _side(self, here: Box, target: Place) -> float:
        """By which way round the antenna goes to a target, without ends: the short way where it is free, else the way
        on which it is already, else the one that takes less time."""
        assert self.detours is not None
        stands_deg, kept_deg = here.azimuth.middle_deg, self._side_deg
        near_deg, long_deg = self._sides(target[0], stands_deg)
        if self.detours.free(here, (near_deg, target[1])):
            self._side_deg = None
            return near_deg
        sides_deg = [near_deg, long_deg]
        if kept_deg is not None:
            sides_deg = [each for each in sides_deg if abs(each - kept_deg) < SAME_SIDE_DEG] or sides_deg
        if len(sides_deg) > 1:
            sides_deg.sort(key=lambda each: self.detours.seconds(here, (each, target[1])) if self.detours else 0.0)
        self._side_deg = sides_deg[0]
        return sides_deg[0]

    def _wait(self, wishes: Mapping[Axis, AimGoal], here: Box) -> None:
        """The axis that would have to move out of the way was stopped: the other one stays where it is."""
        self._target = self._detour = None
        for axis, wish in wishes.items():
            place_deg = self._waits_deg.setdefault(axis, here.of(axis).middle_deg)
            self._set(axis, AimGoal(place_deg, max(wish.tolerance_deg, PLACE_TOLERANCE_DEG)))
            self._noticed[axis] = Notice("a sector is in the way, and the other axis was stopped: waits", "FORBIDDEN")

    def _way(self, here: Box, target: Place) -> Detour:
        """The way on which the antenna is, where it still leads to the target; else a new one."""
        assert self.detours is not None
        before, detour = self._target, self._detour
        if detour is not None and before is not None and not detour.leaves and _same(before, target):
            at = self.detours.further(here, detour.places)
            if at is not None:
                self._detour = Detour(detour.places[at:], detour.sector)
                return self._detour
        end = detour.places[-1] if detour is not None and detour.sector and not detour.leaves else None
        self._target = target
        self._detour = self.detours.round(here, target, end)
        return self._detour

    def _go(self, wishes: Mapping[Axis, AimGoal], detour: Detour, target: Place) -> None:
        """To the first place of the way; at its end each axis that reaches its target follows it again."""
        last = len(detour.places) == 1 and not detour.leaves
        for axis, place_deg, target_deg in zip(Axis, detour.places[0], target, strict=True):
            wish = wishes[axis]
            if last and abs(place_deg - target_deg) < SAME_DEG:
                self._set(axis, wish)
                continue
            tolerance_deg = wish.tolerance_deg if last else PLACE_TOLERANCE_DEG
            self._set(axis, AimGoal(place_deg, tolerance_deg))
            if last:
                text = f"the target is in or behind {detour.sector}: waits at {place_deg:.0f}°"
                self._noticed[axis] = Notice(text, "FORBIDDEN")
        if detour.leaves:
            for axis in Axis:
                self._noticed[axis] = Notice(f"the antenna is in {detour.sector}: it may only leave it", "IN FORBIDDEN")

    def _room(self) -> Place:
        return self._axes[Axis.AZIMUTH].stopping_room_deg, self._axes[Axis.ELEVATION].stopping_room_deg

    def _detours(self) -> Detours:
        azimuth, elevation = self._axes[Axis.AZIMUTH], self._axes[Axis.ELEVATION]
        about_deg = azimuth.position_error_deg, elevation.position_error_deg
        return Detours(
            self._mount.about(self._turn_deg), self._room_deg, about_deg, Speeds(azimuth.speed_dps, elevation.speed_dps)
        )

    def _keep_room(self) -> None:
        """A motor that turns out to be faster needs more room: the fence would hold it back at a place too near."""
        room_deg, stands_deg = self._room(), self._axes[Axis.AZIMUTH].angle_deg
        turn_deg = self._turn_deg
        if self._mount.azimuth.endless and stands_deg is not None:
            self._turn_deg = stands_deg // FULL_TURN_DEG * FULL_TURN_DEG
        if turn_deg != self._turn_deg or any(
            now_deg > before_deg + MORE_ROOM_DEG for now_deg, before_deg in zip(room_deg, self._room_deg, strict=True)
        ):
            azimuth_deg, elevation_deg = map(max, room_deg, self._room_deg)
            self._room_deg = azimuth_deg, elevation_deg
            self.detours = self._detours()

    def _here(self, now_s: float) -> Box:
        return Box(*(self._axes[axis].sweep(now_s, None) for axis in Axis))

    def _give(self, wishes: Mapping[Axis, AimGoal]) -> None:
        for axis, wish in wishes.items():
            self._set(axis, wish)

    def _set(self, axis: Axis, goal: AimGoal) -> None:
        if self._axes[axis].aiming != goal:
            self._axes[axis].aim(goal)


def _place_deg(goal: AimGoal, now_s: float) -> float:
    return goal.path.angle_deg(now_s) if isinstance(goal.path, Path) else goal.target_deg


def _same(a: Place, b: Place) -> bool:
    return max(abs(a[0] - b[0]), abs(a[1] - b[1])) < SAME_DEG
