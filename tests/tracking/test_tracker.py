"""The box tracks a target by itself, from one pass to the next: the whole control loop on simulated chips, and a sky.

Time is simulated: UTC runs beside the loop's clock. The plan is computed in the test's own process.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.sky import TrackedBox
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.flight_plan import Antenna
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import Pass, passes
from rotator.orbits.targets import find
from rotator.orders import BOTH, Aim, Fly, Jog, Release, Source, Stop
from rotator.runtime.loop import ControlLoop
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import NextFlight, Now, Wanted, next_flight, rest_flight
from rotator.tracking.tracker import CLOCK_UNSURE, Tracker

ELEMENTS = Path(__file__).parents[1] / "orbits" / "elements-2025.tle"
BERLIN = Site(52.52, 13.4, 40.0)
FEBRUARY_S = 1_739_000_000.0
"""8 February 2025, 07:33:20 UTC: some days after the elements' epochs."""
PERIOD_S = 0.05


class InThisProcess:
    """Plans at once. `plans`: each, with the moment at which it was made."""

    def __init__(self) -> None:
        self.plans: list[tuple[Now, NextFlight]] = []

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        self.plans.append((now, next_flight(wanted, antenna, now)))
        return self.plans[-1][1]

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return rest_flight(wanted, antenna, now)


class Box:
    def __init__(self, begin_utc_s: float, site: Site = BERLIN) -> None:
        config = parse("", "box")
        self.clock = SimClock()
        station = Station(config, self.clock, self.clock.sleep, (10.0, 0.0), add_alarm=self.clock.add_alarm)
        assert station.world is not None
        self.world = station.world
        mount = build_mount(config)
        self.loop = ControlLoop(build_controller(config), station.rotor, self.clock, PERIOD_S)
        self.planner = InThisProcess()
        self.clock_trusted = True
        sky = KnownSky(site, Catalogue((str(ELEMENTS),)))
        tracked = TrackedBox(config, self.loop, mount)
        self.tracker = Tracker(sky, self.planner, tracked, lambda: self.clock_trusted)
        self._listener = StreamListener(sky, self.planner, tracked, lambda: self.utc_s, self.tracker.clock_trusted)
        self.loop.overhear(self._listener.hear)
        self._begin_utc_s = begin_utc_s
        self.wait(1.0)

    def _now(self) -> Now:
        return Now(self.utc_s, self.clock())

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
            for _ in range(10):
                self.clock.sleep(PERIOD_S)
                self.loop.cycle()
            self._listener.step(self._now)
            self.tracker.step(self._now())
        return until()

    def off_deg(self, name: str) -> float:
        """Between the boom and the target, as the world has them."""
        sight = find(name, BERLIN, Catalogue((str(ELEMENTS),))).sight(self.utc_s)
        boom = self.world.antenna()
        return great_circle_deg(*boom, sight.azimuth_deg, sight.elevation_deg)


def pass_of(name: str, least_deg: float = 20.0) -> Pass:
    target = find(name, BERLIN, Catalogue((str(ELEMENTS),)))
    return next(passes(target, FEBRUARY_S + 600.0, FEBRUARY_S + 2 * 86_400.0, least_deg))


@pytest.fixture
def rise() -> Box:
    """Three minutes before the ISS rises."""
    begin = pass_of("iss").aos_s
    assert begin is not None
    return Box(begin - 180.0)


