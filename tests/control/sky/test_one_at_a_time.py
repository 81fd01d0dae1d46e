"""Motors that never run together: elevation is done before a long turn of azimuth, and not a minute late."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.assembly.settings import planned_motors
from rotator.config.load import parse, shipped
from rotator.control.sky.flight_plan import Antenna, plan_flight
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.one_at_a_time import SPARE_S, before_azimuth
from rotator.control.sky.route import Speeds
from rotator.exchange.flight_order import Step
from tests.control.sky.test_turn_timing import overhead

SPEEDS = Speeds(6.0, 3.0)
TURN = Step(0.0, 180.0), Step(100.0, 0.0)
"""From 100 s to 130 s."""
MOUNT = Mount(Range(0.0, 360.0), Range(0.0, 90.0))


def high(_at_s: float, _azimuth_deg: float, elevation_deg: float) -> float:
    """The target stands at the zenith."""
    return abs(90.0 - elevation_deg)


def elevation(*moves: tuple[float, float]) -> tuple[Step, ...]:
    return Step(0.0, 60.0), *(Step(*move) for move in moves)


@pytest.mark.parametrize("leaves_s", [99.6, 100.0, 104.0, 114.9])
def test_what_leaves_in_the_first_half_of_the_turn_is_done_before_it(leaves_s: float) -> None:
    """From 60° to 84° at 3°/s."""
    moved = before_azimuth(TURN, elevation((leaves_s, 84.0)), SPEEDS, high)
    assert moved == elevation((92.0 - SPARE_S, 84.0))


@pytest.mark.parametrize("leaves_s", [80.0, 99.4, 115.0, 129.0, 131.0])
def test_all_else_stays(leaves_s: float) -> None:
    steps = elevation((leaves_s, 84.0))
    assert before_azimuth(TURN, steps, SPEEDS, high) == steps


def test_of_several_steps_the_last_place_counts() -> None:
    moved = before_azimuth(TURN, elevation((90.0, 66.0), (102.0, 75.0), (108.0, 84.0), (128.0, 70.0)), SPEEDS, high)
    assert moved == elevation((90.0, 66.0), (94.0 - SPARE_S, 84.0), (128.0, 70.0))


@pytest.mark.parametrize(("middle_off_deg", "place_deg"), [(0.0, 76.0), (8.0, 80.0)])
def test_the_place_is_the_best_for_the_whole_turn(middle_off_deg: float, place_deg: float) -> None:
    """The target is at 76°, but half way through the turn it is nearest to higher places."""

    def off(at_s: float, _azimuth_deg: float, elevation_deg: float) -> float:
        return abs(76.0 + middle_off_deg * (110.0 <= at_s <= 120.0) - elevation_deg)

    (_, moved) = before_azimuth(TURN, elevation((104.0, 88.0)), SPEEDS, off)
    assert moved.place_deg == pytest.approx(place_deg, abs=1.5)
    assert moved.leave_s == pytest.approx(100.0 - SPARE_S - (moved.place_deg - 60.0) / 3.0)


def test_a_turn_begins_where_azimuth_stands_and_ends_at_its_place() -> None:
    asked = []

    def off(at_s: float, azimuth_deg: float, _elevation_deg: float) -> float:
        asked.append((at_s, azimuth_deg))
        return 0.0

    before_azimuth(TURN, elevation((104.0, 61.0)), SPEEDS, off)
    assert asked[0] == (100.0, 180.0)
    assert max(asked)[0] == pytest.approx(130.0, abs=1.0)
    assert min(azimuth_deg for _, azimuth_deg in asked) == pytest.approx(0.0, abs=1e-6)


def test_no_step_leaves_before_the_one_that_it_follows() -> None:
    moved = before_azimuth(TURN, elevation((97.0, 66.0), (102.0, 84.0)), SPEEDS, high)
    assert moved == elevation((97.0, 66.0), (97.0, 84.0))


def test_the_first_steps_are_moves_to_where_the_target_rises_and_stay() -> None:
    both = Step(100.0, 0.0), Step(130.0, 180.0)
    assert before_azimuth(both, (Step(100.0, 60.0),), SPEEDS, high) == (Step(100.0, 60.0),)
    assert before_azimuth((Step(0.0, 5.0),), elevation((3.0, 84.0)), SPEEDS, high) == elevation((3.0, 84.0))


STEPS = st.lists(st.tuples(st.floats(0, 600), st.floats(0, 90)), min_size=1, max_size=12).map(
    lambda moves: [Step(*move) for move in sorted(moves)]
)


@given(STEPS, STEPS)
def test_moments_stay_in_order_and_places_among_those_planned(azimuth: list[Step], steps: list[Step]) -> None:
    moved = before_azimuth(azimuth, steps, SPEEDS, high)
    assert [step.leave_s for step in moved] == sorted(step.leave_s for step in moved)
    assert len(moved) <= len(steps)
    places_deg = [step.place_deg for step in steps]
    assert all(min(places_deg) <= step.place_deg <= max(places_deg) for step in moved)


@pytest.mark.parametrize(("profile", "alone"), [("u100", True), ("simulated", False), ("isel", False)])
def test_a_plan_knows_from_the_file_whether_the_motors_run_together(profile: str, alone: bool) -> None:
    assert [motor.alone for motor in planned_motors(parse(shipped(profile), profile))] == [alone, alone]


@pytest.mark.parametrize("beside_deg", [1.0, 4.0, 9.0])
def test_in_a_plan_of_an_overhead_pass_nothing_waits_for_half_of_a_turn(beside_deg: float) -> None:
    motors = planned_motors(parse(shipped("u100"), "u100"))
    plan = plan_flight("overhead", overhead(beside_deg), Antenna(MOUNT, *motors, (160.0, 0.0)), -60.0).order
    turns = [
        (turn.leave_s, turn.leave_s + abs(turn.place_deg - before.place_deg) / motors[0].speed_dps / 2)
        for before, turn in pairwise(plan.azimuth.steps)
    ]
    assert max(middle_s - leave_s for leave_s, middle_s in turns) > 10.0
    assert not [
        step
        for step in plan.elevation.steps
        for leave_s, middle_s in turns
        if leave_s - SPARE_S < step.leave_s < middle_s
    ]
