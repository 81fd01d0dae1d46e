"""The thread that reads the sensors, where the bus hangs before the first reading: on every kind of rotor it is said.

Judged by what the status says, and by the simulated motors. In simulated time: a cycle without a round of readings.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.config.kinds import KINDS, KindName
from rotator.exchange.orders import Jog, Release
from rotator.exchange.sources import Source
from rotator.runtime.journal import Journal
from rotator.runtime.loop import ControlLoop
from rotator.runtime.sensor_thread import FIRST_S, LONGEST_READ_S, NEVER_READ, SLOW, SensorThread
from tests.runtime import loop_rig
from tests.runtime.loop_rig import AZ, EL, PERIOD_S

TOLD_S = 5.0
CONSOLE = Source("console")


class Rig(loop_rig.Rig):
    """A box whose reading thread hangs while `hangs`."""

    def __init__(self, kind: KindName) -> None:
        super().__init__(f'[rotor]\ntype = "{kind}"\n')
        self.kind = kind
        self.hangs = True

    def run(self, seconds: float, loop: ControlLoop | None = None) -> None:
        if not self.hangs:
            return super().run(seconds, loop)
        for _ in range(round(seconds / PERIOD_S)):
            self.loop.act()
            self.clock.sleep(PERIOD_S)
        return None

    def told(self) -> set[Axis]:
        return {axis for axis in Axis if NEVER_READ in str(self.loop.status.axis(axis).fault)}


@pytest.fixture(params=list(KINDS))
def rig(request: pytest.FixtureRequest) -> Iterator[Rig]:
    rig = Rig(request.param)
    yield rig
    rig.station.close()


def test_a_bus_that_hangs_from_the_start_is_said_and_no_order_turns_a_motor(rig: Rig) -> None:
    """No reading ever comes: without a first one there is none that could be late."""
    twin = Rig(rig.kind)  # a control box without a relay in its supply turns at power-on, without any order
    twin.run(TOLD_S)
    rig.loop.post(CONSOLE, Jog(AZ, Direction.PLUS, 2.0))
    rig.run(TOLD_S)
    assert rig.told() == set(Axis)
    assert rig.world.antenna() == twin.world.antenna()
    twin.station.close()


def test_one_sensor_that_hangs_the_thread_from_the_start_is_said(rig: Rig) -> None:
    sensors = rig.station.rotor.sensors
    rig.station.rotor.sensors = {AZ: sensors[AZ]}
    rig.loop.cycle()
    rig.station.rotor.sensors = sensors
    rig.run(TOLD_S)
    assert EL in rig.told()
    assert rig.loop.status.azimuth.fault, "its reading is old"


def test_a_bus_that_answers_late_is_no_fault_and_one_that_comes_back_may_be_used(rig: Rig) -> None:
    rig.run(FIRST_S - 0.2)
    assert rig.told() == set()
    rig.run(TOLD_S)
    assert rig.told() == set(Axis)
    rig.hangs = False
    for _ in range(2):
        rig.run(1.0)
        rig.loop.post(CONSOLE, Release())
    rig.run(1.0)
    assert rig.told() == set()


@pytest.mark.parametrize(("takes_s", "is_good"), [(0.01, True), (LONGEST_READ_S, True), (LONGEST_READ_S + 0.01, False)])
def test_a_reading_that_took_too_long_may_be_an_old_one_and_is_none(takes_s: float, is_good: bool) -> None:
    rig = Rig("relay-pot")
    sensors = SensorThread(rig.station.rotor, rig.clock, PERIOD_S, Journal(rig.clock), lambda: None)

    class Slow:
        source = AngleSource.MEASURED

        def read(self) -> float:
            rig.clock.sleep(takes_s)
            return 0.5

    reading = sensors._read(AZ, Slow())
    assert (reading.raw == 0.5, reading.problem == SLOW) == (is_good, not is_good)
    assert reading.at_s == rig.clock()
    rig.station.close()
