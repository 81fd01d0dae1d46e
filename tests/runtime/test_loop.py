"""The control loop over the real drivers on a simulated station, in simulated time.

When orders act, what a silent sensor does, and that the relays are off after every end of the loop.
"""

from __future__ import annotations

import itertools
import logging
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, cast

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, AngleSource, Axis, Direction, HardwareError
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.exchange.orders import Aim, Jog, Stop
from rotator.exchange.sources import Source
from rotator.rotors.relays import RelayRotor
from rotator.runtime.loop import ControlLoop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PERIOD_S = 0.05
LINK = Source("gs232b", 1)
PATIENCE_S = 20.0
LOOK_S = 3.0
"""A loop that has run so long has seen both axes stand: before that it closes no relay."""


class Rig:
    """A station with its guard as an alarm of the clock, and a control loop that is cycled by hand."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.config = Config()
        self.station = Station(self.config, self.clock, self.clock.sleep, (100.0, 20.0), add_alarm=self.clock.add_alarm)
        assert isinstance(self.station.world, SimRelayPotRotor)
        self.world = self.station.world
        self.loop = self.loop_with(self.station.rotor.sensors)

    def loop_with(self, sensors: Mapping[Axis, AngleSensor], period_s: float = PERIOD_S) -> ControlLoop:
        assert isinstance(self.station.rotor, RelayRotor)
        rotor = RelayRotor(self.station.rotor.bank, sensors)
        return ControlLoop(build_controller(self.config), rotor, self.clock, period_s)

    def run(self, seconds: float, loop: ControlLoop | None = None) -> None:
        end_s = self.clock() + seconds
        while self.clock() < end_s:
            cycle_s = self.clock()
            (loop or self.loop).cycle()
            self.clock.sleep_until(cycle_s + PERIOD_S)


class Hangs:
    """A sensor that goes well a few times and is then stuck in its reading until let go."""

    source = AngleSource.MEASURED

    def __init__(self, sensor: AngleSensor, times: int) -> None:
        self._sensor = sensor
        self._times = times
        self.stuck, self.let_go = threading.Event(), threading.Event()

    def read(self) -> float:
        self._times -= 1
        if self._times < 0:
            self.stuck.set()
            assert self.let_go.wait(PATIENCE_S)
        return self._sensor.read()


class Relays:
    """The motor relays of a simulated station, watched from another thread."""

    def __init__(self, world: SimRelayPotRotor) -> None:
        self._changed = threading.Condition()
        self._drives = (0, 0)
        self._world = world
        world.gpio.on_edges.append(self._see)

    def _see(self, _now_s: float, _changes: Mapping[int, bool]) -> None:
        with self._changed:
            self._drives = self._world.drives()
            self._changed.notify_all()

    def come_to(self, *drives: int) -> bool:
        with self._changed:
            return self._changed.wait_for(lambda: self._drives == drives, PATIENCE_S)


@contextmanager
def running(loop: ControlLoop) -> Iterator[None]:
    thread = threading.Thread(target=loop.run)
    thread.start()
    try:
        yield
    finally:
        loop.stop()
        thread.join(PATIENCE_S)
        assert not thread.is_alive()


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


def records(caplog: pytest.LogCaptureFixture, words: str) -> list[str]:
    return [record.message for record in caplog.records if words in record.message]


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


# --- the drive


class LinesGone:
    """A drive whose lines the kernel has taken away: no order can close a relay."""

    supplied = True

    def drive(self, axis: Axis, direction: Direction, until_s: float) -> Direction:
        if direction is not Direction.OFF:
            raise HardwareError("GPIO: cannot switch azimuth_cw: No such device")
        return Direction.OFF

    def driven(self) -> dict[Axis, Direction]:
        return dict.fromkeys(Axis, Direction.OFF)

    def off(self) -> None:
        pass


def test_a_drive_that_fails_is_said_once(rig: Rig, caplog: pytest.LogCaptureFixture) -> None:
    rig.loop = ControlLoop(
        build_controller(rig.config),
        RelayRotor(cast(RelayBank, LinesGone()), rig.station.rotor.sensors),
        rig.clock,
        PERIOD_S,
    )
    rig.run(LOOK_S)
    rig.loop.post(LINK, Aim(300.0, 20.0))
    rig.run(2.0)
    assert len(records(caplog, "No such device")) == 1
    assert not records(caplog, "answers again")


class FailingLines:
    """Relay lines of which some calls fail: `fails` says of each call, one after the other, whether it does."""

    def __init__(self, fails: Iterable[bool]) -> None:
        self._fails = iter(fails)

    def set(self, levels: dict[str, bool]) -> None:
        if next(self._fails, False):
            raise HardwareError(f"GPIO: cannot switch {', '.join(levels)}: No such device")

    def close(self) -> None:
        pass


@pytest.mark.parametrize("fails", list(itertools.product((False, True), repeat=5)), ids=str)
def test_with_any_line_failing_the_status_says_what_the_relays_may_do(fails: tuple[bool, ...]) -> None:
    """A relay that could not be opened is still driven: watches that heard of an opening would judge it by that."""
    rig = Rig()
    bank = RelayBank(FailingLines(fails), rig.clock, dead_time_s=0.5)
    loop = ControlLoop(build_controller(rig.config), RelayRotor(bank, rig.station.rotor.sensors), rig.clock, PERIOD_S)
    rig.run(LOOK_S, loop)
    orders = (Jog(AZ, Direction.PLUS), Stop(), Jog(EL, Direction.MINUS), Jog(AZ, Direction.MINUS), Stop())
    for order in orders:
        loop.post(LINK, order)
        for _ in range(2):
            rig.run(PERIOD_S, loop)
            assert {axis: loop.status.axis(axis).drive for axis in Axis} == bank.driven(), order
    rig.station.close()


def test_an_order_that_can_wait_makes_room_for_the_next_of_its_kind(rig: Rig) -> None:
    for azimuth_deg in range(1000):
        rig.loop.post(LINK, Aim(float(azimuth_deg % 90), 20.0), can_wait=True)
        rig.loop.post(Source("other", 1), Jog(EL, Direction.PLUS), can_wait=True)
    rig.loop.post(LINK, Aim(300.0, None), can_wait=True)
    rig.loop.act()
    assert rig.loop.status.wanted_azimuth_deg == 300.0
    assert rig.world.drives() == (1, 1), "the newest of the one, and the other's jog before it"


def test_it_waits_for_the_cycle_and_no_longer(rig: Rig) -> None:
    relays = Relays(rig.world)
    loop = ControlLoop(build_controller(rig.config), rig.station.rotor, time.monotonic, PERIOD_S)
    with running(loop):
        loop.post(LINK, Jog(AZ, Direction.PLUS), can_wait=True)
        assert relays.come_to(1, 0)


def test_the_sender_that_moves_it_is_logged_once(rig: Rig, caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)
    for second in range(20):
        rig.loop.post(LINK if second % 2 else Source("rotctld", 2), Aim(300.0, 20.0))
        rig.run(1.0)
    said = [record.message for record in caplog.records if "moves the antenna" in record.message]
    assert said == ["rotctld#2 moves the antenna", "gs232b#1 moves the antenna"]


# --- the end


class Bug:
    """A sensor that goes well until the motors run and then raises, or returns, what no sensor should."""

    source = AngleSource.MEASURED

    def __init__(self, sensor: AngleSensor, world: SimRelayPotRotor, outcome: Any) -> None:
        self._sensor = sensor
        self._world = world
        self._outcome = outcome

    def read(self) -> Any:
        if self._world.drives() != (0, 0) and isinstance(self._outcome, Exception):
            raise self._outcome
        return self._sensor.read() if self._world.drives() == (0, 0) else self._outcome


@pytest.mark.parametrize(("outcome", "error"), [(ZeroDivisionError(), ZeroDivisionError), ("half", TypeError)])
def test_a_bug_ends_the_loop_with_every_relay_off(rig: Rig, outcome: object, error: type[Exception]) -> None:
    loop = rig.loop_with(
        {AZ: rig.station.rotor.sensors[AZ], EL: Bug(rig.station.rotor.sensors[EL], rig.world, outcome)}
    )
    rig.run(LOOK_S, loop)
    loop.post(LINK, Aim(300.0, 90.0))
    with pytest.raises(error):
        loop.run()
    assert rig.world.relay_starts >= 1, "motors were running"
    assert rig.world.drives() == (0, 0)


def test_so_does_a_bug_in_another_thread_that_a_person_relies_on(rig: Rig) -> None:
    """The panel's: its stop button would be dead."""
    sensors = rig.station.rotor.sensors
    loop = rig.loop_with(
        {AZ: sensors[AZ], EL: WhenTheyRun(sensors[EL], rig.world, lambda: loop.fail(KeyError("a bug")))}
    )
    rig.run(LOOK_S, loop)
    loop.post(LINK, Aim(300.0, 90.0))
    with pytest.raises(KeyError, match="a bug"):
        loop.run()
    assert rig.world.relay_starts >= 1, "motors were running"
    assert rig.world.drives() == (0, 0)


