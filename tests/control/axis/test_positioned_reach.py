"""Where a positioned axis may pass, and what ends before it gets there: sectors, limit switches, sparks and pauses."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource, Direction
from rotator.control.axis.readings import Condition, Reading
from rotator.control.commands import HOLD, Steer
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.control.sky.sectors import UNKNOWN
from rotator.exchange.faults import FaultKind, Missing, Notice
from tests.control.axis.test_positioned import LEASE_S, STEP_S, Motor, path

MINUS, OFF, PLUS = Direction
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


@pytest.fixture
def motor() -> Motor:
    """It stands at 100°, and has been read for a while."""
    motor = Motor()
    motor.step(0.5)
    return motor


# --- where it may pass


@BOTH_WAYS
def test_sent_to_a_place_it_passes_from_here_to_there(motor: Motor, way: Direction) -> None:
    swept = motor.axis.sweep(motor.now_s, Steer(100.0 + 40.0 * way, 0.0, motor.now_s + LEASE_S))
    assert swept == (Range(100.0, 140.5) if way > 0 else Range(59.5, 100.0))


@BOTH_WAYS
def test_moving_on_it_goes_as_far_as_its_command_lasts_and_as_it_brakes(way: Direction) -> None:
    """30°/s for 0.25 s is 7.5°; then at 20°/s² 22.5° more."""
    for accel_dps2, on_deg in ((None, 7.5), (20.0, 30.0)):
        motor = Motor(accel_dps2=accel_dps2)
        motor.step(0.5)
        swept = motor.axis.sweep(motor.now_s, Steer(100.0, 30.0 * way, motor.now_s + LEASE_S))
        assert (swept.max_deg - 100.0, 100.0 - swept.min_deg)[::way][0] == pytest.approx(on_deg + 0.5)


@pytest.mark.parametrize("command", [None, HOLD])
def test_held_it_stays_where_it_is(motor: Motor, command: object) -> None:
    assert motor.axis.sweep(motor.now_s, command) == Range(100.0, 100.0)  # type: ignore[arg-type]


def test_it_may_be_anywhere_where_its_angle_is_not_known(motor: Motor) -> None:
    assert motor.axis.sweep(motor.now_s, None) != UNKNOWN
    assert motor.axis.sweep(motor.now_s + 0.4, None) == UNKNOWN, "no reading for so long"
    for reading in range(20):
        motor.axis.see(Reading(motor.now_s + reading * STEP_S, None), motor.now_s + reading * STEP_S)
    assert motor.axis.sweep(motor.now_s, None) == UNKNOWN, "the fault leaves its angle in doubt"
    fresh = Motor(missing=(Missing.CALIBRATION,))
    fresh.step()
    assert fresh.axis.sweep(fresh.now_s, None) == UNKNOWN


def test_its_room_is_what_it_may_be_off() -> None:
    assert (Motor().axis.stopping_room_deg, Motor().axis.position_error_deg) == (1.0, 0.55)


# --- what is held back or shortened


def test_held_back_it_does_not_count_as_driven_and_a_target_stays(motor: Motor) -> None:
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.stuck = True
    motor.step()
    assert motor.axis.driven
    motor.axis.hold_back(motor.now_s, "a sector")
    assert (motor.axis.driven, motor.axis.busy) == (False, True)


def test_held_back_a_jog_ends(motor: Motor) -> None:
    motor.axis.jog(PLUS, None, motor.now_s)
    motor.step()
    motor.axis.hold_back(motor.now_s, "a sector")
    assert not motor.axis.busy


@BOTH_WAYS
def test_shortened_a_jog_goes_to_that_place_and_ends_there(motor: Motor, way: Direction) -> None:
    motor.axis.jog(way, None, motor.now_s)
    motor.step(0.1)
    end_deg = motor.angle_deg + 10.0 * way
    motor.axis.shortened(motor.now_s, Steer(end_deg, 0.0, motor.now_s + LEASE_S))
    assert motor.axis.driven
    sent = motor.step()
    assert sent is not None
    assert (sent.angle_deg, sent.rate_dps) == (end_deg, 0.0)
    assert motor.step(0.1) is None
    assert (motor.angle_deg, motor.axis.busy) == (end_deg, False)


def test_shortened_a_target_is_sent_where_it_may_and_still_aims(motor: Motor) -> None:
    motor.axis.aim(AimGoal(235.0, 1.0))
    motor.axis.shortened(motor.now_s, Steer(150.0, 0.0, motor.now_s + LEASE_S))
    assert motor.axis.status(motor.now_s).drive is PLUS
    assert motor.axis.aiming == AimGoal(235.0, 1.0)


# --- limit switches


@BOTH_WAYS
def test_an_open_limit_switch_stops_it_on_the_way_there_and_not_back(motor: Motor, way: Direction) -> None:
    motor.condition = Condition(ends=frozenset((way,)))
    motor.axis.aim(AimGoal(100.0 - 20.0 * way, 1.0))
    assert motor.step() is not None
    motor.step(0.2)
    motor.axis.aim(AimGoal(100.0, 1.0))
    assert motor.step() is None
    assert motor.axis.fault is not None
    assert motor.axis.fault.kind is FaultKind.LIMIT_SWITCH
    assert not motor.axis.busy


def test_at_its_switch_it_may_be_held_where_it_is(motor: Motor) -> None:
    motor.condition = Condition(ends=frozenset((PLUS,)))
    motor.axis.aim(AimGoal(100.4, 1.0))
    assert motor.step() is not None
    assert motor.axis.fault is None


def test_a_jog_towards_an_open_switch_is_seen_before_it_has_moved(motor: Motor) -> None:
    motor.condition = Condition(ends=frozenset((PLUS,)))
    motor.axis.jog(PLUS, None, motor.now_s)
    assert motor.step() is None
    assert motor.angle_deg == 100.0


# --- what its sensor says


def test_a_measured_angle_that_jumps_is_a_spark_and_a_modelled_one_is_corrected(motor: Motor) -> None:
    motor.angle_deg = 300.0
    motor.step()
    assert motor.axis.angle_deg == 100.0
    servo = Motor(source=AngleSource.MODELLED)
    servo.step(0.5)
    servo.angle_deg = 300.0
    servo.step()
    assert servo.axis.angle_deg == 300.0


def test_what_the_rotor_says_of_itself_is_its_notice(motor: Motor) -> None:
    motor.condition = Condition(notice=Notice("its motor is warm"))
    motor.step()
    assert [str(notice) for notice in motor.axis.status(motor.now_s).notices] == ["its motor is warm"]


# --- moving, and which way


@BOTH_WAYS
def test_it_moves_until_it_is_within_half_a_degree(motor: Motor, way: Direction) -> None:
    motor.stuck = True
    motor.axis.aim(AimGoal(100.0 + 0.6 * way, 1.0))
    motor.step()
    assert (motor.axis.driven, motor.axis.status(motor.now_s).drive) == (True, way)
    motor.axis.aim(AimGoal(100.0 + 0.4 * way, 1.0))
    motor.step()
    assert (motor.axis.driven, motor.axis.status(motor.now_s).drive) == (False, OFF)


@BOTH_WAYS
def test_beside_its_moving_target_it_moves_the_way_the_target_does(motor: Motor, way: Direction) -> None:
    motor.axis.aim(AimGoal(100.0, 1.0, path(1.0 * way)))
    motor.step(0.2)
    assert motor.axis.status(motor.now_s).drive is way
    motor.axis.forget_path()
    motor.step(0.1)
    assert motor.axis.status(motor.now_s).drive is OFF, "its target stands from now on"


@pytest.mark.parametrize(("seconds", "endless"), [(None, True), (2.0, False)])
def test_only_a_jog_without_a_time_is_one_without_end(motor: Motor, seconds: float | None, endless: bool) -> None:
    assert not motor.axis.jog_is_held
    motor.axis.jog(PLUS, seconds, motor.now_s)
    assert motor.axis.jog_is_held is endless
