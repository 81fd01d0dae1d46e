"""Parking: by order, when no order has moved the antenna for long, and before a storm."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.config.load import parse
from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.orders import Aim, Jog, LetGo, Mode, Order, Park, Release, RunTimed, SetMode, Stop
from rotator.exchange.sources import Source
from rotator.rehearsal.plants import BoxPlant

LINK, CONSOLE = Source("gs232b", 1), Source("console")
PARKED = (90.0, 45.0)
CONFIGURATION = """
[mount]
park_azimuth_deg = 90
park_elevation_deg = 45
park_after_s = 12
[azimuth]
speed_dps = 12
[elevation]
speed_dps = 5.4
[sim.azimuth]
speed_dps = 12
[sim.elevation]
speed_dps = 5.4
"""
"""Motors twice as fast as a G-5500's: half the simulated time."""


class Station:
    def __init__(self) -> None:
        self.clock = SimClock()
        self.plant = BoxPlant(parse(CONFIGURATION, "test"), self.clock, (180.0, 10.0), "gs232")

    def say(self, source: Source, order: Order, then_s: float) -> None:
        self.plant.post(source, order)
        self.plant.run_until(self.clock() + then_s)

    def at(self, azimuth_deg: float, elevation_deg: float) -> bool:
        boom_az_deg, boom_el_deg = self.plant.world.antenna()
        return abs(boom_az_deg - azimuth_deg) < 1.0 and abs(boom_el_deg - elevation_deg) < 1.0


def test_before_any_order_nothing_parks() -> None:
    station = Station()
    station.plant.run_until(24.0)
    assert station.at(180, 10)
    assert station.plant.relay_starts() == 0


@pytest.mark.parametrize("order", [RunTimed(), Jog(Axis.AZIMUTH, Direction.OFF), Aim(200, 30, engaged=False)], ids=str)
def test_an_order_that_moves_nothing_does_not_park_it_later(order: Order) -> None:
    station = Station()
    station.say(LINK, order, 24.0)
    assert station.at(180, 10)
    assert station.plant.relay_starts() == 0


def test_so_long_after_the_last_order_it_parks_once() -> None:
    station = Station()
    station.say(LINK, Aim(200, 30), 11.0)
    assert station.at(200, 30)
    station.say(LINK, Aim(200, 30), 11.0)
    assert station.at(200, 30)
    station.plant.run_until(station.clock() + 15.0)
    assert station.at(*PARKED)
    starts = station.plant.relay_starts()
    station.plant.run_until(station.clock() + 30.0)
    assert station.plant.relay_starts() == starts


@pytest.mark.long
def test_an_antenna_that_waits_for_its_target_is_not_idle() -> None:
    """A satellite rises after three times as long; once it has set for so long, the antenna parks."""
    station = Station()
    station.plant.run_until(2.5)
    begin_s = station.clock() + 37.5
    path = KnownPath(((begin_s, 200.0, 0.0), (begin_s + 40.0, 240.0, 10.0)))
    motor = PlannedMotor(12.0, 0.17, 4.0)
    antenna = Antenna(Mount(Range(0, 450), Range(0, 180)), motor, motor, (180.0, 10.0))
    station.say(Source("track"), plan_flight("SO-50", path, antenna, station.clock()).order, 35.0)
    assert station.plant.world.antenna() == pytest.approx((200.0, 0.0), abs=5.0)
    station.plant.run_until(begin_s + 42.0)
    assert station.plant.world.antenna() == pytest.approx((240.0, 10.0), abs=6.0)
    station.plant.run_until(begin_s + 75.0)
    assert station.at(*PARKED)


def test_in_a_storm_it_stays_parked_until_a_person_releases_it() -> None:
    station = Station()
    station.say(LINK, Aim(200, 30), 1.0)
    station.say(CONSOLE, Park(storm=True), 15.0)
    assert station.at(*PARKED)
    assert (station.plant.status.latched, station.plant.status.storm) == ("console", True)
    station.say(LINK, Aim(200, 30), 15.0)
    assert station.at(*PARKED)
    station.say(CONSOLE, Release(), 0.5)
    station.say(LINK, Aim(200, 30), 11.0)
    assert station.at(200, 30)


