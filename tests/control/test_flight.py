"""A planned pass while it is flown: the goals that begin at each moment, the direction shown, and its end."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import Axis
from rotator.control.flight import Flight
from rotator.control.sky.mount import Mount, Range, Unreachable
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
