"""The control loop: when orders act, and what a silent sensor does."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import Direction
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.exchange.orders import Aim, Jog, Leave, Stop
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop
from tests.runtime.loop_rig import AZ, EL, LINK, LOOK_S, PATIENCE_S, PERIOD_S, Hangs, Relays, Rig, records, running


@pytest.fixture
def rig() -> Iterator[Rig]:
    rig = Rig()
    rig.run(LOOK_S)
    yield rig
    rig.station.close()


# --- orders


def test_an_order_acts_before_the_next_cycle(rig: Rig) -> None:
    moment_s = rig.clock()
    rig.loop.post(LINK, Aim(235.0, 20.0))
    rig.loop.act()
    assert rig.world.drives() == (1, 0)
    rig.loop.post(LINK, Stop())
    rig.loop.act()
    assert rig.world.drives() == (0, 0)
    assert rig.clock() == moment_s, "no sensor was read and no time passed"


@pytest.mark.parametrize("order", [Aim(235.0, 20.0), Jog(AZ, Direction.PLUS)], ids=["aim", "jog"])
def test_an_order_before_the_first_look_waits_for_it_and_then_acts(order: Aim | Jog) -> None:
    rig = Rig()
    closed: list[tuple[int, int]] = []
    rig.world.gpio.on_edges.append(lambda _now_s, _changes: closed.append(rig.world.drives()))
    rig.loop.post(LINK, order)
    rig.run(2 * PERIOD_S)
    assert closed == [], "nothing has been seen of the antenna yet"
    rig.run(LOOK_S)
    assert rig.world.drives() == (1, 0)
    rig.station.close()


def test_an_order_taken_back_before_the_first_look_ends_moves_nothing() -> None:
    rig = Rig()
    rig.loop.post(LINK, Aim(235.0, 20.0))
    rig.run(2 * PERIOD_S)
    rig.loop.post(LINK, Stop())
    rig.run(2 * LOOK_S)
    assert rig.world.antenna() == (100.0, 20.0)
    rig.station.close()


def test_the_running_loop_wakes_for_an_order(rig: Rig) -> None:
    # Its period is an hour: after the first readings nothing but an order can wake it.
    relays = Relays(rig.world)
    loop = rig.loop_with(rig.station.rotor.sensors, period_s=3600.0)
    rig.run(LOOK_S, loop)
    with running(loop):
        loop.post(LINK, Aim(235.0, 20.0))
        assert relays.come_to(1, 0)
        loop.post(LINK, Stop())
        assert relays.come_to(0, 0)


def test_an_order_does_not_wait_for_a_sensor(rig: Rig) -> None:
    relays = Relays(rig.world)
    slow = Hangs(rig.station.rotor.sensors[EL], times=round(LOOK_S / PERIOD_S) + 3)
    loop = rig.loop_with({AZ: rig.station.rotor.sensors[AZ], EL: slow}, period_s=0.01)
    rig.run(LOOK_S, loop)
    with running(loop):
        loop.post(LINK, Aim(235.0, 20.0))
        assert relays.come_to(1, 0)
        assert slow.stuck.wait(PATIENCE_S)
        loop.post(LINK, Stop())
        assert relays.come_to(0, 0)
        slow.let_go.set()


# --- sensors


def test_a_converter_that_goes_stops_the_axes_is_said_once_and_comes_back(
    rig: Rig, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO, "rotator")
    rig.loop.post(LINK, Aim(300.0, 90.0))
    rig.run(2.0)
    assert rig.world.drives() == (1, 1)
    rig.world.inject("adc-gone")
    rig.run(0.2)
    assert rig.world.drives() == (0, 0), "a silence of three readings stops the motors"
    rig.run(5.0)
    for axis in ("azimuth", "elevation"):
        assert len(records(caplog, f"{axis}: I2C simulated bus: the device does not answer")) == 1
        assert len(records(caplog, f"FAULT {axis}: sensor silent")) == 1
    assert {fault.axis for fault in rig.loop.status.faults} == {AZ, EL}

    rig.world.clear("adc-gone")
    rig.run(2.0)
    assert len(records(caplog, "answers again")) == 2
    assert rig.world.drives() == (0, 0), "the fault is not acknowledged"
    rig.loop.post(LINK, Stop())
    rig.loop.post(LINK, Aim(300.0, 90.0))
    rig.run(1.0)
    assert rig.world.drives() == (1, 1)


def test_a_bus_that_hangs_stops_the_motors() -> None:
    # In real time, and without a guard: the loop itself notices that no readings come.
    station = Station(Config(), time.monotonic, time.sleep, (100.0, 20.0))
    assert isinstance(station.world, SimRelayPotRotor)
    relays = Relays(station.world)
    loop = ControlLoop(build_controller(Config()), station.rotor, time.monotonic, PERIOD_S)
    with running(loop):
        loop.post(LINK, Aim(235.0, 90.0))
        assert relays.come_to(1, 1)
        station.world.inject("bus-hung")
        assert relays.come_to(0, 0)
        station.world.clear("bus-hung")
    station.close()


def test_an_order_that_can_wait_makes_room_for_the_next_of_its_kind(rig: Rig) -> None:
    for azimuth_deg in range(1000):
        rig.loop.post(LINK, Aim(float(azimuth_deg % 90), 20.0), can_wait=True)
        rig.loop.post(Source("other", 1), Jog(EL, Direction.PLUS), can_wait=True)
    rig.loop.post(LINK, Aim(300.0, None), can_wait=True)
    rig.loop.act()
    assert rig.loop.status.wanted_azimuth_deg == 300.0
    assert rig.world.drives() == (1, 1), "the newest of the one, and the other's jog before it"


def test_a_program_that_connects_for_each_order_has_one_line_in_the_log_and_one_when_it_is_silenced(
    rig: Rig, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    for second in range(90):
        sender = Source("rotctld", second + 1)
        if second == 45:
            rig.loop.post(LINK, Stop())
        rig.loop.post(sender, Aim(300.0 + 0.1 * second, 20.0))
        rig.loop.act()
        rig.loop.post(sender, Leave())
        rig.run(1.0)
    assert [record.message for record in caplog.records if "rotctld" in record.message] == [
        "rotctld#1 moves the antenna",
        "orders from rotctld#46 are ignored: gs232b#1 has stopped the antenna; "
        "orders count again after a pause of 10 s",
    ]


def test_the_sender_that_moves_it_is_logged_once(rig: Rig, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)
    for second in range(20):
        rig.loop.post(LINK if second % 2 else Source("rotctld", 2), Aim(300.0, 20.0))
        rig.run(1.0)
    said = [record.message for record in caplog.records if "moves the antenna" in record.message]
    assert said == ["rotctld#2 moves the antenna", "gs232b#1 moves the antenna"]
