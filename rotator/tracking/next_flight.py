"""The next flight to a target in the sky, its present or next pass, planned whole; and the next of the plan of many.

Knows the targets as plain values, the station and the antenna as it stands. It computes for up to some seconds, so
`planner` gives it a process of its own. Knows no clock and no thread: both its moments are arguments.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath, Row
from rotator.control.sky.route import Way
from rotator.exchange.flight_order import Fly
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.passes import Pass, passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Target, expected_error_deg
from rotator.orbits.targets import find
from rotator.tracking.planned import Followed
from rotator.tracking.schedule import schedule

AHEAD_S = 7 * 86_400.0
"""Longest wait for a target to rise, in seconds."""
LONGEST_S = 1800.0
"""Longest flight, in seconds. A longer pass is flown in pieces."""
SATELLITE_ROW_S, SLOW_ROW_S = 1.0, 20.0
"""Seconds between two rows of the path."""
JUDGED_S = 60.0
"""Samples of the expected error in a pass."""
CLOCK_ASIDE_S = 10.0
"""Seconds before now at which the rest of a pass begins, for the orders of a clock that is behind."""
AFTER_SET_S = 30.0
"""Programs send for a while after the target has set."""


class NeverRises(Exception):  # noqa: N818 - a sentence about a target
    """The target does not rise within `AHEAD_S`. The text names it."""


@dataclass(frozen=True, slots=True)
class Now:
    """One time on two clocks: UTC in seconds since 1970, and the control loop's clock."""

    utc_s: float
    loop_s: float
    clock_s: float = 0.0
    """The possible error of UTC, in seconds."""

    @property
    def apart_s(self) -> float:
        """UTC minus the loop's clock, in seconds."""
        return self.utc_s - self.loop_s


@dataclass(frozen=True, slots=True)
class Wanted:
    """A target as a plain value, for another process. `elements`: of a satellite; None for all other targets."""

    words: str
    site: Site
    elements: Elements | None

    def target(self) -> Target:
        """Raises NotThere, Unknown."""
        if self.elements is not None:
            return Satellite(self.elements, self.site)
        return find(self.words, self.site, Catalogue(()))


@dataclass(frozen=True, slots=True)
class NextFlight:
    """A pass, or a piece of one. `begin_utc_s`: when it rises, or the piece begins."""

    begin_utc_s: float
    end_utc_s: float
    order: Fly


def does_not_rise(target: Target) -> str:
    return f"{target.name} does not rise within {AHEAD_S / 86_400:.0f} days"


