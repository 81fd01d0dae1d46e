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
MOUNT = Mount(Range(0.0, 360.0), Range(0.0, 90.0))


def high(_at_s: float, _azimuth_deg: float, elevation_deg: float) -> float:
    """The target stands at the zenith."""
    return abs(90.0 - elevation_deg)


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
