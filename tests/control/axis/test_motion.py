"""The model of a switched motor: where the axis is, where it would come to rest, and what a run teaches.

The motor turned here is a first-order lag, written down on its own: after t seconds on, from rest, it has gone
v (t - T (1 - e^(-t/T))) and turns at v (1 - e^(-t/T)); switched off it coasts on by its speed times T.
"""

from __future__ import annotations

import math

import pytest

from hw.ports import Direction
from rotator.control.axis.motion import JUMP_READINGS, LANDING_READINGS, RESTS_AFTER_S, Motion
from rotator.exchange.motor import Motor

MINUS, OFF, PLUS = Direction
STEP_S = 0.05
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


class Axis:
    """A real motor of `speed_dps` that lags by `lag_s`, and the model of it, which may believe something else."""

    def __init__(self, speed_dps: float, lag_s: float, believed: Motor, at_deg: float = 100.0) -> None:
        self.speed_dps, self.lag_s = speed_dps, lag_s
        self.angle_deg, self.turning_dps, self.now_s = at_deg, 0.0, 50.0
        self.way = OFF
        self.model = Motion({PLUS: believed, MINUS: believed})
        self.model.see(self.now_s, at_deg)

    def drive(self, way: Direction, wanted_deg: float = 0.0) -> None:
        self.way = way
        self.model.note_drive(self.now_s, way, wanted_deg)

    def turn(self, seconds: float, *, seen: bool = True) -> None:
        for _ in range(round(seconds / STEP_S)):
            to_dps = self.way * self.speed_dps
            fade = math.exp(-STEP_S / self.lag_s)
            self.angle_deg += to_dps * STEP_S + (self.turning_dps - to_dps) * self.lag_s * (1 - fade)
            self.turning_dps = to_dps + (self.turning_dps - to_dps) * fade
            self.now_s += STEP_S
            if seen:
                self.model.see(self.now_s, self.angle_deg)

    def run(self, way: Direction, seconds: float) -> None:
        """From rest to rest, to the very place that the model says."""
        self.drive(way)
        self.turn(seconds)
        self.drive(OFF, self.model.rest_deg(self.now_s))
        self.turn(RESTS_AFTER_S + (LANDING_READINGS + 2) * STEP_S)


def motor(speed_dps: float = 6.0, lag_s: float = 0.2) -> Motor:
    return Motor(speed_dps, speed_dps * lag_s)


def test_before_the_first_reading_there_is_no_angle() -> None:
    model = Motion({PLUS: motor(), MINUS: motor()})
    assert model.angle_deg is None
    assert model.rest_deg(3.0) == 0.0
    model.note_drive(1.0, PLUS, 0.0)
    assert model.resting, "what the relays do before is not known to have moved it"
    model.see(2.0, 77.0)
    assert model.angle_deg == 77.0
    assert model.rest_deg(9.0) == 77.0


@BOTH_WAYS
def test_without_readings_the_model_turns_as_the_motor_does(way: Direction) -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.drive(way)
    axis.turn(0.1, seen=False)
    rests_deg = axis.angle_deg + axis.turning_dps * 0.2
    assert axis.model.rest_deg(axis.now_s) == pytest.approx(rests_deg, abs=0.05)
    axis.turn(1.0, seen=False)
    axis.model.see(axis.now_s, axis.angle_deg)
    assert axis.model.angle_deg == pytest.approx(axis.angle_deg, abs=1e-6)


@BOTH_WAYS
def test_it_knows_where_a_running_motor_would_come_to_rest(way: Direction) -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.drive(way)
    axis.turn(2.0)
    assert axis.model.rest_deg(axis.now_s) == pytest.approx(axis.angle_deg + way * 6.0 * 0.2, abs=0.02)
    ahead_deg = axis.model.rest_deg(axis.now_s + 0.5) - axis.model.rest_deg(axis.now_s)
    assert ahead_deg == pytest.approx(way * 3.0, abs=0.01), "half a second more is 3° more"


