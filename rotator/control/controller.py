"""The controller: orders and readings in, what the drives are to do and the status out.

Knows both axes, the mount, who may move what, and timed lists. Pure: no I/O, no clock, no thread; the same inputs give
the same outputs, so an hour at the mast is a second in a test.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.authority import Authority
from rotator.control.axis import AimGoal, AxisControl, AxisSettings
from rotator.control.mount import ZENITH_DEG, Mount, Unreachable
from rotator.control.plan import OFFSETS_S, Path
from rotator.control.sensing import Reading
from rotator.control.switched import Run
from rotator.control.timed import TimedList
from rotator.control.track import Track
from rotator.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Jog,
    LoadTimed,
    Order,
    Park,
    Release,
    RunTimed,
    Source,
    Speed,
    Stop,
)
from rotator.status import Status

PLAN_EVERY_S = 0.5
EVEN = (1.0,) * len(OFFSETS_S)
LEAST_WEIGHT = 0.1
"""Near the zenith azimuth hardly matters, but an antenna sent there by hand is to turn all the same."""


@dataclass(frozen=True, slots=True)
class Settings:
    azimuth: AxisSettings
    elevation: AxisSettings
    mount: Mount
    period_s: float = 0.05
    lease_s: float = 0.25
    """How long a drive command lives unless renewed: what a hung bus can cost at most."""
    simulated: bool = False


class Controller:
    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._axes = {
            each.axis: AxisControl(each, lease_s=settings.lease_s, period_s=settings.period_s)
            for each in (settings.azimuth, settings.elevation)
        }
        self._authority = Authority()
        self._timed = TimedList()
        self._track = Track()
        self._planned_s: float | None = None
        self._aim = Aim(None, None)
        self._speed_level = 4
        self.troubles: list[str] = []
        """What went wrong with orders since the last look, for the log."""

    def step(
        self, now_s: float, readings: Mapping[Axis, Reading], orders: Iterable[tuple[Source, Order]]
    ) -> dict[Axis, Run]:
        """One cycle: note the readings, take the orders, say what each drive is to do."""
        for axis, control in self._axes.items():
            if axis in readings:
                control.see(readings[axis], now_s)
        for source, order in orders:
            self._take(source, order, now_s)
        point = self._timed.due(now_s)
        if point is not None:
            self._point_at(Aim(*point), now_s)
        self._look_ahead(now_s)
        return {axis: control.decide(now_s) for axis, control in self._axes.items()}

    def status(self, now_s: float, driven: Mapping[Axis, Direction], late_s: float = 0.0) -> Status:
        """The status after this cycle, with what the drives really do."""
        source = self._authority.controlled_by
        return Status(
            at_s=now_s,
            azimuth=self._axes[Axis.AZIMUTH].status(now_s, driven[Axis.AZIMUTH]),
            elevation=self._axes[Axis.ELEVATION].status(now_s, driven[Axis.ELEVATION]),
            wanted_azimuth_deg=self._aim.azimuth_deg,
            wanted_elevation_deg=self._aim.elevation_deg,
            latched=self._authority.latched,
            controlled_by=str(source) if source else "",
            timed_point=self._timed.point,
            timed_points=len(self._timed.points),
            simulated=self._settings.simulated,
            speed_level=self._speed_level,
            cycle_late_s=late_s,
        )

    def _take(self, source: Source, order: Order, now_s: float) -> None:
        match order:
            case Stop(axes, latch):
                self._stop(source, axes, latch=latch, now_s=now_s)
            case Release():
                self._authority.released()
                self._acknowledge()
            case ClearTimed():
                self._timed.clear()
            case Speed(level):
                self._speed_level = level
            case Calibrate(axis, high_end):
                self._calibrate(axis, high_end=high_end)
            case _ if self._authority.may_move(source, now_s):
                self._move(order, now_s)

    def _move(self, order: Order, now_s: float) -> None:
        self._timed.halt()
        match order:
            case Aim():
                self._point_at(order, now_s)
            case Park():
                mount = self._settings.mount
                self._point_at(Aim(mount.park_azimuth_deg, mount.park_elevation_deg), now_s)
            case Jog(axis, direction, seconds):
                self._forget_wish(axis)
                self._axes[axis].start_jog(direction, seconds, now_s)
            case LoadTimed(interval_s, points):
                self._point_at(Aim(*self._timed.load(interval_s, points)), now_s)
            case RunTimed():
                self._timed.run(now_s)

    def _stop(self, source: Source, axes: tuple[Axis, ...], *, latch: bool, now_s: float) -> None:
        self._timed.halt()
        self._track.clear()
        for axis in axes:
            self._axes[axis].goal = None
            self._forget_wish(axis)
        if len(axes) == len(self._axes):
            self._authority.stopped(source, now_s, latch=latch)
            if not latch and not self._authority.latched:
                self._acknowledge()

    def _acknowledge(self) -> None:
        for control in self._axes.values():
            control.acknowledge()

    def _forget_wish(self, axis: Axis) -> None:
        if axis is Axis.AZIMUTH:
            self._aim = Aim(None, self._aim.elevation_deg)
        else:
            self._aim = Aim(self._aim.azimuth_deg, None)

    def _point_at(self, aim: Aim, now_s: float) -> None:
        azimuth, elevation = self._axes[Axis.AZIMUTH], self._axes[Axis.ELEVATION]
        wanted = Aim(
            self._aim.azimuth_deg if aim.azimuth_deg is None else aim.azimuth_deg,
            self._aim.elevation_deg if aim.elevation_deg is None else aim.elevation_deg,
            aim.engaged,
        )
        if not aim.engaged:
            azimuth.goal = elevation.goal = None
            self._track.clear()
        elif aim.azimuth_deg is not None:
            near_deg = azimuth.angle_deg if azimuth.angle_deg is not None else self._settings.mount.azimuth.min_deg
            if isinstance(azimuth.goal, AimGoal) and wanted == self._aim:
                # The same order again: stay on the turn chosen, though the antenna has moved since.
                near_deg = azimuth.goal.target_deg
            try:
                azimuth_deg, elevation_deg = self._settings.mount.axis_angles(
                    aim.azimuth_deg, aim.elevation_deg, near_deg
                )
            except Unreachable as reason:
                self.troubles.append(str(reason))
                return
            azimuth.goal = AimGoal(azimuth_deg, self._azimuth_tolerance_deg(elevation_deg))
            self._planned_s = None
            if aim.elevation_deg is None or elevation_deg is None:
                self._track.clear()
            else:
                elevation.goal = AimGoal(elevation_deg, elevation.settings.tolerance_deg)
                self._track.note(now_s, aim.azimuth_deg, aim.elevation_deg)
        self._aim = wanted

    def _look_ahead(self, now_s: float) -> None:
        """Give the axes the path of a target that moves; without one they have where it stands."""
        azimuth, elevation = self._axes[Axis.AZIMUTH], self._axes[Axis.ELEVATION]
        if not isinstance(azimuth.goal, AimGoal) or not isinstance(elevation.goal, AimGoal):
            return
        if not self._track.moving(now_s):
            if azimuth.goal.path is not None:
                self._stand_still(azimuth.goal, elevation.goal)
            return
        if self._planned_s is not None and now_s - self._planned_s < PLAN_EVERY_S:
            return
        self._planned_s = now_s
        directions = [self._track.direction(now_s + offset_s) for offset_s in OFFSETS_S]
        flipped = (self._aim.elevation_deg or 0.0) > ZENITH_DEG
        azimuths_deg, elevations_deg = self._settings.mount.along(directions, azimuth.goal.target_deg, flipped=flipped)
        weights = [max(LEAST_WEIGHT, math.cos(math.radians(el_deg))) ** 2 for _, el_deg in directions]
        azimuth.goal = AimGoal(
            azimuths_deg[0], self._settings.azimuth.tolerance_deg, Path(now_s, azimuths_deg, weights)
        )
        elevation.goal = AimGoal(
            elevations_deg[0], self._settings.elevation.tolerance_deg, Path(now_s, elevations_deg, EVEN)
        )

    def _stand_still(self, azimuth: AimGoal, elevation: AimGoal) -> None:
        """The stream has ended: the last order stands."""
        aim = self._aim
        if aim.azimuth_deg is None:
            return
        azimuth_deg, elevation_deg = self._settings.mount.axis_angles(
            aim.azimuth_deg, aim.elevation_deg, azimuth.target_deg
        )
        self._axes[Axis.AZIMUTH].goal = AimGoal(azimuth_deg, self._azimuth_tolerance_deg(elevation_deg))
        if elevation_deg is not None:
            self._axes[Axis.ELEVATION].goal = AimGoal(elevation_deg, self._settings.elevation.tolerance_deg)

    def _azimuth_tolerance_deg(self, elevation_deg: float | None) -> float:
        """The tolerance is on the sky: high up, a degree of azimuth moves the antenna less than a degree."""
        if elevation_deg is None:
            elevation_deg = self._axes[Axis.ELEVATION].angle_deg or 0.0
        weight = max(LEAST_WEIGHT, abs(math.cos(math.radians(elevation_deg))))
        return self._settings.azimuth.tolerance_deg / weight

    def _calibrate(self, axis: Axis, *, high_end: bool) -> None:
        if any(control.goal is not None for control in self._axes.values()):
            self.troubles.append(f"{axis.value} is not calibrated while the antenna is under orders")
            return
        try:
            self._axes[axis].calibrate_end(high_end=high_end)
        except ValueError as reason:
            self.troubles.append(f"{axis.value} keeps its calibration: {reason}")
