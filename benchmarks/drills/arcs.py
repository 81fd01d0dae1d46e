"""Targets of a drill: passes along great circles, of any length, named by the numbers that make them.

Knows where such a target is at each moment, and has its passes planned as the box has those of a satellite. `arc 20 120
40 350 1 60` rises 20 s after the beginning at azimuth 350, is up for 120 s, stays down for 40 s, and so on; it passes
to the right (-1: to the left) and culminates at 60 degrees. Does not know who tracks it.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Unknown
from rotator.orbits.earth import Site
from rotator.tracking.next_flight import NextFlight, Now, Upcoming, Wanted, WantedOften
from rotator.tracking.planned import SPARE_S

SITE = Site(0.0, 0.0, 0.0)
ROW_S = 1.0
SETS_OFF_S = 30.0
"""A flight of the plan of many passes is ordered this long before the antenna must be in place."""


@dataclass(frozen=True, slots=True)
class Arc:
    """Moments count from the beginning of the drill."""

    first_s: float
    lasts_s: float
    gap_s: float
    azimuth_deg: float
    side: float
    top_deg: float

    @classmethod
    def parse(cls, words: str) -> Arc:
        """Raises Unknown."""
        head, *numbers = words.split()
        try:
            if head != "arc":
                raise ValueError
            return cls(*map(float, numbers))
        except (TypeError, ValueError):
            raise Unknown(f'"{words}" is no arc') from None

    def direction(self, at_s: float) -> tuple[float, float]:
        """Azimuth and elevation at this moment; before a rise, the direction of that rise."""
        return self._direction(at_s, self.around(at_s)[0])

    def _direction(self, at_s: float, begin_s: float) -> tuple[float, float]:
        """Azimuth and elevation in the pass that rises at `begin_s`."""
        way = math.pi * min(max((at_s - begin_s) / self.lasts_s, 0.0), 1.0)
        top = math.radians(self.top_deg)
        turned_deg = math.degrees(math.atan2(math.sin(way) * math.cos(top), math.cos(way)))
        elevation_deg = math.degrees(math.asin(min(max(math.sin(way) * math.sin(top), 0.0), 1.0)))
        return (self.azimuth_deg + self.side * turned_deg) % 360.0, elevation_deg

    def around(self, at_s: float) -> tuple[float, float]:
        """The moments of rise and set of the present pass, or of the next one."""
        number = max(0.0, math.floor((at_s - self.first_s) / (self.lasts_s + self.gap_s)))
        begin_s = self.first_s + number * (self.lasts_s + self.gap_s)
        if at_s >= begin_s + self.lasts_s:
            begin_s += self.lasts_s + self.gap_s
        return begin_s, begin_s + self.lasts_s

    def flight(self, name: str, antenna: Antenna, now: Now) -> NextFlight:
        """As `rotator.tracking.next_flight.next_flight`."""
        rises_s, end_s = self.around(now.utc_s)
        begin_s = max(rises_s, now.utc_s)
        count = max(2, math.ceil((end_s - begin_s) / ROW_S) + 1)
        moments_s = [begin_s + index * ROW_S for index in range(count)]
        rows = tuple((at_s - now.apart_s, *self._direction(at_s, rises_s)) for at_s in moments_s)
        return NextFlight(begin_s, end_s, plan_flight(name, KnownPath(rows), antenna, now.loop_s).order)


def draw_arc(chance: random.Random, at_s: float) -> str:
    """The words of an arc with a pass that is on at this moment, comes soon, or has just ended."""
    lasts_s, gap_s = chance.choice((10.0, 40.0, 120.0, 300.0)), chance.choice((5.0, 40.0, 600.0))
    first_s = max(0.0, at_s + chance.choice((-lasts_s, -lasts_s / 2, 0.0, 5.0, 40.0)) + chance.uniform(-3.0, 3.0))
    azimuth_deg, top_deg = chance.choice((0, 180, chance.randrange(360))), chance.choice((5, 30, 60, 85, 90))
    return f"arc {first_s:.1f} {lasts_s:g} {gap_s:g} {azimuth_deg} {chance.choice((-1, 1))} {top_deg}"


class Arcs:
    """Finds and plans arcs: `rotator.tracking` gets this object in place of a catalogue and a planning process."""

    def has_news(self) -> bool:
        return False

    def find(self, words: str) -> Wanted | Aim:
        """Raises Unknown."""
        try:
            azimuth_deg, elevation_deg = map(float, words.split())
        except ValueError:
            Arc.parse(words)
            return Wanted(words, SITE, None)
        return Aim(azimuth_deg, elevation_deg)

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        return Arc.parse(wanted.words).flight(wanted.words, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return self.plan(wanted, antenna, now).order

    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        """The flight of the arc that rises first."""
        arcs = [Arc.parse(each.wanted.words) for each in followed]
        rises_s, first = min((arc.around(now.utc_s)[0], index) for index, arc in enumerate(arcs))
        set_off_s = rises_s - SPARE_S - SETS_OFF_S
        if set_off_s > now.utc_s:
            return Upcoming(set_off_s, None)
        return Upcoming(set_off_s, arcs[first].flight(followed[first].wanted.words, antenna, now))
