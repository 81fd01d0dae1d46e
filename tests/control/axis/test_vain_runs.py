"""Runs too short to be judged alone: an axis that does not move, moves the wrong way, or is just slow."""

from __future__ import annotations

import math
import random

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.axis.vain_runs import STANDS_S
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import ALL_OPEN, Motor
from tests.control.axis.switch import Switch
from tests.search import some

STEP_S = 0.05
SPEED_DPS = 6.0
PLUS, MINUS = Direction.PLUS, Direction.MINUS


class Bench:
    """An axis looked at twenty times a second. It turns at `pace` of its motor's speed, and coasts 0.15 s."""

    def __init__(self, pace: float = 1.0, noise_deg: float = 0.1, *, known: bool = True, seed: int = 5) -> None:
        self.pace = pace
        self._noise_deg = noise_deg
        self._chance = random.Random(seed)
        motors = dict.fromkeys((PLUS, MINUS), Motor(SPEED_DPS, 0.15 * SPEED_DPS))
        limits = Range(-1000.0, 1000.0)
        self._watch = MotionWatch(Axis.AZIMUTH, limits, motors, master=False, trusts=ALL_OPEN, placed=True, look=False)
        self._relays = Switch(self._watch.note_relays)
        self._way = Direction.OFF
        self._speed_dps = 0.0
        self._angle_deg = 100.0
        self._now_s = 10.0
        self.wind_dps = 0.0
        """It turns the axis while its motor has no current."""
        self.faults: list[Fault] = []
        self.look(1.0)
        if known:
            pace, self.pace = self.pace, 1.0
            self.press(PLUS, 1.0, 1.0)
            self.pace = pace

    def press(self, way: Direction, run_s: float, pause_s: float) -> None:
        self._switch(way)
        self.look(run_s)
        self._switch(Direction.OFF)
        self.look(pause_s)

    def look(self, seconds: float) -> None:
        for _ in range(round(seconds / STEP_S)):
            self._now_s += STEP_S
            self._speed_dps += (self._way * SPEED_DPS * self.pace - self._speed_dps) / 3.0
            self._angle_deg += (self._speed_dps + (0.0 if self._way else self.wind_dps)) * STEP_S
            seen_deg = self._angle_deg + self._chance.gauss(0.0, self._noise_deg)
            if (found := self._watch.see(self._now_s, seen_deg)) is not None:
                self.faults.append(found)
                self._watch.runs.struck(found.kind)
                self._switch(Direction.OFF)

    def _switch(self, way: Direction) -> None:
        self._way = way
        self._relays.to(self._now_s, way)

    @property
    def settles(self) -> bool:
        return self._watch.runs.settles(self._now_s)

    @property
    def kinds(self) -> list[FaultKind]:
        return [fault.kind for fault in self.faults]


@pytest.mark.parametrize("way", [PLUS, MINUS])
@pytest.mark.parametrize("pause_s", [0.2, 1.0, 30.0])
@pytest.mark.parametrize("run_s", [0.1, 0.2, 0.3, 0.5, 1.0])
def test_runs_one_way_that_move_nothing_are_a_fault_after_a_second_and_a_quarter_of_them(
    run_s: float, pause_s: float, way: Direction
) -> None:
    bench = Bench(pace=0.0)
    runs = 0
    while not bench.kinds:
        bench.press(way, run_s, pause_s)
        runs += 1
    assert 0.9 < runs * run_s <= 2.0
    assert bench.kinds == [FaultKind.STANDS_STILL]


@pytest.mark.parametrize("known", [True, False])
def test_to_and_fro_the_play_of_the_gear_comes_first_in_each_run(*, known: bool) -> None:
    bench = Bench(pace=0.0, known=known)
    runs = 0
    while not bench.kinds:
        bench.press((PLUS, MINUS)[runs % 2], 0.35, 0.7)
        runs += 1
    assert 5 <= runs <= 9
    assert bench.kinds == [FaultKind.STANDS_STILL]


