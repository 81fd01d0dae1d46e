"""The control loop: a drive that fails, and that the relays are off after every end of the loop."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any, cast

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, AngleSource, Axis, Direction, HardwareError
from rotator.assembly.settings import build_controller
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.control.commands import Run
from rotator.exchange.orders import Aim, Jog, Stop
from rotator.rotors.relays import RelayRotor
from rotator.runtime.loop import ControlLoop
from tests.runtime.loop_rig import AZ, EL, LINK, LOOK_S, PERIOD_S, Rig, records
from tests.tables import every_row


@pytest.fixture
def rig() -> Iterator[Rig]:
    rig = Rig()
    rig.run(LOOK_S)
    yield rig
    rig.station.close()


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


@pytest.mark.long
@every_row("fails", list(itertools.product((False, True), repeat=5)))
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
        self.leave = bank.leave

    @property
    def released(self) -> bool:
        return self._bank.released

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


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_a_brake_that_a_dead_guard_has_left_off_is_told_so_that_the_sentinel_engages_it() -> None:
    braked = Config.model_validate({"azimuth": {"brake": {"line": 26}}})
    station = Station(braked, time.monotonic, time.sleep, (100.0, 20.0))
    assert isinstance(station.rotor, RelayRotor)
    rotor = RelayRotor(cast(RelayBank, Unguarded(station.rotor.bank)), station.rotor.sensors)
    rotor.start()
    rotor.obey(Axis.AZIMUTH, Run(Direction.PLUS, time.monotonic() + 0.2))
    assert station.rotor.bank.released
    with pytest.raises(HardwareError, match="the sentinel does it"):
        rotor.close()
    station.close()
