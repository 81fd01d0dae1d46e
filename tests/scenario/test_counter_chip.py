"""A slew drive whose encoders are too fast for the kernel: an LS7366R counts each, and the whole box points by it."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource, Axis
from tests.scenario.sensed_box import Box

CHIPS = """
[rotor]
type = "h-bridge"
[azimuth]
min_deg = 0
max_deg = 360
[elevation]
max_deg = 90
[bridge]
enable = 4
[bridge.azimuth]
counter = "ls7366r"
counts_per_deg = -3000
[bridge.elevation]
counter = "ls7366r"
counts_per_deg = 3000
"""
"""9000 counts a second at 3° a second: more than twice what the box reads from the kernel."""


def test_it_points_by_the_chips() -> None:
    box = Box(CHIPS)
    assert {box.loop.status.axis(axis).source for axis in Axis} == {AngleSource.COUNTED}
    box.aim(55.0, 28.0, seconds=9.0)
    assert box.world.shafts() == pytest.approx((55.0, 28.0), abs=0.02)
    assert box.loop.status.azimuth.angle_deg == pytest.approx(55.0, abs=0.02)
    assert box.loop.status.faults == ()


def test_a_chip_that_is_gone_stops_both_motors_and_comes_back_without_its_count() -> None:
    box = Box(CHIPS)
    since = box.world.shafts()
    box.aim(80.0, 50.0, seconds=2.0)
    assert min(now - was for now, was in zip(box.world.shafts(), since, strict=True)) > 2.0
    box.world.inject("azimuth-counter-gone")
    box.wait(1.5)
    told = box.loop.status.azimuth.fault
    assert told is not None
    assert "LS7366R (azimuth.select): does not answer" in str(told)
    stood = box.world.shafts()
    assert stood[1] < 40.0
    box.world.clear("azimuth-counter-gone")
    box.wait(2.0)
    assert box.world.shafts() == pytest.approx(stood, abs=0.01)
    assert box.loop.status.azimuth.lost == "its counter chip was without supply, and has lost the count"
