"""A pass planned whole: what the order holds, for antennas anywhere and passes that have begun already."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import STEP_S
from rotator.exchange.flight_order import PLAN_STEP_S
from tests.control.sky.test_ways import EVERY, FULL, OVER, SATELLITES, SINGLE, path_of
from tests.search import some

AZIMUTH, ELEVATION = PlannedMotor(6.0, 0.17, 4.0), PlannedMotor(2.7, 0.17, 4.0)
MOTEUS = PlannedMotor(30.0, 0.0, 0.2, switched=False)


@pytest.mark.long
@given(
    path=SATELLITES,
    mount=st.sampled_from([FULL, SINGLE, OVER]),
    stands_deg=st.tuples(st.floats(0, 360), st.floats(0, 90)),
    begun_s=st.floats(-200, 150),
)
def test_every_place_is_within_the_range_and_every_moment_in_order(
    path: KnownPath, mount: Mount, stands_deg: tuple[float, float], begun_s: float
) -> None:
    now_s = min(path.begin_s + begun_s, path.end_s - 5.0)
    order = plan_flight("any", path, Antenna(mount, AZIMUTH, ELEVATION, stands_deg), now_s).order
    for plan, limits in ((order.azimuth, mount.azimuth), (order.elevation, mount.elevation)):
        assert all(limits.holds(angle_deg) for angle_deg in plan.angles_deg)
        moments_s = [step.leave_s for step in plan.steps]
        assert moments_s == sorted(moments_s)
        assert moments_s[0] == now_s
        assert all(limits.holds(step.place_deg) for step in plan.steps)


@pytest.mark.search
@pytest.mark.parametrize("name", some(EVERY))
def test_one_move_before_the_rise_and_none_until_it(name: str) -> None:
    path = path_of(name)
    order = plan_flight(name, path, Antenna(FULL, AZIMUTH, ELEVATION, (0.0, 0.0)), path.begin_s - 120).order
    for plan in (order.azimuth, order.elevation):
        assert sum(step.leave_s < path.begin_s - 5 for step in plan.steps) == 1


def test_a_motor_that_goes_to_angles_gets_the_path_and_no_steps() -> None:
    path = path_of("mid-1-iss")
    order = plan_flight("iss", path, Antenna(FULL, MOTEUS, MOTEUS, (0.0, 0.0)), path.begin_s).order
    assert (order.azimuth.steps, order.elevation.steps) == ((), ())
    azimuth_deg, elevation_deg = path.direction(path.begin_s + 100.0)
    assert math.remainder(order.azimuth.angles_deg[200] - azimuth_deg, 360) == pytest.approx(0.0, abs=1e-6)
    assert order.elevation.angles_deg[200] == pytest.approx(elevation_deg)


def test_while_azimuth_turns_back_near_the_zenith_elevation_goes_up_to_meet_the_target() -> None:
    """From north-north-west to south-south-east, up to 85° in the east-north-east: it crosses north near the zenith."""
    rows = tuple(
        (float(second), azimuth_deg, elevation_deg)
        for second in range(601)
        for azimuth_deg, elevation_deg in [_overhead(second - 300.0)]
    )
    path = KnownPath(rows)
    mount = Mount(Range(0.0, 360.0), Range(0.0, 90.0))
    plan = plan_flight("overhead", path, Antenna(mount, AZIMUTH, ELEVATION, (0.0, 0.0)), -120.0)
    change = plan.route.legs[1]
    during = slice(round(change.look * STEP_S / PLAN_STEP_S), round(change.arrival * STEP_S / PLAN_STEP_S))
    highest_deg = max(plan.order.elevation.angles_deg[during])
    assert highest_deg > max(elevation_deg for _, _, elevation_deg in rows) + 1.0
    assert plan.route.lost_s == 0.0


def _overhead(from_top_s: float) -> tuple[float, float]:
    """A great circle that comes within 5° of the zenith, to its east, at 0.25°/s and slower near the horizon."""
    along = math.radians(85.0 * math.sin(math.radians(from_top_s * 0.3)))
    east, north, up = math.sin(math.radians(5.0)), -math.sin(along), math.cos(along)
    across = math.cos(math.radians(5.0))
    return (math.degrees(math.atan2(east, north * across)) - 20.0) % 360.0, math.degrees(math.asin(up * across))
