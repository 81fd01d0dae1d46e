"""A box that knows the sky, in simulated time: the whole control loop on simulated chips, its tracker, and UTC.

Plans are computed in the test's own process, at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

from firmware_sim.clock import SimClock
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.assembly.tracking import TrackedBox, wanted_often, why_no_plan
from rotator.config.load import parse
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Order
from rotator.exchange.sources import Source
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import Pass, passes
from rotator.orbits.targets import find
from rotator.runtime.loop import ControlLoop
from rotator.tracking.follower import Follower
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import (
    NextFlight,
    Now,
    Upcoming,
    Wanted,
    WantedOften,
    next_flight,
    next_followed,
    rest_flight,
)
from rotator.tracking.program import Program, program_flight
from rotator.tracking.tracker import Tracker

ELEMENTS = Path(__file__).parents[1] / "orbits" / "elements-2025.tle"
BERLIN = Site(52.52, 13.4, 40.0)
FEBRUARY_S = 1_739_000_000.0
"""8 February 2025, 07:33:20 UTC: some days after the elements' epochs."""
PERIOD_S = 0.1
"""Twice the usual one, for half the work: what is looked at here is who flies what and when, in seconds."""
SELDOM_S = 0.5


class InThisProcess:
    """Plans at once. `plans`: each, with the moment at which it was made. `meanwhile` happens while it computes.

    Boxes that begin at one moment ask for the same plans: each is computed once.
    """

    flight = staticmethod(cache(next_flight))
    followed = staticmethod(cache(next_followed))

    def __init__(self) -> None:
        self.plans: list[tuple[Now, NextFlight]] = []
        self.meanwhile: Callable[[], None] = lambda: None

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        self.meanwhile()
        self.plans.append((now, self.flight(wanted, antenna, now)))
        return self.plans[-1][1]

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        self.meanwhile()
        return program_flight(program, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return rest_flight(wanted, antenna, now)

    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        self.meanwhile()
        return self.followed(followed, antenna, now)


class SlowSensors(TrackedBox):
    """Its angles are not known before this moment, on the loop's clock."""

    read_s = 0.0

    def antenna(self) -> Antenna | None:
        return super().antenna() if self.status().at_s >= self.read_s else None


class Box:
    def __init__(
        self,
        begin_utc_s: float,
        site: Site = BERLIN,
        follow: str = "",
        *,
        read_after_s: float = 0.0,
        restarted: bool = False,
        looks: bool = True,
        elements: Path = ELEMENTS,
        in_use: Sequence[str] = (),
    ) -> None:
        """`follow`: `[[sky.follow]]` of the configuration. `read_after_s`: until then no angle is known.

        `restarted`: its antenna has outlived an earlier run. Not `looks`: its tracking thread has had no turn yet.
        `in_use`: names of the satellites that the station uses.
        """
        config = parse(follow, "box")
        self.clock = SimClock()
        station = Station(config, self.clock, self.clock.sleep, (10.0, 0.0), add_alarm=self.clock.add_alarm)
        assert station.world is not None
        self.world = station.world
        self.mount = mount = build_mount(config)
        self.loop = ControlLoop(build_controller(config), station.rotor, self.clock, PERIOD_S)
        self.planner = InThisProcess()
        self.clock_trusted = True
        self.clock_error_s = 0.0
        self.known = sky = KnownSky(site, Catalogue((str(elements),)))
        self.tracked = tracked = SlowSensors(config, self.loop, mount)
        tracked.read_s = self.clock() + read_after_s
        self.tracker = Tracker(
            sky,
            self.planner,
            tracked,
            lambda: self.clock_trusted,
            why_no_plan=lambda: why_no_plan(config.sky, sky),
            rest=lambda: self.follower.rest,
        )
        self._listener = StreamListener(
            sky, self.planner, tracked, lambda: self.utc_s, self.tracker.clock_trusted, wanted=lambda: in_use
        )
        begun_s = self.clock() if restarted else None
        self.follower = Follower(self.tracker, self.planner, tracked, lambda: wanted_often(config.sky, sky)[0], begun_s)
        self.before_heard: Callable[[Order], None] = lambda _order: None
        self.after_heard: Callable[[Order], None] = lambda _order: None
        """What another thread does before, or after, the box's own listeners hear of an order."""
        self.loop.overhear(lambda _source, order: self.before_heard(order))
        self.loop.overhear(self._hear)
        self.loop.overhear(lambda _source, order: self.after_heard(order))
        self._begin_utc_s = begin_utc_s
        for _ in range(round(1.0 / PERIOD_S)):
            self.clock.sleep(PERIOD_S)
            self.loop.cycle()
        if looks:
            self.look()

    def _hear(self, source: Source, order: Order) -> None:
        self._listener.hear(source, order)
        self.tracker.heard(source, order)
        self.follower.heard(source, order)

    def _now(self) -> Now:
        return Now(self.utc_s, self.clock(), self.clock_error_s)

    @property
    def utc_s(self) -> float:
        return self._begin_utc_s + self.clock()

    def set_clock(self, by_s: float) -> None:
        self._begin_utc_s += by_s

    def wait(self, seconds: float, until: Callable[[], bool] = lambda: False) -> bool:
        """Let time pass, no longer than until that is so."""
        end_s = self.clock() + seconds
        while self.clock() < end_s:
            if until():
                return True
            for _ in range(5):
                self.clock.sleep(PERIOD_S)
                self.loop.cycle()
            self._listener.step(self._now)
            self.look()
        return until()

    def rest(self, seconds: float) -> None:
        """Let time pass while the antenna stands: the control loop looks seldom."""
        end_s = self.clock() + seconds
        while self.clock() < end_s:
            self.clock.sleep(SELDOM_S)
            self.loop.cycle()
            assert not self.loop.status.moving
            self._listener.step(self._now)
            self.look()

    def look(self) -> None:
        """The tracking thread has its turn."""
        if self.tracker.wants_new_files:
            self.known.refresh()
            self.tracker.read_new_files()
        self.tracker.step(self._now())
        self.follower.step(self._now())

    def off_deg(self, name: str) -> float:
        """Between the boom and the target, as the world has them."""
        sight = find(name, BERLIN, Catalogue((str(ELEMENTS),))).sight(self.utc_s)
        boom = self.world.antenna()
        return great_circle_deg(*boom, sight.azimuth_deg, sight.elevation_deg)


@cache
def pass_of(name: str, least_deg: float = 20.0, after_s: float = FEBRUARY_S + 600.0) -> Pass:
    target = find(name, BERLIN, Catalogue((str(ELEMENTS),)))
    return next(passes(target, after_s, after_s + 2 * 86_400.0, least_deg))
