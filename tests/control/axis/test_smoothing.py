"""The mean of the latest readings, and when there is one."""

from __future__ import annotations

from rotator.control.axis.smoothing import READINGS, Smoothed


def test_there_is_a_mean_of_five_readings_and_of_the_latest_alone() -> None:
    smoothed = Smoothed()
    for count in range(READINGS):
        assert smoothed.mean_deg is None
        smoothed.see(10.0 * count)
    assert smoothed.mean_deg == 20.0
    smoothed.see(50.0)
    assert smoothed.mean_deg == 30.0
    smoothed.forget()
    assert smoothed.mean_deg is None
