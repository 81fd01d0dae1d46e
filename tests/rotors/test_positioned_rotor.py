"""Rotors whose motors go to an angle by themselves, as the control loop sees them: what becomes of its commands.

The drive here writes down each command. The real drives have tests of their own.
"""

from __future__ import annotations

import threading

import pytest

from firmware_sim.clock import SimClock
from hw.ports import AngleSensor, Axis, Direction, HardwareError
from hw.safety.guard import GUARD_THREAD
from rotator.control.commands import HOLD, Acknowledge, Place, Run, Steer
from rotator.control.sky.offsets import Offsets
from rotator.exchange.orders import LetGo
from rotator.rotors.common import no_switches
from rotator.rotors.positioned import PositionedRotor
from tests.rotors.journal import Journal

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SHIFT = Offsets(10.0, -3.0)
PATIENCE_S = 20.0
SENSORS: dict[Axis, AngleSensor] = {}


@pytest.fixture
def drive() -> Journal:
    return Journal()


@pytest.fixture
def rotor(drive: Journal) -> PositionedRotor:
    return PositionedRotor(drive, SENSORS, SHIFT, lambda axis: frozenset({Direction.PLUS} if axis is EL else ()))


def test_the_drive_has_the_rotor_s_own_scale(rotor: PositionedRotor, drive: Journal) -> None:
    assert rotor.obey(AZ, Steer(100.0, 1.5, 7.25)) is Direction.OFF
    assert rotor.obey(EL, Steer(30.0, -0.5, 7.5)) is Direction.OFF
    assert drive.said == ["azimuth 90 at 1.5 until 7.25", "elevation 33 at -0.5 until 7.5"]


@pytest.mark.parametrize("command", [HOLD, Run(Direction.PLUS, 9.0)], ids=["hold", "a command for relays"])
def test_all_else_is_hold(rotor: PositionedRotor, drive: Journal, command: Run) -> None:
    assert rotor.obey(EL, command) is Direction.OFF
    assert drive.said == ["elevation hold"]


def test_of_the_errands_it_knows_one(rotor: PositionedRotor, drive: Journal) -> None:
    rotor.run(Acknowledge(AZ))
    rotor.run(Place(AZ, 5.0))
    assert drive.said == []
    rotor.run(LetGo())
    assert drive.said == ["release"]


def test_a_command_that_nobody_renews_expires_by_the_simulated_clock(rotor: PositionedRotor, drive: Journal) -> None:
    clock = SimClock(5.0)
    rotor.begin(clock.add_alarm)
    rotor.obey(AZ, Steer(100.0, 0.0, 5.25))
    clock.sleep(0.24)
    assert "expired" not in drive.said[-1]
    clock.sleep(0.02)
    assert drive.said[-1] == "expired at 5.25"


def test_what_limit_switches_forbid_is_told_of_the_right_axis(rotor: PositionedRotor) -> None:
    assert rotor.condition(EL).ends == {Direction.PLUS}
    assert rotor.condition(AZ).ends == frozenset()
    assert no_switches(EL) == frozenset()


def test_its_sensors_are_those_that_it_was_given(rotor: PositionedRotor) -> None:
    assert rotor.sensors is SENSORS


def test_it_has_no_supply_to_switch_and_no_contact(rotor: PositionedRotor, drive: Journal) -> None:
    assert not rotor.cut()
    rotor.restore()
    assert rotor.closed_contacts() == frozenset()
    assert not rotor.coasts()
    assert [rotor.driven(axis) for axis in Axis] == [Direction.OFF] * 2
    assert drive.said == []


def test_off_and_close_are_the_safe_state(rotor: PositionedRotor, drive: Journal) -> None:
    rotor.off()
    rotor.check()
    rotor.close()
    assert drive.said == ["off", "off"]


def test_a_safe_state_that_fails_is_an_error(rotor: PositionedRotor, drive: Journal) -> None:
    drive.broken = True
    with pytest.raises(HardwareError, match="does not answer"):
        rotor.off()
    with pytest.raises(HardwareError, match="does not answer"):
        rotor.close()


class Dying(Journal):
    """A drive whose guard cannot live."""

    def wait_until_due(self, patience_s: float) -> None:
        raise SystemExit


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_started_in_real_time_it_says_when_its_guard_has_died() -> None:
    rotor = PositionedRotor(Dying(), SENSORS, SHIFT)
    rotor.check()
    rotor.start()
    for thread in threading.enumerate():
        if thread.name == GUARD_THREAD:
            thread.join(PATIENCE_S)
    with pytest.raises(HardwareError, match="the guard, which ends expired commands, has died"):
        rotor.check()
    rotor.close()
    rotor.check()