@BOTH_WAYS
def test_it_rests_once_it_has_landed(way: Direction) -> None:
    axis = Axis(6.0, 0.2, motor())
    assert axis.model.resting
    axis.drive(way)
    assert not axis.model.resting
    axis.turn(2.0)
    axis.drive(OFF)
    axis.turn(RESTS_AFTER_S + (LANDING_READINGS - 2) * STEP_S)
    assert not axis.model.resting, "it may still coast"
    axis.turn(3 * STEP_S)
    assert axis.model.resting
    assert axis.model.angle_deg == pytest.approx(axis.angle_deg, abs=0.01)


@BOTH_WAYS
@pytest.mark.parametrize("real_dps", [4.5, 6.5])
def test_from_run_to_run_it_learns_the_speed_of_that_direction_alone(way: Direction, real_dps: float) -> None:
    axis = Axis(real_dps, 0.2, motor())
    axis.run(way, 3.0)
    once_dps = axis.model.motors[way].speed_dps
    assert once_dps == pytest.approx(6.0 + 0.35 * (real_dps - 6.0), abs=0.25), "a third of the way in one run"
    for _ in range(9):
        axis.run(way, 3.0)
    assert axis.model.motors[way].speed_dps == pytest.approx(real_dps, rel=0.02)
    assert axis.model.motors[Direction(-way)] == motor()


@BOTH_WAYS
@pytest.mark.parametrize("real_dps", [7.5, 9.0])
def test_a_motor_much_faster_than_known_shows_it_within_its_first_run(way: Direction, real_dps: float) -> None:
    axis = Axis(real_dps, 0.2, motor())
    axis.drive(way)
    axis.turn(3.5)
    assert axis.model.motors[way].speed_dps == pytest.approx(real_dps, rel=0.05)
    assert axis.model.angle_at(axis.now_s) == pytest.approx(axis.angle_deg, abs=0.15)


@BOTH_WAYS
@pytest.mark.parametrize("real_lag_s", [0.05, 0.35])
def test_from_run_to_run_it_learns_the_coast(way: Direction, real_lag_s: float) -> None:
    axis = Axis(6.0, real_lag_s, motor())
    for _ in range(12):
        axis.run(way, 3.0)
    assert axis.model.motors[way].coast_deg == pytest.approx(6.0 * real_lag_s, abs=0.15)
    assert axis.model.motors[Direction(-way)] == motor()


def test_a_short_tap_teaches_neither_speed_nor_coast() -> None:
    axis = Axis(9.0, 0.2, motor())
    axis.run(PLUS, 0.1)
    assert axis.angle_deg - 100.0 < 1.0
    assert axis.model.motors[PLUS] == motor()


def test_a_run_of_a_degree_and_a_half_teaches_the_speed_a_little() -> None:
    axis = Axis(9.0, 0.1, motor(lag_s=0.1))
    axis.run(PLUS, 0.2)
    assert 1.0 < axis.angle_deg - 100.0 < 2.0
    assert 6.1 < axis.model.motors[PLUS].speed_dps < 6.9, "less than a long run would"


def test_a_coast_is_never_negative_and_at_most_three_seconds_of_full_speed() -> None:
    for misses_deg, coast_deg in ((-20.0, 0.0), (100.0, 18.0)):
        axis = Axis(6.0, 0.2, motor())
        axis.drive(PLUS)
        axis.turn(3.0)
        axis.drive(OFF, axis.angle_deg + 1.2 - misses_deg)
        axis.turn(RESTS_AFTER_S + (LANDING_READINGS + 2) * STEP_S)
        assert axis.model.motors[PLUS].coast_deg == pytest.approx(coast_deg, rel=0.01)


def test_a_run_that_is_to_be_forgotten_teaches_nothing() -> None:
    axis = Axis(3.0, 0.2, motor())
    axis.drive(PLUS)
    axis.turn(1.0)
    axis.model.forget_run()
    assert axis.model.resting
    axis.drive(OFF)
    axis.turn(2.0)
    assert axis.model.motors[PLUS] == motor()


