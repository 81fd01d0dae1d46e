"""A planned pass while it is flown: the goals that begin at each moment, the direction shown, and its end."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import Axis
from rotator.control.flight import STEP_TOLERANCE_DEG, Flight
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Mount, Range, Unreachable
from rotator.control.sky.plan import OFFSETS_S, Path
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan, Fly, Step

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MOUNT = Mount(Range(0.0, 450.0), Range(0.0, 180.0))
BEGIN_S, LASTS_S = 1000.0, 100.0
PATH = ((BEGIN_S, 350.0, 10.0), (BEGIN_S + LASTS_S, 30.0, 60.0))
"""0.4°/s through north, and 0.5°/s up."""


def plan(first_deg: float, rate_dps: float, *steps: tuple[float, float]) -> AxisPlan:
    count = round(LASTS_S / PLAN_STEP_S)
    angles_deg = tuple(first_deg + rate_dps * PLAN_STEP_S * index for index in range(count))
    return AxisPlan(BEGIN_S, angles_deg, tuple(Step(leave_s, place_deg) for leave_s, place_deg in steps))


STEERED = Fly("ISS", PATH, plan(350.0, 0.4), plan(10.0, 0.5))
STEPPED = replace(
    STEERED, azimuth=plan(350.0, 0.4, (990.0, 352.0), (1020.0, 362.0)), elevation=plan(10.0, 0.5, (990.0, 15.0))
)


def test_a_motor_on_relays_has_one_goal_from_step_to_step() -> None:
    flight = Flight(STEPPED, MOUNT)
    assert flight.goals(990.0) == {AZ: AimGoal(352.0, STEP_TOLERANCE_DEG), EL: AimGoal(15.0, STEP_TOLERANCE_DEG)}
    assert flight.goals(1019.9) == {}
    assert flight.goals(1020.0) == {AZ: AimGoal(362.0, STEP_TOLERANCE_DEG)}
    assert flight.goals(1090.0) == {}
    flight.begin_goals_anew()
    assert flight.goals(1090.0) == {AZ: AimGoal(362.0, STEP_TOLERANCE_DEG), EL: AimGoal(15.0, STEP_TOLERANCE_DEG)}


def test_before_its_first_step_it_goes_there_too() -> None:
    assert Flight(STEPPED, MOUNT).goals(900.0)[AZ] == AimGoal(352.0, STEP_TOLERANCE_DEG)


def test_a_motor_that_goes_to_angles_has_its_path_anew_twice_a_second() -> None:
    flight = Flight(STEERED, MOUNT)
    goal = flight.goals(1010.0)[AZ]
    assert goal.target_deg == pytest.approx(354.0)
    assert isinstance(goal.path, Path)
    assert goal.path.at_s == 1010.0
    assert list(goal.path.angles_deg) == pytest.approx([354.0 + 0.4 * offset_s for offset_s in OFFSETS_S])
    assert flight.goals(1010.4) == {}
    assert set(flight.goals(1010.5)) == {AZ, EL}


@pytest.mark.parametrize(
    ("at_s", "angle_deg"), [(900.0, 350.0), (1000.0, 350.0), (1000.25, 350.1), (1050.0, 370.0), (1200.0, 389.8)]
)
def test_before_the_plan_begins_and_after_it_ends_the_axis_stands(at_s: float, angle_deg: float) -> None:
    assert Flight(STEERED, MOUNT).way(at_s).azimuth_deg == pytest.approx(angle_deg)


@pytest.mark.parametrize(("raised_deg", "flipped"), [(10.0, False), (120.0, True)])
def test_its_way_is_over_the_top_where_its_elevation_is(raised_deg: float, flipped: bool) -> None:
    assert Flight(replace(STEERED, elevation=plan(raised_deg, 0.1)), MOUNT).way(1000.0).flipped is flipped


def test_the_display_shows_the_satellite_not_the_axes() -> None:
    wanted = Flight(STEERED, MOUNT).wanted(1050.0)
    assert (wanted.azimuth_deg, wanted.elevation_deg) == pytest.approx((10.0, 35.0))


@pytest.mark.parametrize(("sets_s", "shown_s"), [(None, 1100.0), (1080.0, 1080.0)])
def test_the_display_knows_when_it_rises_and_sets(sets_s: float | None, shown_s: float) -> None:
    flown = Flight(replace(STEERED, sets_s=sets_s), MOUNT).flown
    assert (flown.name, flown.begin_s, flown.end_s, flown.recognised) == ("ISS", 1000.0, shown_s, False)


def test_it_is_over_when_the_satellite_has_set_and_the_last_step_is_made() -> None:
    assert [Flight(STEERED, MOUNT).ended(at_s) for at_s in (1099.9, 1100.0)] == [False, True]
    late = replace(STEPPED, elevation=plan(10.0, 0.5, (990.0, 15.0), (1110.0, 60.0)))
    assert [Flight(late, MOUNT).ended(at_s) for at_s in (1105.0, 1110.0)] == [False, True]


@pytest.mark.parametrize(
    ("order", "said"),
    [
        (replace(STEERED, azimuth=plan(420.0, 0.4)), "the plan takes azimuth to 450.2°, beyond its limits"),
        (replace(STEERED, elevation=plan(-1.0, 0.5)), "the plan takes elevation to -1°, beyond its limits"),
        (replace(STEPPED, azimuth=plan(350.0, 0.4, (990.0, 451.0))), "the plan takes azimuth to 451°"),
    ],
)
def test_a_plan_beyond_the_limits_is_refused(order: Fly, said: str) -> None:
    with pytest.raises(Unreachable, match=said):
        Flight(order, MOUNT)
