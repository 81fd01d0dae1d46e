"""The line through the readings: how fast an axis turns, and how much the readings scatter."""

from __future__ import annotations

import random

import pytest

from benchmarks.weld_world import Lens
from rotator.control.axis.trend import Trend

STEP_S = 0.05
NOISES_DEG = pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.4])


@NOISES_DEG
def test_noise_is_measured_at_rest_and_in_any_motion(noise_deg: float) -> None:
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


@pytest.mark.parametrize("off_deg", [-3.0, 2.6, 3.0])
@pytest.mark.parametrize("number", range(30, 60, 4))
@pytest.mark.parametrize("speed_dps", [0.0, 6.0])
def test_one_reading_that_is_off_tilts_no_line(off_deg: float, number: int, speed_dps: float) -> None:
    """A bad reading that is too near to be seen at once shows itself by the next one."""
    chance, trend = random.Random(number), Trend()
    for count in range(61):
        angle_deg = speed_dps * count * STEP_S + chance.gauss(0.0, 0.1)
        assert trend.see(count * STEP_S, angle_deg + (off_deg if count == number else 0.0), 6.0)
    slope = trend.slope(30 * STEP_S)
    assert slope is not None
    assert slope.speed_dps == pytest.approx(speed_dps, abs=4.0 * slope.error_dps)


@NOISES_DEG
def test_an_axis_that_turns_and_stops_at_once_loses_no_reading(noise_deg: float) -> None:
    chance, trend = random.Random(5), Trend()
    for count in range(200):
        turned_deg = 10.0 * STEP_S * abs(count % 40 - 20)
        trend.see(count * STEP_S, turned_deg + chance.gauss(0.0, noise_deg), 10.0)
    assert len(trend._kept) == round((trend.last_s - trend.since_s) / STEP_S) + 1, "every 0.05 s"


@pytest.mark.parametrize(
    ("averaged", "low_pass_s", "delayed"), [(1, 0.0, 0), (4, 0.0, 0), (7, 0.0, 0), (1, 0.1, 0), (4, 0.0, 4)]
)
@pytest.mark.parametrize("speed_dps", [0.0, 6.0])
def test_a_line_is_as_exact_as_it_says_though_the_sensor_averages(
    averaged: int, low_pass_s: float, delayed: int, speed_dps: float
) -> None:
    """Readings that share their time differ less from one to the next than they are off."""
    lens = Lens(averaged, low_pass_s, delayed)
    chance, trend, off = random.Random(8), Trend(lens.behind_s(STEP_S)), []
    for count in range(4000):
        at_s = count * STEP_S
        trend.see(at_s, lens.see(speed_dps * at_s + chance.gauss(0.0, 0.1), STEP_S), speed_dps)
        slope = trend.slope(at_s - 2.0)
        if count > 200 and slope is not None:
            off.append((slope.speed_dps - speed_dps) / slope.error_dps)
    assert sum(each**2 for each in off) / len(off) < 1.5