def test_the_park_position_is_on_the_rotors_own_scale() -> None:
    """A mount askew by 20°: parked, the rotor's own scale shows the position of the file, not that of north."""
    clock = SimClock()
    config = parse(CONFIGURATION.replace("\n[azimuth]", "\n" + "[azimuth]\noffset_deg = 20"), "test")
    plant = BoxPlant(config, clock, (180.0, 10.0), "gs232")
    plant.post(CONSOLE, Park())
    plant.run_until(clock() + 15.0)
    assert plant.world.shafts() == pytest.approx(PARKED, abs=1.5)


WAYS_TO_STOP: list[tuple[Source, Order]] = [
    (CONSOLE, Stop(latch=True)),
    (LINK, Stop()),
    (LINK, Stop((Axis.AZIMUTH,))),
    (Source("panel"), SetMode(Mode.AUTO)),
]


@pytest.mark.parametrize("stop", WAYS_TO_STOP, ids=str)
def test_a_storm_park_that_was_stopped_does_not_go_on_after_resume(stop: tuple[Source, Order]) -> None:
    station = Station()
    station.say(LINK, Aim(200, 30), 5.0)
    station.say(CONSOLE, Park(storm=True), 2.5)
    assert station.plant.status.moving
    station.say(*stop, 2.5)
    station.say(CONSOLE, Release(), 0.0)
    stood, starts = station.plant.world.antenna(), station.plant.relay_starts()
    station.plant.run_until(station.clock() + 24.0)
    assert station.at(*stood)
    assert station.plant.relay_starts() == starts


def test_a_storm_park_that_was_not_stopped_goes_on_after_resume() -> None:
    station = Station()
    station.say(LINK, Aim(200, 30), 5.0)
    station.say(CONSOLE, Park(storm=True), 2.5)
    station.say(CONSOLE, Release(), 11.0)
    assert station.at(*PARKED)


@pytest.mark.long
@pytest.mark.parametrize(
    ("held", "released"),
    [
        ((CONSOLE, Stop(latch=True)), (CONSOLE, Release())),
        ((Source("panel"), SetMode(Mode.PARK)), (Source("panel"), SetMode(Mode.AUTO))),
    ],
    ids=["a stop", "the mode switch"],
)
def test_a_person_who_lets_it_go_on_after_a_long_stop_starts_no_motor(
    held: tuple[Source, Order], released: tuple[Source, Order]
) -> None:
    """They may stand on the mast: an idle antenna that parks at this moment would hit them."""
    station = Station()
    station.say(LINK, Aim(200, 30), 7.5)
    station.say(*held, 24.0)
    station.say(*released, 24.0)
    assert station.at(200, 30)
    station.say(LINK, Aim(210, 30), 27.0)
    assert station.at(*PARKED), "an order begins the idle time again"


@pytest.mark.parametrize("stop", [Stop(), Stop((Axis.AZIMUTH,)), Stop(latch=True), LetGo()], ids=str)
def test_an_antenna_that_was_stopped_does_not_park_by_itself(stop: Order) -> None:
    station = Station()
    station.say(LINK, Aim(300, 10), 2.5)
    station.say(LINK, stop, 2.5)
    stood, starts = station.plant.world.antenna(), station.plant.relay_starts()
    station.plant.run_until(station.clock() + 13.5)
    assert station.at(*stood)
    assert station.plant.relay_starts() == starts


def test_a_motor_that_was_stuck_is_not_tried_again_because_the_antenna_is_idle() -> None:
    station = Station()
    station.say(LINK, Aim(300, 10), 1.5)
    station.plant.world.inject("azimuth-motor-stalled")
    station.plant.run_until(station.clock() + 2.5)
    assert station.plant.status.faults
    station.plant.world.clear("azimuth-motor-stalled")
    station.say(LINK, Stop(), 0.5)
    assert not station.plant.status.faults
    starts = station.plant.relay_starts()
    station.plant.run_until(station.clock() + 13.5)
    assert station.plant.relay_starts() == starts
    station.say(LINK, Aim(200, 30), 27.0)
    assert station.at(*PARKED), "an order begins the idle time again"