def test_after_that_each_further_one_is_a_fault_until_it_moves() -> None:
    bench = Bench(pace=0.0)
    for _ in range(6):
        bench.press(PLUS, 0.5, 1.0)
    assert len(bench.faults) == 4
    bench.pace = 1.0
    bench.press(PLUS, 0.5, 1.0)
    bench.pace = 0.0
    bench.press(PLUS, 0.5, 1.0)
    bench.press(PLUS, 0.5, 1.0)
    assert len(bench.faults) == 4


def test_driven_backwards_three_times_is_the_wrong_way() -> None:
    bench = Bench(pace=-1.0)
    for _ in range(3):
        bench.press(PLUS, 0.4, 1.0)
    assert bench.kinds == [FaultKind.WRONG_WAY]


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("ways", [(PLUS, PLUS), (PLUS, MINUS)], ids=["one way", "to and fro"])
@pytest.mark.parametrize("noise_deg", [0.02, 0.1, 0.4])
@pytest.mark.parametrize("pace", [0.3, 1.0, 1.5])
def test_an_axis_that_turns_is_never_accused(
    pace: float, noise_deg: float, ways: tuple[Direction, Direction], known: bool
) -> None:
    bench = Bench(pace, noise_deg, known=known)
    for count in range(60):
        bench.press(ways[count % 2], (0.1, 0.2, 0.3, 0.6, 1.5)[count % 5], (0.2, 0.7, 2.0)[count % 3])
    assert bench.faults == []


@pytest.mark.parametrize("noise_deg", [0.1, 0.3, 0.4])
@pytest.mark.parametrize("run_s", [STEP_S, 0.1])
def test_an_antenna_that_turns_to_and_fro_about_its_target_is_no_fault(run_s: float, noise_deg: float) -> None:
    bench = Bench(noise_deg=noise_deg)
    for count in range(60):
        bench.press((PLUS, MINUS)[count % 2], run_s, 1.5)
    assert bench.faults == []


def test_after_a_run_the_next_start_waits_until_the_readings_can_show_it() -> None:
    bench = Bench(pace=0.0)
    bench.press(PLUS, 0.1, 0.3)
    assert bench.settles
    bench.look(0.4)
    assert not bench.settles


def test_after_a_run_that_has_moved_the_axis_the_next_start_does_not_wait() -> None:
    bench = Bench(pace=1.0)
    bench.press(PLUS, 0.4, 0.1)
    assert not bench.settles


@pytest.mark.search
@pytest.mark.parametrize("seed", some(range(40)))
def test_a_motor_that_holds_its_antenna_against_a_steady_wind_is_not_accused(seed: int) -> None:
    """Each short run leads it back to its target, and the wind turns it away again, by as much."""
    chance = random.Random(seed)
    noise_deg, pace = chance.choice((0.0, 0.1, 0.2, 0.4)), chance.uniform(0.6, 1.2)
    stroke_deg = max(0.3, 2.5 * noise_deg) * chance.uniform(1.3, 2.2)
    run_s, pause_s = stroke_deg / (SPEED_DPS * pace), chance.choice((2.0, 4.0))
    bench = Bench(noise_deg=noise_deg, seed=seed)
    bench.pace, bench.wind_dps = pace, -stroke_deg / pause_s
    for _ in range(30):
        bench.press(PLUS, run_s, pause_s)
    assert bench.faults == []


@pytest.mark.search
@pytest.mark.parametrize("seed", some(range(40)))
def test_a_motor_that_stands_is_a_fault_among_noise_in_runs_of_any_length(seed: int) -> None:
    chance = random.Random(seed)
    noise_deg, way = chance.choice((0.0, 0.1, 0.2, 0.4)), chance.choice((PLUS, MINUS))
    run_s = chance.uniform(0.1, 0.8)
    bench = Bench(pace=0.0, noise_deg=noise_deg, seed=seed)
    for _ in range(math.ceil(2.0 * STANDS_S / run_s)):
        bench.press(way, run_s, 0.7)
    assert FaultKind.STANDS_STILL in bench.kinds
