"""A turn near the zenith begins at its best moment, however the path lies to the moments at which ways are chosen."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import LOST_DEG, STEP_S, Flown, Speeds
from rotator.control.sky.turn_timing import change_of
from rotator.control.sky.turning import Turning, turned_deg
from rotator.control.sky.ways import Leg, possible_ways
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan
from tests.control.sky.test_ways import SATELLITES, SINGLE
from tests.tables import every_row

LOW = Mount(Range(0.0, 450.0), Range(0.0, 90.0))
HALF = Mount(Range(0.0, 180.0), Range(0.0, 180.0), flip=True)
"""Two servos of 180°: the other half of the sky is over the top."""
SPEED_DPS = 6.0
SERVO_DPS = 50.0
EVERY_S = 0.02
TOP_S = 300.0


def overhead(beside_deg: float, faster: float = 1.0) -> KnownPath:
    """From the south-south-east to the north-north-west, so near to the zenith, at 0.45°/s there, or faster."""
    rows = []
    for second in range(601):
        along = math.radians(85.0 * math.sin(math.radians((second - TOP_S) * 0.3)))
        east, north, up = math.sin(math.radians(beside_deg)), math.sin(along), math.cos(along)
        across = math.cos(math.radians(beside_deg))
        azimuth_deg = (math.degrees(math.atan2(east, north * across)) - 20.0) % 360.0
        rows.append((second / faster, azimuth_deg, math.degrees(math.asin(up * across))))
    return KnownPath(tuple(rows))


@given(
    path=SATELLITES,
    mount=st.sampled_from([LOW, HALF, SINGLE]),
    speeds=st.builds(Speeds, st.floats(0.2, 30.0), st.floats(0.2, 30.0)),
    stepped=st.booleans(),
    shares=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
)
def test_no_turn_begins_before_its_look_also_where_the_end_of_the_pass_cuts_it_short(
    path: KnownPath, mount: Mount, speeds: Speeds, stepped: bool, shares: tuple[float, float]
) -> None:
    """A moment before the path's first would be an index from its end: an IndexError, or elevation's last angles."""
    begun, leaves = shares
    begin_s = path.begin_s + begun * (path.end_s - path.begin_s)
    looks, directions = path.directions(begin_s, STEP_S), path.directions(begin_s, PLAN_STEP_S)
    look = int(leaves * (len(looks) - 1))
    ways = [Flown(mount, looks, way) for way in possible_ways(mount, looks[0])]
    for here, there in pairwise(ways):
        arrival = Turning(mount, looks, speeds).change(here, there, look)
        legs = Leg(0, min(look, 1), here), Leg(look, arrival, there)
        change = change_of(mount, directions, legs, speeds, stepped=stepped)
        assert change.leaves_s >= max(0.0, (look - 1) * STEP_S)


@pytest.mark.long
@pytest.mark.parametrize("beside_deg", [3.0, 5.0, 7.0])
def test_the_turn_has_its_middle_at_the_culmination(beside_deg: float) -> None:
    path = overhead(beside_deg)
    motors = PlannedMotor(SPEED_DPS, 0.0, 4.0), PlannedMotor(2.7, 0.0, 4.0)
    off_s = []
    for late in range(10):
        begin_s = late * STEP_S / 10
        # The pass has begun already: the ways are chosen at other moments of it.
        steps = plan_flight("overhead", path, Antenna(LOW, *motors, (160.0, 5.0)), begin_s).order.azimuth.steps
        turned = [(abs(b.place_deg - a.place_deg), b) for a, b in pairwise(steps)]
        by_deg, step = max(turned, key=lambda each: each[0])
        assert by_deg > 90.0
        off_s.append(step.leave_s + by_deg / SPEED_DPS / 2 - TOP_S)
    assert max(off_s) - min(off_s) < 1.5
    assert max(map(abs, off_s)) < 2.0


@pytest.mark.long
@every_row("beside_deg", [1.0, 4.0, 7.0, 9.0])
@every_row("late_s", [0.0, 1.5, 3.0])
def test_servos_of_180_degrees_lose_no_second_under_a_target_within_9_degrees_of_the_zenith(
    beside_deg: float, late_s: float
) -> None:
    """They turn to the other half of the sky through the zenith, and not before the target is near it."""
    motor = PlannedMotor(SERVO_DPS, 0.0, 1.0, switched=False)
    assert _worst_deg(overhead(beside_deg), Antenna(HALF, motor, motor, (160.0, 0.0)), late_s, over=True) <= LOST_DEG


@pytest.mark.long
@pytest.mark.parametrize("beside_deg", [-0.2, -1.0, -2.0])
def test_a_slow_motor_without_relays_leads_a_target_near_the_zenith(beside_deg: float) -> None:
    """A digital pot: azimuth turns half round for 30 s, the first half of it before the culmination."""
    motor = PlannedMotor(SPEED_DPS, 0.0, 2.0, switched=False)
    assert _worst_deg(overhead(beside_deg, 1.5), Antenna(LOW, motor, motor, (160.0, 5.0)), 0.0, over=False) <= 6.0


def _worst_deg(path: KnownPath, antenna: Antenna, from_s: float, *, over: bool) -> float:
    """The greatest error of motors that follow the plan as fast as they can. `over`: it goes over the top."""
    order = plan_flight("overhead", path, antenna, from_s).order
    assert (max(order.elevation.angles_deg) > 90.0) is over
    (azimuth_deg, elevation_deg), worst_deg = _places(order.azimuth, order.elevation, from_s), 0.0
    now_s, by_deg = from_s, antenna.azimuth.speed_dps * EVERY_S
    while now_s < path.end_s:
        now_s += EVERY_S
        wanted_deg = _places(order.azimuth, order.elevation, now_s)
        azimuth_deg = turned_deg(azimuth_deg, wanted_deg[0], by_deg)
        elevation_deg = turned_deg(elevation_deg, wanted_deg[1], by_deg)
        worst_deg = max(worst_deg, great_circle_deg(azimuth_deg, elevation_deg, *path.direction(now_s)))
    return worst_deg


def _places(azimuth: AxisPlan, elevation: AxisPlan, now_s: float) -> tuple[float, float]:
    """Where both motors are sent: between two moments of the plan on a straight line."""
    place = (now_s - azimuth.begin_s) / PLAN_STEP_S
    before, last = int(place), len(azimuth.angles_deg) - 1
    share, now, then = place - before, min(before, last), min(before + 1, last)
    azimuth_deg, elevation_deg = (
        plan.angles_deg[now] * (1 - share) + plan.angles_deg[then] * share for plan in (azimuth, elevation)
    )
    return azimuth_deg, elevation_deg
