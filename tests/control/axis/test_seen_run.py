"""How fast a motor is by what its runs have shown, and whether the axis turned when a run ended."""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.observed_motion import ObservedMotion
from rotator.control.axis.seen_run import SeenRun
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Motor
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
STEP_S = 0.05
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
BELIEVED_DPS = 6.0


class Runs:
    """An axis that turns as the test says, and the run that is seen of it."""

    def __init__(self, noise_deg: float = 0.05, at_deg: float = 200.0, seed: int = 4) -> None:
        motor = Motor(BELIEVED_DPS, 0.9)
        self._observed = ObservedMotion(Axis.AZIMUTH, Range(0.0, 450.0), {PLUS: motor, MINUS: motor})
        self.seen = SeenRun(self._observed)
        self._switch = Switch(self._observed.note_relays)
        self._noise_deg, self._chance = noise_deg, random.Random(seed)
        self._at_deg, self.now_s, self._began_s, self._way = at_deg, 50.0, 0.0, OFF
        self.turn(2.0, 0.0)

    def turn(self, seconds: float, dps: float) -> None:
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            self._at_deg += dps * STEP_S
            read_deg = self._at_deg + self._chance.gauss(0.0, self._noise_deg)
            if self._observed.see(self.now_s, read_deg) and self._way:
                self.seen.see(self.now_s)

    def begin(self, way: Direction) -> None:
        self._switch.to(self.now_s, way)
        self.seen.begin()
        self._way, self._began_s = way, self.now_s

    def end(self) -> None:
        way, self._way = self._way, OFF
        self._switch.to(self.now_s, OFF)
        self.seen.end(self.now_s, way, self.now_s - self._began_s, self._at_deg)

    def run(self, way: Direction, seconds: float, dps: float) -> None:
        self.begin(way)
        self.turn(seconds, dps * way)
        self.end()
        self.turn(1.0, 0.0)


def test_before_the_first_run_its_speed_is_the_believed_one() -> None:
    runs = Runs()
    assert runs.seen.measured_dps is None
    assert runs.seen.motor_dps == 6.0
    assert runs.seen.powered_dps == pytest.approx(0.2 * 6.0), "it may be a fifth of that"


@BOTH_WAYS
@pytest.mark.parametrize("dps", [2.0, 6.0, 9.0])
@pytest.mark.parametrize("run_s", [0.8, 1.6, 5.0])
def test_a_run_shows_its_speed(way: Direction, dps: float, run_s: float) -> None:
    runs = Runs()
    runs.run(way, run_s, dps)
    assert runs.seen.measured_dps == pytest.approx(dps, rel=0.15 if run_s < 1.0 else 0.04)
    assert runs.seen.motor_dps == runs.seen.measured_dps
    assert runs.seen.powered_dps == pytest.approx(0.5 * runs.seen.motor_dps)


def test_the_slower_direction_is_its_speed_and_the_latest_run_that_way_counts() -> None:
    runs = Runs()
    runs.run(PLUS, 3.0, 6.0)
    runs.run(MINUS, 3.0, 4.0)
    assert runs.seen.measured_dps == pytest.approx(4.0, rel=0.04)
    runs.run(MINUS, 3.0, 5.0)
    assert runs.seen.measured_dps == pytest.approx(5.0, rel=0.04)


@pytest.mark.parametrize("run_s", [0.2, 0.5])
def test_a_tap_shows_no_speed_for_the_motor_is_still_gathering_it(run_s: float) -> None:
    runs = Runs()
    runs.run(PLUS, run_s, 3.0)
    assert runs.seen.measured_dps is None


def test_among_noisy_readings_a_short_run_shows_none() -> None:
    runs = Runs(noise_deg=0.8)
    runs.run(PLUS, 0.8, 2.0)
    assert runs.seen.measured_dps is None


