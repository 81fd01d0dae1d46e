"""Plans a whole pass before it begins: the way through it, and the steps of each axis, or its path if it has no relays.

Knows the mount, the target's path and the motors. A plan takes up to a second, so it is not computed in the control
loop, and comes back to it as an order. Knows neither sensors nor the sender of the request.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from rotator.control.sky.known_path import KnownPath, Row, rows_around
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.one_at_a_time import before_azimuth
from rotator.control.sky.route import STEP_S, Speeds, Way, is_seen
from rotator.control.sky.steps import Trail, best_steps
from rotator.control.sky.turn_timing import Change, change_of
from rotator.control.sky.turning import lifted_between_deg
from rotator.control.sky.ways import Leg, Route, best_route
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan, Fly, Step


def led(angles_deg: Sequence[float], travel_deg: float) -> list[float]:
    """The same path where the motor can follow it: the angles of one axis at even moments.

    Where it cannot, as azimuth near the zenith, an even turn with as much of it before as after.
    """
    led_deg, last = list(angles_deg), len(angles_deg) - 1
    moment = 0
    while moment < last:
        if not _too_fast(angles_deg, moment, travel_deg):
            moment += 1
            continue
        begin, end = moment, moment + 1
        while end < last and _too_fast(angles_deg, end, travel_deg):
            end += 1
        while abs(angles_deg[end] - angles_deg[begin]) > travel_deg * (end - begin) and (begin or end < last):
            begin, end = max(begin - 1, 0), min(end + 1, last)
        by_deg = (angles_deg[end] - angles_deg[begin]) / (end - begin)
        for at in range(begin, end + 1):
            led_deg[at] = angles_deg[begin] + by_deg * (at - begin)
        moment = end
    return led_deg


def _too_fast(angles_deg: Sequence[float], moment: int, travel_deg: float) -> bool:
    return abs(angles_deg[moment + 1] - angles_deg[moment]) > travel_deg


PRICE = 2.9
"""The price of a start in degrees squared times seconds, at a tolerance of 1°. It grows with the tolerance's cube."""
DOWN_WEIGHT = 1e-3
"""The weight of an error below the horizon: small, but enough that the antenna is right when the target rises."""


@dataclass(frozen=True, slots=True)
class PlannedMotor:
    """What the plan needs to know of an axis. `speed_dps` and `coast_s` are the learnt values."""

    speed_dps: float
    coast_s: float
    tolerance_deg: float
    play_deg: float = 0.0
    switched: bool = True
    """By relays; else the motor goes to every angle by itself, and follows the path without steps."""
    alone: bool = False
    """It never runs together with the other motor: the supply of both is small."""
    brake_s: float = 0.0
    """A start takes so much longer after a while at rest: its brake is released first."""


@dataclass(frozen=True, slots=True)
class FlightPlan:
    route: Route
    order: Fly


@dataclass(frozen=True, slots=True)
class Antenna:
    """The antenna as the plan sees it: `stands_deg` on its axes now."""

    mount: Mount
    azimuth: PlannedMotor
    elevation: PlannedMotor
    stands_deg: tuple[float, float]


def plan_flight(name: str, path: KnownPath, antenna: Antenna, now_s: float, begin_on: Way | None = None) -> FlightPlan:
    """A path that has begun already is followed from now on. `begin_on`: the way to begin on, if a plan of many passes
    has chosen it; None: the best way."""
    mount, azimuth, elevation = antenna.mount, antenna.azimuth, antenna.elevation
    begin_s = max(path.begin_s, now_s)
    speeds = Speeds(azimuth.speed_dps, elevation.speed_dps, azimuth.switched)
    route = best_route(
        mount, path.directions(begin_s, STEP_S), antenna.stands_deg, begin_s - now_s, speeds, begin_on=begin_on
    )
    directions = path.directions(begin_s, PLAN_STEP_S)
    azimuths_deg, elevations_deg = _axis_angles(mount, directions, route.legs, azimuth, speeds)
    up = [1.0 if elevation_deg > 0 else DOWN_WEIGHT for _, elevation_deg in directions]
    flat = [mount.azimuth_weight(direction[1]) ** 2 * weight for direction, weight in zip(directions, up, strict=True)]
    azimuth_plan = _axis_plan(Trail(begin_s, azimuths_deg, flat), azimuth, mount.azimuth, now_s)
    elevation_plan = _axis_plan(Trail(begin_s, elevations_deg, up), elevation, mount.elevation, now_s)
    if azimuth.alone:

        def off_deg(at_s: float, azimuth_deg: float, elevation_deg: float) -> float:
            direction = path.direction(at_s)
            return mount.off_deg((azimuth_deg, elevation_deg), direction) if is_seen(mount, *direction) else 0.0

        steps = before_azimuth(azimuth_plan.steps, elevation_plan.steps, speeds, off_deg)
        elevation_plan = replace(elevation_plan, steps=steps)
    return FlightPlan(route, Fly(name, path.rows, azimuth_plan, elevation_plan))


