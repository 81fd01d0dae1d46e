"""An axis whose motor goes to an angle by itself: its commands, where it stops, and when it is not believed."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.positioned import PositionedAxis
from rotator.control.axis.readings import Condition, Reading, Window
from rotator.control.axis.sensing import RIDDEN_S
from rotator.control.axis.settings import PositionedSettings
from rotator.control.axis.stray_watch import STRAY_S
from rotator.control.commands import HOLD, Steer
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import OFFSETS_S, Path
from rotator.exchange.faults import FaultKind, Missing

LEASE_S = 0.25
STEP_S = 0.02


class Motor:
    """A drive that carries out each command at once, or is stuck; its sensor reads degrees."""

    def __init__(
        self,
        missing: tuple[Missing, ...] = (),
        source: AngleSource = AngleSource.MEASURED,
        accel_dps2: float | None = None,
        *,
        master: bool = False,
    ) -> None:
        self.axis = PositionedAxis(
            PositionedSettings(
                axis=Axis.AZIMUTH,
                limits=Range(0.0, 450.0),
                tolerance_deg=1.0,
                speed_dps=30.0,
                window=Window(-10.0, 460.0),
                calibration=Calibration(((0.0, 0.0), (450.0, 450.0))),
                missing=missing,
                source=source,
                accel_dps2=accel_dps2,
                master=master,
            ),
            lease_s=LEASE_S,
        )
        self.now_s = 0.0
        self.angle_deg = 100.0
        self.stuck = False
        self.condition = Condition()

    def step(self, seconds: float = STEP_S) -> Steer | None:
        """The last command of that while; None: hold."""
        command: object = HOLD
        for _ in range(max(1, round(seconds / STEP_S))):
            self.axis.see(Reading(self.now_s, self.angle_deg, condition=self.condition), self.now_s)
            command = self.axis.decide(self.now_s).command
            if isinstance(command, Steer) and not self.stuck:
                self.angle_deg = command.angle_deg
            self.now_s += STEP_S
        return command if isinstance(command, Steer) else None


@pytest.fixture
def motor() -> Motor:
    return Motor()


def path(rate_dps: float, first_deg: float = 100.0) -> Path:
    return Path(0.0, [first_deg + rate_dps * offset_s for offset_s in OFFSETS_S], [1.0] * len(OFFSETS_S))


# --- aiming


def test_a_standing_target_is_sent_as_it_is_and_for_a_lease(motor: Motor) -> None:
    motor.axis.aim(AimGoal(235.0, 1.0))
    assert motor.step() == Steer(235.0, 0.0, LEASE_S)


def test_before_anything_is_known_of_its_place_it_holds() -> None:
    motor = Motor()
    motor.axis.aim(AimGoal(235.0, 1.0))
    assert motor.axis.decide(0.0).command is HOLD


def test_an_axis_that_was_never_set_up_is_not_aimed() -> None:
    motor = Motor(missing=(Missing.HOMING,))
    motor.axis.aim(AimGoal(235.0, 1.0))
    assert motor.step() is None
    assert motor.axis.status(motor.now_s).missing == (Missing.HOMING,)


# --- jogging


@pytest.mark.parametrize("way", [-1, 1], ids=["minus", "plus"])
def test_a_jog_against_a_move_begins_where_the_axis_is(motor: Motor, way: int) -> None:
    """And not at the far target of the move, which it would first go on towards."""
    motor.stuck, motor.angle_deg = True, 225.0
    motor.axis.aim(AimGoal(225.0 - 150.0 * way, 1.0))
    motor.step(0.5)
    motor.axis.jog(Direction(way), None, motor.now_s)
    steered = motor.step()
    assert steered is not None
    assert steered.rate_dps == 30.0 * way
    assert steered.angle_deg == 225.0


def test_a_jog_for_a_while_ends_by_itself(motor: Motor) -> None:
    motor.axis.jog(Direction.PLUS, 0.5, 0.0)
    assert motor.step(1.0) is None
    assert motor.angle_deg == pytest.approx(115.0, abs=1.0)


def test_a_coast_and_an_angle_that_was_told_are_no_turning_by_itself(motor: Motor) -> None:
    def seen_dps(rate_dps: float, seconds: float) -> set[int]:
        seen = set()
        for _ in range(round(seconds / STEP_S)):
            motor.angle_deg += rate_dps * STEP_S
            motor.step()
            motor.axis.note_driven(motor.now_s, Direction.OFF)
            seen.add(round(motor.axis.status(motor.now_s).by_itself_dps))
        return seen

    motor.axis.jog(Direction.PLUS, 0.5, 0.0)
    assert seen_dps(0.0, 0.5) == {0}
    assert seen_dps(2.0, 0.96) == {0}, "it slows down"
    assert seen_dps(0.0, 1.5) == {0}
    motor.angle_deg, motor.condition = 200.0, Condition(scale=1)
    assert seen_dps(0.0, 1.5) == {0}, "another angle for the same place"
    assert 2 in seen_dps(2.0, 2.0)


def test_not_set_up_a_press_lasts_two_seconds() -> None:
    motor = Motor(missing=(Missing.HOMING,))
    motor.axis.jog(Direction.PLUS, None, 0.0)
    assert motor.step(1.9) is not None
    assert motor.step(0.2) is None


# --- faults


def test_an_axis_that_does_not_follow_is_stopped_and_named(motor: Motor) -> None:
    motor.stuck = True
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.step(STRAY_S + 0.1)
    assert motor.axis.fault is not None
    assert str(motor.axis.fault).startswith("azimuth: axis does not follow: ")
    assert all(place in motor.axis.fault.measured for place in (" 100.0°", " 135.0°"))
    assert motor.step() is None


def test_a_silent_sensor_holds_it_and_is_a_fault(motor: Motor) -> None:
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.step()
    good_s = motor.now_s - STEP_S
    for _ in range(10):
        motor.axis.see(Reading(motor.now_s, None, "no answer from controller 1"), motor.now_s)
        command = motor.axis.decide(motor.now_s).command
        assert command is HOLD or (isinstance(command, Steer) and command.until_s <= good_s + RIDDEN_S)
        motor.now_s += STEP_S
    assert command is HOLD
    assert motor.axis.fault is not None
    assert "no answer from controller 1" in str(motor.axis.fault)


def silent(motor: Motor) -> object:
    """One reading is missing. Returns the command."""
    motor.axis.see(Reading(motor.now_s, None, "no answer"), motor.now_s)
    motor.now_s += STEP_S
    return motor.axis.decide(motor.now_s - STEP_S).command


@pytest.mark.parametrize("each", [16, 30])
def test_missing_readings_do_not_hide_that_it_does_not_follow(motor: Motor, each: int) -> None:
    motor.stuck = True
    motor.axis.aim(AimGoal(235.0, 1.0))
    began_s = motor.now_s
    while motor.axis.fault is None and motor.now_s < began_s + 2.0 * STRAY_S:
        motor.step(STEP_S * (each - 1))
        silent(motor)
    assert motor.axis.fault is not None
    assert motor.axis.fault.kind is FaultKind.NOT_FOLLOWING
    assert motor.now_s - began_s < STRAY_S + 2 * STEP_S * each


@pytest.mark.parametrize("master", [False, True])
def test_where_it_does_not_follow_it_may_not_hear_a_stop_either_and_loses_its_supply(master: bool) -> None:
    motor = Motor(master=master)
    motor.stuck = True
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.step(2.0 * STRAY_S)
    assert motor.axis.fault is not None
    assert motor.axis.fault.cut is master
    assert ("has switched the motors' supply off" in str(motor.axis.fault)) is master


def test_a_missing_reading_is_ridden_out_and_starts_nothing(motor: Motor) -> None:
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.stuck = True
    motor.step()
    assert isinstance(silent(motor), Steer)
    motor.axis.halt()
    assert silent(motor) is HOLD
    motor.axis.aim(AimGoal(235.0, 1.0))
    assert silent(motor) is HOLD


def test_orders_that_a_controller_does_not_answer_are_bad_readings(motor: Motor) -> None:
    for count in range(100):
        motor.axis.see(Reading(motor.now_s, 100.0, condition=Condition(missed=count // 10)), motor.now_s)
        motor.now_s += STEP_S
    assert motor.axis.fault is not None
    assert motor.axis.fault.kind is FaultKind.BAD_READINGS


def test_a_controller_that_is_silent_for_good_is_not_called_a_bad_sensor(motor: Motor) -> None:
    for count in range(100):
        motor.axis.see(Reading(motor.now_s, 100.0, condition=Condition(missed=count)), motor.now_s)
        motor.now_s += STEP_S
    assert motor.axis.fault is None, "its silence is a fault of its own"