@BOTH_WAYS
def test_the_end_of_a_run_is_its_line_and_its_place(way: Direction) -> None:
    runs = Runs(noise_deg=0.02)
    runs.begin(way)
    runs.turn(2.0, 6.0 * way)
    runs.end()
    ended = runs.seen.ended
    assert ended is not None
    assert (ended.direction, ended.off_s, ended.lasted_s) == (way, runs.now_s, pytest.approx(2.0))
    assert ended.angle_deg == pytest.approx(200.0 + 12.0 * way)
    assert ended.line is not None
    assert ended.line.speed_dps == pytest.approx(6.0 * way, rel=0.03)
    assert runs.seen.line is None, "the run is over"
    assert runs.seen.turned_s == runs.now_s
    runs.begin(way)
    assert runs.seen.ended is None


@pytest.mark.parametrize("stood_s", [0.5, 1.0, 3.0])
@pytest.mark.parametrize("dps", [2.0, 6.0, 12.0])
def test_held_at_the_end_of_a_run_it_was_not_seen_to_turn(stood_s: float, dps: float) -> None:
    runs = Runs()
    runs.begin(PLUS)
    runs.turn(3.0, dps)
    held_s = runs.now_s
    runs.turn(stood_s, 0.0)
    runs.end()
    assert runs.seen.ended is not None
    assert runs.seen.ended.line is None
    assert held_s - 0.1 <= runs.seen.turned_s <= held_s + 0.35


@pytest.mark.parametrize("noise_deg", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("dps", [4.0, 12.0, 40.0])
def test_held_for_a_second_it_is_not_taken_for_turning_in_any_noise(dps: float, noise_deg: float) -> None:
    for seed in range(12):
        runs = Runs(noise_deg, 20.0, seed)
        runs.begin(PLUS)
        runs.turn(2.0, dps)
        runs.turn(1.0, 0.0)
        assert runs.seen.line is None, seed


def test_a_fast_motor_is_seen_to_turn_within_a_third_of_a_second_and_to_stand_as_soon() -> None:
    runs = Runs(noise_deg=0.02)
    runs.begin(PLUS)
    runs.turn(0.3, 12.0)
    assert runs.seen.line is not None
    runs.turn(0.2, 0.0)
    assert runs.seen.line is None


def test_a_motor_that_drags_at_the_end_has_the_speed_of_its_end() -> None:
    runs = Runs(noise_deg=0.03)
    runs.begin(PLUS)
    runs.turn(3.0, 6.0)
    runs.turn(0.5, 4.5)
    runs.end()
    assert runs.seen.measured_dps == pytest.approx(4.5, rel=0.1)


def test_a_sensor_that_is_silent_for_the_last_second_leaves_the_speed_of_before() -> None:
    runs = Runs()
    runs.begin(PLUS)
    runs.turn(3.0, 6.0)
    runs.now_s += 1.2
    runs.end()
    assert runs.seen.measured_dps == pytest.approx(6.0, rel=0.2)


def test_a_motor_that_never_starts_is_not_seen_to_turn() -> None:
    runs = Runs(noise_deg=0.2)
    runs.begin(PLUS)
    runs.turn(4.0, 0.0)
    runs.end()
    assert runs.seen.ended is not None
    assert runs.seen.ended.line is None
    assert runs.seen.measured_dps is None


def test_a_run_is_not_judged_by_what_the_axis_did_before_it() -> None:
    runs = Runs()
    runs.turn(3.0, 6.0)
    runs.begin(PLUS)
    runs.turn(1.0, 0.0)
    assert runs.seen.line is None


@pytest.mark.parametrize("dps", [0.3, 1.5, 6.0])
def test_a_slow_motor_is_seen_to_turn_once_the_noise_allows_it(dps: float) -> None:
    """Slower than a fifth of what the file says, it is not taken for turning."""
    runs = Runs(noise_deg=0.1)
    runs.begin(PLUS)
    runs.turn(6.0, dps)
    assert (runs.seen.line is not None) is (dps >= 1.2)


def test_the_noisier_the_readings_the_longer_a_motor_may_turn_unseen() -> None:
    assert Runs(noise_deg=0.02).seen.unseen_s == pytest.approx(0.3, abs=0.3)
    quiet, noisy = Runs(noise_deg=0.1), Runs(noise_deg=0.8)
    noisy.turn(10.0, 0.0)
    assert noisy.seen.unseen_s > 2.0 * quiet.seen.unseen_s
