"""What a plan knows of the running box: its motors as they were learnt, in place of what the file says."""

from __future__ import annotations

import pytest

from tests.tracking.tracked_box import FEBRUARY_S, Box


def test_the_plan_knows_the_motors_as_learnt() -> None:
    """The file says 6°/s; this motor does 4.5."""
    box = Box(FEBRUARY_S, follow="[sim.azimuth]\nspeed_dps = 4.5\n")
    before = box.tracked.antenna()
    assert before is not None
    assert before.azimuth.speed_dps == pytest.approx(6.0)
    assert box.tracker.track("200 30") == ""
    box.wait(60.0)
    after = box.tracked.antenna()
    assert after is not None
    assert 4.5 < after.azimuth.speed_dps < 5.9, "one run, in one direction, has been seen"
    assert after.elevation.speed_dps == pytest.approx(2.7, abs=0.2)
    assert 0.0 < after.azimuth.coast_s < 0.5
