"""Calibration by the two ends of the range: either end first, and nothing before both are known."""

from __future__ import annotations

import pytest

from rotator.control.axis.calibration_table import Calibration, EndCalibration
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Missing

RANGE = Range(-10.0, 440.0)
EVERYTHING = (Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK)


def uncalibrated() -> EndCalibration:
    return EndCalibration(RANGE, EVERYTHING, None)


def test_low_end_then_high_end() -> None:
    ends = uncalibrated()
    assert ends.take(0.1, None, high_end=False) is None
    assert ends.missing == EVERYTHING, "one end is no calibration"
    assert ends.take(0.9, None, high_end=True) == Calibration(((0.1, -10.0), (0.9, 440.0)))
    assert ends.missing == (Missing.LIMITS, Missing.DIRECTION_CHECK), "the rest is still missing"


def test_high_end_then_low_end() -> None:
    ends = uncalibrated()
    assert ends.take(0.9, None, high_end=True) is None
    assert ends.take(0.1, None, high_end=False) == Calibration(((0.1, -10.0), (0.9, 440.0)))


def test_a_pot_wired_the_other_way_round_falls() -> None:
    ends = uncalibrated()
    ends.take(0.9, None, high_end=False)
    assert ends.take(0.1, None, high_end=True) == Calibration(((0.9, -10.0), (0.1, 440.0)))


@pytest.mark.parametrize("high_end", [False, True])
def test_the_same_end_again_takes_the_place_of_the_first(high_end: bool) -> None:
    ends = uncalibrated()
    ends.take(0.3 if high_end else 0.5, None, high_end=high_end)
    assert ends.take(0.9 if high_end else 0.1, None, high_end=high_end) is None
    found = ends.take(0.1 if high_end else 0.9, None, high_end=not high_end)
    assert found == Calibration(((0.1, -10.0), (0.9, 440.0)))


def test_two_readings_of_one_place_are_no_two_ends() -> None:
    ends = uncalibrated()
    ends.take(0.50, None, high_end=False)
    with pytest.raises(ValueError, match="too close"):
        ends.take(0.52, None, high_end=True)
    assert ends.missing == EVERYTHING


def test_a_calibrated_axis_keeps_its_curve_and_moves_one_end() -> None:
    before = Calibration(((0.1, -10.0), (0.3, 200.0), (0.9, 440.0)))
    ends = EndCalibration(RANGE, (), before)
    found = ends.take(0.5, before, high_end=True)
    assert found is not None
    assert found.points == (
        (pytest.approx(0.1), -10.0),
        (pytest.approx(0.2), 200.0),
        (pytest.approx(0.5), 440.0),
    )
    found = ends.take(0.5, before, high_end=False)
    assert found is not None
    assert found.points == (
        (pytest.approx(0.5), -10.0),
        (pytest.approx(0.6), 200.0),
        (pytest.approx(0.9), 440.0),
    )


@pytest.mark.parametrize("low_raw", [0.1, 0.9], ids=["rising", "falling"])
@pytest.mark.parametrize(
    ("beyond_deg", "taken"), [(-50.0, True), (0.0, True), (0.9, True), (1.1, False), (40.0, False)]
)
@pytest.mark.parametrize("high_end", [False, True])
def test_an_end_is_taken_up_to_a_degree_beyond_the_calibrated_one(
    high_end: bool, beyond_deg: float, taken: bool, low_raw: float
) -> None:
    """The coast and the noise of the sensor put it so far out; a link never widens the range."""
    given = Calibration(((low_raw, -10.0), (1.0 - low_raw, 440.0)))
    ends = EndCalibration(RANGE, (), given)
    angle_deg = 440.0 + beyond_deg if high_end else -10.0 - beyond_deg
    raw = low_raw + (1.0 - 2.0 * low_raw) * (angle_deg + 10.0) / 450.0
    if taken:
        assert ends.take(raw, given, high_end=high_end) == given.with_end(raw, high_end=high_end)
    else:
        with pytest.raises(ValueError, match=f"stands at {angle_deg:.1f}°, outside of its calibrated -10 to 440"):
            ends.take(raw, given, high_end=high_end)
