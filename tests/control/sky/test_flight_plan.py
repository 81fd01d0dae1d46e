"""A pass planned whole: what the order holds, for antennas anywhere and passes that have begun already."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount
from tests.control.sky.test_ways import EVERY, FULL, OVER, SATELLITES, SINGLE, path_of
from tests.search import some

AZIMUTH, ELEVATION = PlannedMotor(6.0, 0.17, 4.0), PlannedMotor(2.7, 0.17, 4.0)
MOTEUS = PlannedMotor(30.0, 0.0, 0.2, switched=False)


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
