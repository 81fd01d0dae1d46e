"""Rotors whose motors go to an angle by themselves, as the control loop sees them: what becomes of its commands.

The drive here writes down what it is told. The real drives have tests of their own.
"""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from hw.ports import AngleSource, Axis, Direction, HardwareError
from rotator.control.axis.calibration_table import Calibration
from rotator.control.commands import HOLD, Acknowledge, Place, Run, Steer
from rotator.control.sky.offsets import Offsets
from rotator.orders import LetGo
from rotator.rotors.boxes import FollowedBox
from rotator.rotors.common import no_switches
from rotator.rotors.positioned import PositionedRotor

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SHIFT = Offsets(10.0, -3.0)


class Journal:
    """A positioned drive with one command that may expire, in words."""

    angle_source = AngleSource.MODELLED

    def __init__(self) -> None:
        self.said: list[str] = []
        self.until_s: float | None = None
        self.broken = False
        self.models: dict[Axis, float] = {}

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        self.said.append(f"{axis.value} {angle_deg:g} at {rate_dps:g} until {until_s:g}")
        self.until_s = until_s

    def hold(self, axis: Axis) -> None:
        self.said.append(f"{axis.value} hold")

    def release(self) -> None:
        self.said.append("release")

    def off(self) -> None:
        self.said.append("off")
        if self.broken:
            raise HardwareError("the board does not answer")

    def due_s(self) -> float | None:
        return self.until_s

    def enforce(self, now_s: float) -> None:
        if self.until_s is not None and now_s >= self.until_s:
            self.said.append(f"expired at {now_s:g}")
            self.until_s = None

    def wait_until_due(self, patience_s: float) -> None:
        raise AssertionError("no thread in simulated time")

    def angle_deg(self, axis: Axis) -> float:
        return self.models[axis]

    def found(self, axis: Axis, angle_deg: float) -> None:
        self.models[axis] = angle_deg


@pytest.fixture
def drive() -> Journal:
    return Journal()


@pytest.fixture
def rotor(drive: Journal) -> PositionedRotor:
    return PositionedRotor(drive, {}, SHIFT, lambda axis: frozenset({Direction.PLUS} if axis is EL else ()))


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


def test_it_has_no_supply_to_switch_and_no_contact(rotor: PositionedRotor, drive: Journal) -> None:
    assert not rotor.cut()
    rotor.restore()
    assert rotor.closed_contacts() == frozenset()
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


class Pot:
    source = AngleSource.MEASURED

    def __init__(self) -> None:
        self.reading: float | None = 0.5

    def read(self) -> float:
        if self.reading is None:
            raise HardwareError("the converter does not answer")
        return self.reading


def test_a_sensor_beside_a_model_corrects_it_and_is_what_is_read(drive: Journal) -> None:
    pot = Pot()
    sensor = FollowedBox(drive, EL, pot, Calibration(((0.0, 0.0), (1.0, 180.0))))  # type: ignore[arg-type]
    assert sensor.source is AngleSource.MEASURED
    assert sensor.read() == 0.5
    assert drive.models == {EL: 90.0}
    pot.reading = None
    with pytest.raises(HardwareError, match="the converter"):
        sensor.read()
    assert drive.models == {EL: 90.0}
