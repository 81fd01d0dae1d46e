"""The line through the readings: how fast an axis turns, and how much the readings scatter."""

from __future__ import annotations

import random

import pytest

from rotator.control.axis.trend import Trend

STEP_S = 0.05
NOISES_DEG = pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.4])


@NOISES_DEG
def test_noise_is_measured_whatever_the_axis_does(noise_deg: float) -> None:
    chance, trend = random.Random(3), Trend()
    for count in range(400):
        trend.see(count * STEP_S, 6.0 * count * STEP_S + chance.gauss(0.0, noise_deg), 6.0)
    assert trend.noise_deg == pytest.approx(max(noise_deg, 0.02), rel=0.4)
    slope = trend.slope(400 * STEP_S - 2.0)
    assert slope is not None
    assert slope.speed_dps == pytest.approx(6.0, abs=max(4.0 * slope.error_dps, 1e-6))


def test_after_a_gap_the_line_begins_anew() -> None:
    trend = Trend()
    for at_s in (0.0, 0.05, 0.1, 0.15, 2.0):
        trend.see(at_s, 10.0, 6.0)
    assert trend.since_s == 2.0
    assert trend.slope(0.0) is None