def test_it_waits_where_the_satellite_rises_and_follows_it_to_its_set_and_goes_on_to_the_next(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    assert rise.tracker.state == "planning"
    found = pass_of("iss")
    assert found.aos_s is not None
    assert found.los_s is not None
    rise.wait(found.aos_s - 15.0 - rise.utc_s)
    assert rise.tracker.state == "tracking"
    assert rise.loop.status.flown is not None
    assert rise.loop.status.flown.name.startswith("ISS")
    assert not rise.loop.status.moving, "it stands 15 s before the rise"
    worst_deg = 0.0
    while rise.utc_s < found.los_s - 5.0:
        rise.wait(1.0)
        if rise.utc_s > found.aos_s:
            worst_deg = max(worst_deg, rise.off_deg("iss"))
    assert worst_deg < 5.0

    # Then to the next rise.
    rise.wait(60.0)
    status = rise.loop.status
    assert status.flown is not None
    assert status.flown.begin_s > status.at_s + 3000.0
    assert not status.moving
    rows = rise.planner.plans[-1][1].order.path
    assert abs(math.remainder(rise.world.antenna()[0] - rows[0][1], 360.0)) < 5.0
    assert len(rise.planner.plans) == 2


def test_a_plan_of_long_ago_is_made_again_before_its_pass(rise: Box) -> None:
    """Newer elements may have come meanwhile, and a person may have turned the antenna by hand."""
    early = Box(rise.utc_s - 600.0)
    assert early.tracker.track("iss") == ""
    early.wait(665.0)
    assert len(early.planner.plans) == 2
    now, flight = early.planner.plans[1]
    assert flight.begin_utc_s - now.utc_s == pytest.approx(120.0, abs=1.0)


@pytest.mark.parametrize("hours_to_go", [0.5, 26.0])
def test_a_clock_that_is_set_makes_a_new_plan(rise: Box, hours_to_go: float) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(2.0)
    rise.set_clock(-3600.0 * hours_to_go)
    rise.wait(2.0)
    assert len(rise.planner.plans) == 2
    assert rise.planner.plans[1][1].begin_utc_s > rise.utc_s


PC, PERSON = Source("gs232b", 1), Source("console", 1)


@pytest.mark.parametrize(
    ("source", "order"),
    [
        (PC, Aim(100.0, 10.0)),
        (PERSON, Stop(latch=True)),
        (PC, Stop(BOTH)),
        (PERSON, Jog(Axis.AZIMUTH, Direction.PLUS, 1)),
    ],
)
def test_another_sender_takes_the_antenna_and_keeps_it(rise: Box, source: Source, order: Aim | Stop | Jog) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(5.0)
    rise.loop.post(source, order)
    rise.wait(3.0)
    assert rise.tracker.state.startswith("ended: ")
    rise.loop.post(PERSON, Release())
    rise.wait(40.0)
    stood = rise.world.antenna()
    rise.wait(30.0)
    assert rise.world.antenna() == pytest.approx(stood, abs=0.1)
    assert len(rise.planner.plans) == 1


def test_after_a_fault_that_a_person_has_acknowledged_nothing_goes_on(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(5.0)
    rise.world.inject("azimuth-pot-open")
    rise.wait(5.0)
    assert rise.loop.status.faults
    rise.world.clear("azimuth-pot-open")
    rise.loop.post(PERSON, Release())
    rise.wait(5.0)
    assert rise.tracker.state.startswith("ended: ")
    assert not rise.loop.status.moving


def test_off_stops_the_antenna(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    assert rise.wait(20.0, lambda: rise.loop.status.moving)
    rise.tracker.off()
    rise.wait(3.0)
    assert not rise.loop.status.moving
    assert rise.loop.status.flown is None
    assert rise.tracker.state == "off"
    assert not rise.loop.status.latched


def test_another_target_takes_the_place_of_the_first(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(5.0)
    assert rise.tracker.track("moon") == ""
    rise.wait(5.0)
    assert rise.loop.status.flown is not None
    assert rise.loop.status.flown.name == "Moon"


def test_a_direction_is_an_order_like_any(rise: Box) -> None:
    assert rise.tracker.track("100 20") == ""
    rise.wait(60.0)
    assert rise.world.antenna() == pytest.approx((100.0, 20.0), abs=4.0)
    assert rise.tracker.state == "off"


def test_what_cannot_be_tracked_is_told_and_nothing_moves(rise: Box) -> None:
    assert rise.tracker.track("xyzzy").startswith('"xyzzy" is not among the ')
    rise.clock_trusted = False
    assert rise.tracker.track("iss") == CLOCK_UNSURE
    rise.wait(5.0)
    assert not rise.loop.status.moving
    rise.tracker.clock_is_right()
    assert rise.tracker.track("iss") == ""


def test_a_target_that_never_rises_is_told(rise: Box) -> None:
    south = Box(rise.utc_s, Site(-85.0, 0.0))
    assert south.tracker.track("cas a") == ""
    south.wait(2.0)
    assert south.tracker.state == "ended: Cas A does not rise within 7 days"


# --- a program sends the directions of a satellite


def sends(box: Box, seconds: int, off_deg: float = 0.0) -> None:
    """Whole degrees, once a second, by a clock that is three seconds ahead."""
    iss = find("iss", BERLIN, Catalogue((str(ELEMENTS),)))
    for _ in range(seconds):
        sight = iss.sight(box.utc_s + 3.0)
        box.loop.post(PC, Aim(round(sight.azimuth_deg + off_deg) % 360.0, max(0.0, round(sight.elevation_deg))))
        box.wait(1.0)


@pytest.fixture
def up(rise: Box) -> Box:
    """The ISS rose half a minute ago."""
    return Box(rise.utc_s + 210.0)


def test_its_satellite_is_named_and_flown_until_its_orders_depart(up: Box) -> None:
    sends(up, 14)
    assert up.loop.status.recognised.startswith("ISS")
    assert up.loop.status.controlled_by == str(PC), "the antenna is the program's still"
    sends(up, 60)
    assert up.loop.status.recognised.startswith("ISS")
    sends(up, 1, off_deg=8.0)
    assert up.loop.status.recognised == ""
    assert up.loop.status.flown is None


def test_while_the_clock_may_be_wrong_no_satellite_is_flown(up: Box) -> None:
    up.clock_trusted = False
    sends(up, 20)
    assert up.loop.status.recognised == ""
