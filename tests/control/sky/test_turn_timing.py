"""A turn near the zenith begins at its best moment, however the path lies to the moments at which ways are chosen."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from rotator.control.sky.flight_plan import Antenna, PlannedMotor, plan_flight
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import STEP_S

LOW = Mount(Range(0.0, 450.0), Range(0.0, 90.0))
SPEED_DPS = 6.0
TOP_S = 300.0


def overhead(beside_deg: float) -> KnownPath:
    """From the south-south-east to the north-north-west, so near to the zenith, at 1°/s there."""
    rows = []
    for second in range(601):
        along = math.radians(85.0 * math.sin(math.radians((second - TOP_S) * 0.3)))
        east, north, up = math.sin(math.radians(beside_deg)), math.sin(along), math.cos(along)
        across = math.cos(math.radians(beside_deg))
        azimuth_deg = (math.degrees(math.atan2(east, north * across)) - 20.0) % 360.0
        rows.append((float(second), azimuth_deg, math.degrees(math.asin(up * across))))
    return KnownPath(tuple(rows))


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