def test_a_run_from_a_coast_teaches_no_speed() -> None:
    """It did not begin at rest: how far it went says nothing of how fast it is."""
    axis = Axis(4.5, 0.2, motor())
    axis.drive(PLUS)
    axis.turn(0.1)
    axis.drive(OFF, axis.angle_deg)
    axis.turn(0.1)
    axis.drive(PLUS)
    axis.turn(2.0)
    axis.drive(OFF, axis.model.rest_deg(axis.now_s))
    axis.turn(RESTS_AFTER_S + (LANDING_READINGS + 2) * STEP_S)
    assert axis.model.motors[PLUS].speed_dps == 6.0


def test_the_same_command_again_changes_nothing() -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.drive(PLUS)
    axis.turn(1.0)
    axis.drive(PLUS)
    axis.turn(1.0)
    axis.drive(OFF, axis.model.rest_deg(axis.now_s))
    axis.drive(OFF, 0.0)
    axis.turn(RESTS_AFTER_S + (LANDING_READINGS + 2) * STEP_S)
    assert axis.model.motors[PLUS].speed_dps == pytest.approx(6.0, rel=0.01)
    assert axis.model.motors[PLUS].coast_deg == pytest.approx(1.2, abs=0.05)


# --- readings


def test_a_reading_that_is_a_little_off_is_followed_slowly_and_while_running_faster() -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.model.see(axis.now_s + 0.05, 101.0)
    assert axis.model.angle_deg == pytest.approx(100.0 + 0.03)
    axis = Axis(6.0, 0.2, motor())
    axis.drive(PLUS)
    axis.model.see(axis.now_s, 101.0)
    assert axis.model.angle_deg == pytest.approx(100.0 + 0.15)


@pytest.mark.parametrize("off_deg", [-3.1, 3.1, 200.0])
def test_a_spark_is_not_followed_until_it_stays(off_deg: float) -> None:
    axis = Axis(6.0, 0.2, motor())
    for _ in range(JUMP_READINGS - 1):
        axis.now_s += STEP_S
        axis.model.see(axis.now_s, 100.0 + off_deg)
        assert axis.model.angle_deg == 100.0
    axis.now_s += STEP_S
    axis.model.see(axis.now_s, 100.0 + off_deg)
    assert axis.model.angle_deg == 100.0 + off_deg


def test_a_good_reading_between_sparks_begins_their_count_anew() -> None:
    axis = Axis(6.0, 0.2, motor())
    for off_deg in (50.0, 50.0, 0.0, 50.0, 50.0):
        axis.now_s += STEP_S
        axis.model.see(axis.now_s, 100.0 + off_deg)
    assert axis.model.angle_deg == 100.0


def test_three_degrees_are_no_spark() -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.model.see(axis.now_s + STEP_S, 103.0)
    assert axis.model.angle_deg == pytest.approx(100.09)


@BOTH_WAYS
def test_a_motor_much_faster_than_known_is_caught_up_with(way: Direction) -> None:
    axis = Axis(60.0, 0.02, motor())
    axis.drive(way)
    axis.turn(1.0)
    assert axis.model.angle_deg == pytest.approx(axis.angle_deg, abs=3.5)
    assert axis.model.motors[way].speed_dps == pytest.approx(60.0, rel=0.05)
    assert axis.model.motors[Direction(-way)] == motor()
    assert axis.model.motors[way].lag_s == pytest.approx(0.2), "it is the speed that is seen, not the lag"


def test_a_hand_that_turns_a_resting_axis_teaches_no_speed() -> None:
    axis = Axis(6.0, 0.2, motor())
    for _ in range(40):
        axis.now_s += STEP_S
        axis.angle_deg += 2.0
        axis.model.see(axis.now_s, axis.angle_deg)
    assert axis.model.motors == {PLUS: motor(), MINUS: motor()}
    assert axis.model.angle_deg == pytest.approx(axis.angle_deg, abs=6.5)


def test_a_jump_back_against_the_run_is_no_higher_speed() -> None:
    axis = Axis(6.0, 0.2, motor())
    axis.drive(PLUS)
    axis.turn(1.0)
    for _ in range(JUMP_READINGS):
        axis.now_s += STEP_S
        axis.angle_deg -= 4.0
        axis.model.see(axis.now_s, axis.angle_deg)
    assert axis.model.motors[PLUS] == motor()