def plan_given_angles(
    name: str, rows: Sequence[Row], axes: Sequence[Row], antenna: Antenna, now_s: float, *, span_s: tuple[float, float]
) -> Fly:
    """A part of a path whose axis angles are given: only the motors' steps are planned.

    `rows`: directions; `axes`: axis angles. `span_s`: the part's beginning and end.
    """
    mount, (begin_s, end_s) = antenna.mount, span_s
    moments_s = [begin_s + index * PLAN_STEP_S for index in range(max(2, int((end_s - begin_s) / PLAN_STEP_S) + 1))]
    azimuths_deg, elevations_deg = ([_between(axes, axis, at_s) for at_s in moments_s] for axis in (1, 2))
    even = [1.0] * len(moments_s)
    return Fly(
        name,
        tuple(rows),
        _axis_plan(Trail(begin_s, azimuths_deg, even), antenna.azimuth, mount.azimuth, now_s),
        _axis_plan(Trail(begin_s, elevations_deg, even), antenna.elevation, mount.elevation, now_s),
    )


def _between(rows: Sequence[Row], column: int, at_s: float) -> float:
    before, after, share = rows_around(rows, at_s)
    return before[column] + share * (after[column] - before[column])


def _axis_plan(trail: Trail, motor: PlannedMotor, limits: Range, now_s: float) -> AxisPlan:
    steps = _steps(trail, motor, now_s) if motor.switched else ()
    within = (replace(step, place_deg=limits.nearest(step.place_deg)) for step in steps)
    return AxisPlan(trail.begin_s, tuple(map(limits.nearest, trail.angles_deg)), tuple(within))


def _steps(trail: Trail, motor: PlannedMotor, now_s: float) -> tuple[Step, ...]:
    first, *others = best_steps(trail, motor.speed_dps, PRICE * motor.tolerance_deg**3, motor.play_deg)
    # The antenna follows its motor later by as long as it coasts.
    later_s = motor.coast_s + motor.brake_s
    return Step(now_s, first.place_deg), *(Step(each.leave_s - later_s, each.place_deg) for each in others)


def _axis_angles(
    mount: Mount,
    directions: Sequence[tuple[float, float]],
    legs: Sequence[Leg],
    azimuth: PlannedMotor,
    speeds: Speeds,
) -> tuple[list[float], list[float]]:
    """Every `PLAN_STEP_S`, on the way that is in force at each moment.

    Elevation within its limits, azimuth beyond them by its tolerance at most: so a step to where the target leaves the
    range has its place at the limit itself.
    """
    changes = [change_of(mount, directions, pair, speeds, stepped=azimuth.switched) for pair in pairwise(legs)]
    begins = [0, *(_begin(change, stepped=azimuth.switched) for change in changes)]
    low_deg, high_deg = mount.azimuth.min_deg - azimuth.tolerance_deg, mount.azimuth.max_deg + azimuth.tolerance_deg
    azimuths_deg, elevations_deg = [], []
    for leg, begin, end in zip(legs, begins, [*begins[1:], len(directions)], strict=True):
        way, kept_deg = leg.flown.way, []
        azimuth_deg = way.azimuth_deg
        for moment, direction in enumerate(directions[:end]):
            azimuth_deg, elevation_deg = mount.on_the_way(*direction, azimuth_deg, flipped=way.flipped)
            if moment < begin:
                continue
            kept_deg.append(min(max(azimuth_deg, low_deg), high_deg))
            elevations_deg.append(mount.clear_deg(mount.azimuth.nearest(azimuth_deg), elevation_deg))
        azimuths_deg += kept_deg if azimuth.switched else led(kept_deg, azimuth.speed_dps * PLAN_STEP_S)
    for change in changes:
        _lift(mount, directions, change, elevations_deg)
    return azimuths_deg, elevations_deg


def _lift(mount: Mount, directions: Sequence[tuple[float, float]], change: Change, elevations_deg: list[float]) -> None:
    """While azimuth turns from one leg to the next, elevation goes where the antenna points nearest to the target."""
    if change.turns_s == 0.0:  # both legs wait at the same limit
        return
    from_deg, there_deg = change.from_deg, change.there_deg
    begin, end = change.leaves_s / PLAN_STEP_S, (change.leaves_s + change.turns_s) / PLAN_STEP_S
    for moment in range(math.floor(begin), min(math.ceil(end) + 1, len(directions))):
        share = min(max((moment * PLAN_STEP_S - change.leaves_s) / change.turns_s, 0.0), 1.0)
        axis_azimuth_deg = from_deg[0] + share * (there_deg[0] - from_deg[0])
        lifted_deg = lifted_between_deg(axis_azimuth_deg, directions[moment], (from_deg[1], there_deg[1]))
        if lifted_deg is not None:
            elevations_deg[moment] = mount.clear_deg(axis_azimuth_deg, lifted_deg)


def _begin(change: Change, *, stepped: bool) -> int:
    """The moment at which the angles change to the new way. A step is made around the moment of its jump: half of the
    turn is before it. A motor without relays begins its turn at the last moment on the old way."""
    if stepped:
        return round((change.leaves_s + change.turns_s / 2) / PLAN_STEP_S)
    return round(change.leaves_s / PLAN_STEP_S) + 1
