"""Runs too short to be judged alone: an axis that does not move, moves the wrong way, or is just slow."""

from __future__ import annotations

import math
import random

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.short_runs import (
    LEAST_RUN_S,
    MOVED_DEG,
    MOVED_NOISES,
    SHOWN_SHARE,
    STOOD_STARTS,
    ShortRuns,
)
from rotator.exchange.faults import Fault, FaultKind
from tests.control.axis.switch import Switch

STEP_S = 0.05
SPEED_DPS = 6.0
PLUS, MINUS = Direction.PLUS, Direction.MINUS


class Bench:
    """An axis looked at twenty times a second. It turns at `pace` of its motor's speed, and coasts 0.15 s."""

    def __init__(self, pace: float = 1.0, noise_deg: float = 0.1, *, known: bool = True, seed: int = 5) -> None:
        self.pace = pace
        self._noise_deg = noise_deg
        self._chance = random.Random(seed)
        self._runs = ShortRuns(Axis.AZIMUTH)
        self._relays = Switch(lambda relays: self._runs.note_relays(relays, SPEED_DPS))
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
            if (found := self._runs.see(self._now_s, seen_deg, self._noise_deg)) is not None:
                self.faults.append(found)
                self._runs.struck(found.kind)

    def _switch(self, way: Direction) -> None:
        self._way = way
        self._relays.to(self._now_s, way)

    @property
    def settles(self) -> bool:
        return self._runs.settles(self._now_s)

    @property
    def kinds(self) -> list[FaultKind]:
        return [fault.kind for fault in self.faults]


@pytest.mark.parametrize("ways", [(PLUS, PLUS), (PLUS, MINUS)], ids=["one way", "to and fro"])
@pytest.mark.parametrize("pause_s", [0.2, 1.0, 30.0])
@pytest.mark.parametrize("run_s", [0.3, 0.5, 1.0])
def test_three_runs_that_move_nothing_are_a_fault(
    run_s: float, pause_s: float, ways: tuple[Direction, Direction]
) -> None:
    bench = Bench(pace=0.0)
    for count in range(4):
        bench.press(ways[count % 2], run_s, pause_s)
    assert bench.kinds[:1] == [FaultKind.STANDS_STILL]


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


def test_three_runs_are_enough_for_a_motor_that_has_not_turned_yet() -> None:
    bench = Bench(pace=0.0, known=False)
    for _ in range(3):
        bench.press(PLUS, 0.6, 1.0)
    assert bench.kinds == [FaultKind.STANDS_STILL]


def test_shorter_ones_add_up() -> None:
    bench = Bench(pace=0.0)
    for _ in range(8):
        bench.press(PLUS, 0.2, 1.0)
    assert bench.kinds == [FaultKind.STANDS_STILL]


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


def test_a_few_taps_too_short_for_a_motor_show_nothing() -> None:
    bench = Bench(pace=0.0)
    for _ in range(STOOD_STARTS - 1):
        bench.press(PLUS, LEAST_RUN_S - STEP_S, 0.7)
    assert bench.faults == []


def test_a_standing_motor_that_is_started_again_and_again_near_its_target_is_a_fault() -> None:
    bench = Bench(pace=0.0)
    for _ in range(STOOD_STARTS):
        bench.press(PLUS, LEAST_RUN_S - STEP_S, 0.7)
    assert bench.kinds == [FaultKind.STANDS_STILL]


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


@pytest.mark.parametrize("seed", range(40))
def test_a_motor_that_holds_its_antenna_against_a_steady_wind_is_not_accused(seed: int) -> None:
    """Each short run leads it back to its target, and the wind turns it away again, by as much."""
    chance = random.Random(seed)
    noise_deg, pace = chance.choice((0.0, 0.1, 0.2, 0.4)), chance.uniform(0.4, 1.2)
    stroke_deg = max(MOVED_DEG, MOVED_NOISES * noise_deg) * chance.uniform(1.3, 2.2)
    run_s, pause_s = stroke_deg / (SPEED_DPS * pace), chance.choice((0.7, 1.0, 2.0))
    bench = Bench(noise_deg=noise_deg, seed=seed)
    bench.pace, bench.wind_dps = pace, -stroke_deg / pause_s
    for _ in range(30):
        bench.press(PLUS, run_s, pause_s)
    assert bench.faults == []


@pytest.mark.parametrize("seed", range(40))
def test_a_motor_that_stands_is_a_fault_among_noise_in_runs_of_any_length(seed: int) -> None:
    chance = random.Random(seed)
    noise_deg, way = chance.choice((0.0, 0.1, 0.2, 0.4)), chance.choice((PLUS, MINUS))
    run_s = chance.uniform(0.1, 0.8)
    needed = max(STOOD_STARTS, math.ceil(MOVED_NOISES * noise_deg / (SHOWN_SHARE * SPEED_DPS * run_s)))
    bench = Bench(pace=0.0, noise_deg=noise_deg, seed=seed)
    for _ in range(needed + 1):
        bench.press(way, run_s, 0.7)
    assert FaultKind.STANDS_STILL in bench.kinds