def next_flight(wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
    """Raises NeverRises, NotThere, Unknown."""
    target = wanted.target()
    found = next(passes(target, now.utc_s, now.utc_s + AHEAD_S), None)
    if found is None:
        raise NeverRises(does_not_rise(target))
    return flight_between(target, found, _span(found, now.utc_s), antenna, now)


def flight_between(
    target: Target, found: Pass, span_s: tuple[float, float], antenna: Antenna, now: Now, *, begin_on: Way | None = None
) -> NextFlight:
    """The part of a pass between two times of UTC, planned whole. `begin_on`: as in `plan_flight`."""
    begin_s, end_s = span_s
    path = target_path(target, begin_s, end_s, now.apart_s)
    order = plan_flight(target.name, path, antenna, now.loop_s, begin_on=begin_on).order
    # Of a pass that is flown in part, the whole is shown: it may be up while the antenna is still on its way.
    rises_s = (now.utc_s if found.aos_s is None else found.aos_s) - now.apart_s
    sets_s = math.inf if found.los_s is None else found.los_s - now.apart_s
    error_deg = _error_deg(target, begin_s, end_s, now.clock_s)
    order = replace(order, rises_s=rises_s, sets_s=sets_s, expected_error_deg=error_deg)
    return NextFlight(begin_s, end_s, order)


def rest_flight(wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
    """The rest of a present pass that a program already sends. Raises NotThere, Unknown."""
    target = wanted.target()
    rows, sets_s = rest_of_pass(target, now.utc_s)
    path = KnownPath(
        tuple((utc_s - now.apart_s, azimuth_deg, elevation_deg) for utc_s, azimuth_deg, elevation_deg in rows)
    )
    order = plan_flight(target.name, path, antenna, now.loop_s).order
    error_deg = _error_deg(target, now.utc_s, sets_s + JUDGED_S, now.clock_s)
    return replace(order, sets_s=sets_s - now.apart_s, expected_error_deg=error_deg)


def rest_of_pass(target: Target, utc_s: float) -> tuple[list[Row], float]:
    """Each second of it: the moment in UTC, azimuth, elevation; and when it sets. Raises NotThere."""
    rows: list[Row] = []
    last_up_s, at_s = utc_s, utc_s - CLOCK_ASIDE_S
    while at_s <= min(last_up_s + AFTER_SET_S, utc_s + LONGEST_S):
        seen = target.sight(at_s)
        rows.append((at_s, seen.azimuth_deg, seen.elevation_deg))
        if seen.elevation_deg > 0:
            last_up_s = max(last_up_s, at_s)
        at_s += 1.0
    return rows, last_up_s


def target_path(target: Target, begin_s: float, end_s: float, apart_s: float) -> KnownPath:
    """The target's path between two times of UTC, on a clock that is `apart_s` behind UTC."""
    row_s = SATELLITE_ROW_S if isinstance(target, Satellite) else SLOW_ROW_S
    count = max(2, math.ceil((end_s - begin_s) / row_s) + 1)
    moments_s = [min(begin_s + index * row_s, end_s) for index in range(count - 1)] + [max(end_s, begin_s + row_s)]
    rows = []
    for utc_s in dict.fromkeys(moments_s):
        sight = target.sight(utc_s)
        rows.append((utc_s - apart_s, sight.azimuth_deg, sight.elevation_deg))
    return KnownPath(tuple(rows))


def _span(found: Pass, now_s: float) -> tuple[float, float]:
    """Begin and end of the pass or of its rest, cut to the longest flight."""
    begin_s = now_s if found.aos_s is None else max(found.aos_s, now_s)
    end_s = math.inf if found.los_s is None else found.los_s
    return begin_s, min(end_s, begin_s + LONGEST_S)


def _error_deg(target: Target, begin_s: float, end_s: float, clock_s: float) -> float:
    count = int((end_s - begin_s) / JUDGED_S) + 1
    try:
        return max(expected_error_deg(target, begin_s + index * JUDGED_S, clock_s) for index in range(count))
    except NotThere:
        return 0.0


PLANNED_S = 86_400.0
SOON_S = 2.0
"""A flight is ordered when its antenna sets off within this time, in seconds."""


@dataclass(frozen=True, slots=True)
class WantedOften:
    """One `[[sky.follow]]` of the configuration."""

    wanted: Wanted
    priority: float
    min_culmination_deg: float

    def followed(self) -> Followed:
        """The same target for the plan of many passes. Raises NotThere, Unknown."""
        return Followed(self.wanted.target(), self.priority, self.min_culmination_deg)


@dataclass(frozen=True, slots=True)
class Upcoming:
    """`flight`: None before the antenna sets off. Of a long pass it is the next piece, as for a named target."""

    set_off_utc_s: float
    flight: NextFlight | None
    name: str = ""
    rises_utc_s: float = 0.0
    """When the pass begins, or the part of it that is flown."""


def next_followed(followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
    """None: nothing to fly within a day."""
    wishes = [each.followed() for each in followed]
    targets = {each.target.name: each.target for each in wishes}
    planned = schedule(wishes, antenna, now.utc_s, now.utc_s + PLANNED_S)
    flights = [(each.flight.set_off_s, each.found, each.flight) for each in planned if each.flight is not None]
    if not flights:
        return None
    set_off_s, found, flight = min(flights, key=lambda each: each[0])
    if set_off_s > now.utc_s + SOON_S:
        return Upcoming(set_off_s, None, found.name, flight.begin_s)
    span_s = flight.begin_s, min(flight.end_s, flight.begin_s + LONGEST_S)
    order = flight_between(targets[found.name], found, span_s, antenna, now, begin_on=flight.begin_on)
    return Upcoming(set_off_s, order, found.name, flight.begin_s)
