"""The next flight of the plan of many passes: which pass it is, when the antenna sets off, and then the flight itself.

Knows the followed targets as plain values, so that another process can compute it. Both moments are arguments.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.control.sky.flight_plan import Antenna
from rotator.tracking.next_flight import LONGEST_S, NextFlight, Now, Wanted, flight_between
from rotator.tracking.planned import Followed
from rotator.tracking.schedule import schedule

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
