"""Parking: by order, when no order has moved the antenna for long, and before a storm."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.config.load import parse
from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.orders import Aim, Jog, Order, Park, Release, RunTimed
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


def test_the_park_position_is_on_the_rotors_own_scale() -> None:
    """A mount askew by 20°: parked, the rotor's own scale shows the position of the file, not that of north."""
    clock = SimClock()
    config = parse(CONFIGURATION.replace("\n[azimuth]", "\n" + "[azimuth]\noffset_deg = 20"), "test")
    plant = BoxPlant(config, clock, (180.0, 10.0), "gs232")
    plant.post(CONSOLE, Park())
    plant.run_until(clock() + 15.0)
    assert plant.world.shafts() == pytest.approx(PARKED, abs=1.5)


def test_a_storm_park_that_was_not_stopped_goes_on_after_resume() -> None:
    station = Station()
    station.say(LINK, Aim(200, 30), 5.0)
    station.say(CONSOLE, Park(storm=True), 2.5)
    station.say(CONSOLE, Release(), 11.0)
    assert station.at(*PARKED)
