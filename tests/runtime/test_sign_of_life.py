"""The control loop's sign of life: after a step that went well, and after no other.

Whoever hears it (a one-shot in the motors' supply, the service manager) switches off when it stops.
"""

from __future__ import annotations

from typing import cast

import pytest

from firmware_sim.clock import SimClock
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction, HardwareError
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.calibrating.rig import AxisRig
from rotator.config.load import parse
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.rotors.relays import RelayRotor
from rotator.runtime.loop import ControlLoop


class Fragile:
    """A bank whose lines can fail, as after a short in the relay board."""

    supplied = True

    def __init__(self, bank: RelayBank) -> None:
        self._bank = bank
        self.broken = False

    def drive(self, axis: Axis, direction: Direction, until_s: float) -> Direction:
        if self.broken:
            raise HardwareError("the lines cannot be set")
        return self._bank.drive(axis, direction, until_s)

    def driven(self) -> dict[Axis, Direction]:
        return self._bank.driven()

    def off(self) -> None:
        self._bank.off()

    def cut(self) -> bool:
        return self._bank.cut()

    def restore(self) -> None:
        self._bank.restore()


PIN = 26
CONFIG = parse(f"[relays]\nheartbeat = {PIN}\n", "test")


def edges(station: Station) -> list[bool]:
    """The levels that the line takes on from now on."""
    assert station.world is not None
    seen: list[bool] = []
    station.world.gpio.on_edges.append(
        lambda _now_s, changes: seen.extend(changes[pin] for pin in changes if pin == PIN)
    )
    return seen


class Rig:
    def __init__(self) -> None:
        self.clock = SimClock()
        config = CONFIG
        self.station = Station(config, self.clock, self.clock.sleep, (100.0, 20.0))
        assert isinstance(self.station.rotor, RelayRotor)
        self.drive = Fragile(self.station.rotor.bank)
        self.rotor = RelayRotor(cast(RelayBank, self.drive), self.station.rotor.sensors)
        self.signs = 0
        self.loop = ControlLoop(build_controller(config), self.rotor, self.clock, 0.05, after_good_step=self.sign)

    def sign(self) -> None:
        self.station.beat()
        self.signs += 1

    def run(self, steps: int) -> None:
        for _ in range(steps):
            self.loop.cycle()
            self.clock.sleep(0.05)


@pytest.fixture
def rig() -> Rig:
    return Rig()


def test_one_after_every_step_moving_or_not(rig: Rig) -> None:
    rig.run(10)
    rig.loop.post(Source("gs232b", 1), Aim(200.0, 20.0))
    rig.run(10)
    assert rig.signs == 20


def test_the_line_changes_with_every_step(rig: Rig) -> None:
    seen = edges(rig.station)
    rig.run(4)
    assert seen == [True, False, True, False]


def test_setting_an_axis_up_beats_too() -> None:
    clock = SimClock()
    station = Station(CONFIG, clock, clock.sleep)
    bench = AxisRig(CONFIG, Axis.AZIMUTH, station, clock)
    seen = edges(station)
    for _ in range(4):
        bench.loop.cycle()
    assert seen == [True, False, True, False]


def test_none_where_a_relay_may_not_have_obeyed(rig: Rig) -> None:
    rig.run(2)
    rig.drive.broken = True
    rig.run(5)
    assert rig.signs == 2
    rig.drive.broken = False
    rig.run(1)
    assert rig.signs == 3


def test_a_silent_sensor_is_no_reason_to_stop_it(rig: Rig) -> None:
    # The axis has stopped for its own fault; the relays obey.
    assert rig.station.world is not None
    rig.station.world.inject("adc-gone")
    rig.run(20)
    assert rig.signs == 20


def test_a_heartbeat_line_that_fails_is_logged_and_stops_nothing(rig: Rig, caplog: pytest.LogCaptureFixture) -> None:
    def fail() -> None:
        raise HardwareError("GPIO: cannot switch heartbeat")

    loop = ControlLoop(build_controller(parse("", "test")), rig.rotor, rig.clock, 0.05, after_good_step=fail)
    for _ in range(3):
        loop.cycle()
    assert [record.getMessage() for record in caplog.records] == ["heartbeat: GPIO: cannot switch heartbeat"]
