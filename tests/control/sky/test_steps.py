"""The best steps along a known path: exact where they can be counted out, and never worse than what they began with."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.steps import Trail, best_steps
from rotator.exchange.flight_order import PLAN_STEP_S, Step

FAST_DPS = 1e6
SHORT = st.lists(st.floats(-20, 20), min_size=2, max_size=8)


def ways(trail: Trail, steps: list[Step], speed_dps: float) -> list[float]:
    """Where a motor of that speed is at each moment of the trail; it has reached the first place before it begins."""
    angle_deg, angles_deg = steps[0].place_deg, []
    for moment in range(len(trail.angles_deg)):
        at_s = trail.begin_s + moment * PLAN_STEP_S
        place_deg = [step.place_deg for step in steps if step.leave_s <= at_s or step is steps[0]][-1]
        angles_deg.append(angle_deg)
        angle_deg += max(-speed_dps * PLAN_STEP_S, min(speed_dps * PLAN_STEP_S, place_deg - angle_deg))
    return angles_deg


def error(trail: Trail, angles_deg: list[float]) -> float:
    """Degrees squared times seconds."""
    return PLAN_STEP_S * sum(
        weight * (target_deg - angle_deg) ** 2
        for weight, target_deg, angle_deg in zip(trail.weights, trail.angles_deg, angles_deg, strict=True)
    )


def least_cost(trail: Trail, price: float) -> float:
    """Of all piecewise constant curves, each tried."""
    count = len(trail.angles_deg)
    costs = []
    for jumps in itertools.product((False, True), repeat=count - 1):
        cuts = [0, *(index + 1 for index, jump in enumerate(jumps) if jump), count]
        cost = 0.0
        for begin, end in itertools.pairwise(cuts):
            angles_deg, weights = trail.angles_deg[begin:end], trail.weights[begin:end]
            mean_deg = sum(w * a for w, a in zip(weights, angles_deg, strict=True)) / sum(weights)
            cost += price + PLAN_STEP_S * sum(w * (a - mean_deg) ** 2 for w, a in zip(weights, angles_deg, strict=True))
        costs.append(cost)
    return min(costs)


@given(angles_deg=SHORT, weights=st.lists(st.floats(0.1, 1), min_size=8, max_size=8), price=st.floats(0.01, 100))
def test_a_motor_that_jumps_reaches_the_least_cost_of_all_curves(
    angles_deg: list[float], weights: list[float], price: float
) -> None:
    """A motor that jumps arrives a moment late, so the trail is held for two moments at each angle."""
    trail = Trail(
        0.0, [each for each in angles_deg for _ in range(2)], [w for w in weights[: len(angles_deg)] for _ in range(2)]
    )
    steps = best_steps(trail, FAST_DPS, price)
    late = PLAN_STEP_S * sum((b - a) ** 2 for a, b in itertools.pairwise(angles_deg))
    assert error(trail, ways(trail, steps, FAST_DPS)) + price * len(steps) <= least_cost(trail, price) + late + 1e-6


def test_a_motor_slower_than_its_target_leaves_before_the_target_comes() -> None:
    """Through the zenith: azimuth turns by 180° in 20 s, and the motor needs 30."""
    turn = [0.0] * 200 + [4.5 * moment for moment in range(40)] + [180.0] * 200
    trail = Trail(0.0, turn, [1.0] * len(turn))
    steps = best_steps(trail, 6.0, 10.0)
    assert steps[1].leave_s < 100.0
    assert max(abs(a - b) for a, b in zip(ways(trail, steps, 6.0), turn, strict=True)) < 45


def test_play_is_led_by_half_of_it_in_the_direction_of_each_move() -> None:
    trail = Trail(
        0.0, [0.2 * moment for moment in range(200)] + [40 - 0.2 * moment for moment in range(200)], [1.0] * 400
    )
    exact, led = best_steps(trail, 6.0, 50.0), best_steps(trail, 6.0, 50.0, play_deg=0.5)
    assert led[0] == exact[0]
    for (before, after), shifted in zip(itertools.pairwise(exact), led[1:], strict=True):
        side_deg = 0.25 if after.place_deg > before.place_deg else -0.25
        assert shifted.place_deg == pytest.approx(after.place_deg + side_deg)
        assert shifted.leave_s == after.leave_s


@given(st.lists(st.floats(-300, 700), min_size=2, max_size=60), st.floats(0.3, 60), st.floats(0.01, 1000))
def test_steps_rise_in_time_and_stay_within_what_the_path_spans(
    angles_deg: list[float], speed_dps: float, price: float
) -> None:
    steps = best_steps(Trail(7.0, angles_deg, [1.0] * len(angles_deg)), speed_dps, price)
    assert all(a.leave_s < b.leave_s for a, b in itertools.pairwise(steps))
    assert all(min(angles_deg) - 3 <= step.place_deg <= max(angles_deg) + 3 for step in steps)
    assert steps[0].leave_s >= 7.0
    assert steps[-1].leave_s <= 7.0 + PLAN_STEP_S * len(angles_deg)
