"""A part of a pass whose axis angles a person has named: the path as it stands, and steps for motors on relays."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_given_angles
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.flight_order import PLAN_STEP_S, Fly

FULL = Mount(Range(0, 450), Range(0, 180))
STEERED = PlannedMotor(30.0, 0.0, 0.2, switched=False)
SWITCHED = PlannedMotor(6.0, 0.0, 4.0)
ROWS = ((1000.0, 20.0, 80.0), (1200.0, 60.0, 60.0))
AXES = ((1000.0, 380.0, 80.0), (1100.0, 420.0, 90.0), (1200.0, 430.0, 120.0))
"""0.4°/s and 0.1°/s, then 0.1°/s and 0.3°/s."""


def told(
    motor: PlannedMotor = STEERED,
    span_s: tuple[float, float] = (1000.0, 1200.0),
    *,
    now_s: float = 990.0,
    mount: Mount = FULL,
) -> Fly:
    return plan_given_angles("turns", ROWS, AXES, Antenna(mount, motor, motor, (0.0, 0.0)), now_s, span_s=span_s)


def test_the_axes_go_straight_from_row_to_row_within_the_span() -> None:
    order = told(span_s=(1050.0, 1150.0))
    assert (order.name, order.path) == ("turns", ROWS)
    for plan in (order.azimuth, order.elevation):
        assert (plan.begin_s, len(plan.angles_deg), plan.steps) == (1050.0, 201, ())
    for at_s, angles_deg in ((1050.0, (400.0, 85.0)), (1100.0, (420.0, 90.0)), (1150.0, (425.0, 105.0))):
        at = round((at_s - 1050.0) / PLAN_STEP_S)
        assert (order.azimuth.angles_deg[at], order.elevation.angles_deg[at]) == pytest.approx(angles_deg)


def test_before_the_first_row_and_after_the_last_one_the_axes_stand() -> None:
    order = told(span_s=(995.0, 1205.0))
    assert order.azimuth.angles_deg[0] == 380.0
    assert (order.azimuth.angles_deg[-1], order.elevation.angles_deg[-1]) == (430.0, 120.0)


def test_the_shortest_part_has_two_moments() -> None:
    assert told(span_s=(1050.0, 1050.1)).azimuth.angles_deg == pytest.approx((400.0, 400.2))


def test_no_angle_is_beyond_a_limit() -> None:
    order = told(mount=Mount(Range(0, 425), Range(0, 100)))
    assert max(order.azimuth.angles_deg) == 425.0
    assert max(order.elevation.angles_deg) == 100.0
    stepped = told(SWITCHED, mount=Mount(Range(0, 425), Range(0, 100)))
    assert all(step.place_deg <= 425.0 for step in stepped.azimuth.steps)


def test_a_motor_on_relays_leaves_at_once_for_the_first_place_and_then_step_by_step() -> None:
    steps = told(SWITCHED).azimuth.steps
    assert steps[0].leave_s == 990.0
    assert all(a.leave_s < b.leave_s and a.place_deg < b.place_deg for a, b in pairwise(steps))
    assert 380.0 < steps[0].place_deg < 388.0
    assert 424.0 < steps[-1].place_deg < 430.0


@pytest.mark.parametrize(
    "late", [replace(SWITCHED, coast_s=0.6), replace(SWITCHED, coast_s=0.0, brake_s=0.6)], ids=["coast", "brake"]
)
def test_a_motor_that_coasts_or_has_a_brake_to_release_leaves_earlier_by_that_time(late: PlannedMotor) -> None:
    exact, coasting = (told(motor).azimuth.steps for motor in (replace(SWITCHED, coast_s=0.0), late))
    assert coasting[0] == exact[0]
    assert [b.leave_s - a.leave_s for a, b in zip(exact[1:], coasting[1:], strict=True)] == pytest.approx(
        [-0.6] * (len(exact) - 1)
    )


@pytest.mark.parametrize("tolerance_deg", [1.0, 2.0, 4.0])
def test_the_steps_are_as_wide_as_the_tolerance_asks(tolerance_deg: float) -> None:
    """At 0.4°/s the cheapest step is 1.9 tolerances wide."""
    steps = told(replace(SWITCHED, tolerance_deg=tolerance_deg), (1000.0, 1100.0)).azimuth.steps
    widths = [b.place_deg - a.place_deg for a, b in pairwise(steps[1:-1])]
    assert sum(widths) / len(widths) == pytest.approx(1.9 * tolerance_deg, rel=0.12)