class WhenTheyRun:
    """A sensor that goes well; something else happens as soon as the motors run."""

    source = AngleSource.MEASURED

    def __init__(self, sensor: AngleSensor, world: SimRelayPotRotor, happens: Callable[[], None]) -> None:
        self._sensor = sensor
        self._world = world
        self._happens = happens

    def read(self) -> float:
        if self._world.drives() != (0, 0):
            self._happens()
        return self._sensor.read()


class Unguarded:
    """A bank whose guard dies when it is to sleep while a relay is closed."""

    supplied = True

    def __init__(self, bank: RelayBank) -> None:
        self._bank = bank
        self.drive, self.off, self.due_s, self.enforce = bank.drive, bank.off, bank.due_s, bank.enforce

    def wait_until_due(self, patience_s: float) -> None:
        self._bank.wait_until_due(patience_s)
        if self._bank.due_s() is not None:
            raise SystemExit


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_guard_that_dies_ends_the_loop_with_every_relay_off() -> None:
    station = Station(Config(), time.monotonic, time.sleep, (100.0, 20.0))
    assert isinstance(station.world, SimRelayPotRotor)
    assert isinstance(station.rotor, RelayRotor)
    rotor = RelayRotor(cast(RelayBank, Unguarded(station.rotor.bank)), station.rotor.sensors)
    loop = ControlLoop(build_controller(Config()), rotor, time.monotonic, PERIOD_S)
    loop.post(LINK, Aim(235.0, 20.0))
    rotor.start()
    with pytest.raises(HardwareError, match="the guard, which ends expired commands, has died"):
        loop.run()
    assert station.world.relay_starts >= 1, "a motor was running"
    assert station.world.drives() == (0, 0)
    rotor.close()
    station.close()
