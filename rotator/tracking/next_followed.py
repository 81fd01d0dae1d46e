"""The next flight of the plan of many passes: which pass it is, when the antenna sets off, and then the flight itself.

Knows the followed targets as plain values, so that another process can compute it. Both moments are arguments.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.tracking.next_flight import SATELLITE_ROW_S, SLOW_ROW_S, NextFlight, Now, Wanted, target_path
from rotator.tracking.planned import Flight, Followed, PlannedPass
from rotator.tracking.schedule import schedule

PLANNED_S = 86_400.0
SOON_S = 2.0
"""A flight whose antenna sets off within this time is begun."""


@dataclass(frozen=True, slots=True)
class WantedOften:
    """One `[[sky.follow]]` of the configuration."""

    wanted: Wanted
    priority: float
    min_culmination_deg: float


@dataclass(frozen=True, slots=True)
class Upcoming:
    """`flight`: None before the antenna sets off."""

    set_off_utc_s: float
    flight: NextFlight | None


def next_followed(followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
    """None: there is nothing to fly for a day."""
    targets = {each.wanted.target().name: each for each in followed}
    planned = schedule(
        [Followed(each.wanted.target(), each.priority, each.min_culmination_deg) for each in followed],
        antenna,
        now.utc_s,
        now.utc_s + PLANNED_S,
    )
    flights = [(each.flight.set_off_s, each, each.flight) for each in planned if each.flight is not None]
    if not flights:
        return None
    set_off_s, first, flight = min(flights, key=lambda each: each[0])
    if set_off_s > now.utc_s + SOON_S:
        return Upcoming(set_off_s, None)
    return Upcoming(set_off_s, _flight(first, flight, targets[first.name].wanted, antenna, now))


def _flight(planned: PlannedPass, flight: Flight, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
    target = wanted.target()
    row_s = SATELLITE_ROW_S if wanted.elements is not None else SLOW_ROW_S
    path = target_path(target, flight.begin_s, flight.end_s, row_s, now.apart_s)
    order = plan_flight(target.name, path, antenna, now.loop_s, begin_on=flight.begin_on).order
    sets_s = planned.found.los_s
    late = order if sets_s is None else replace(order, sets_s=sets_s - now.apart_s)
    return NextFlight(flight.begin_s, flight.end_s, late)
