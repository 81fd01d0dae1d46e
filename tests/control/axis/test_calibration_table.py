"""From a pot's reading to degrees: straight lines between points, ends found again, nonsense refused."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.axis.calibration_table import Calibration, between_ends

STRAIGHT = Calibration(((0.05, 0.0), (0.95, 450.0)))
BOWED = Calibration(((0.1, 0.0), (0.4, 200.0), (0.9, 450.0)))
FALLING = Calibration(((0.95, 0.0), (0.5, 200.0), (0.05, 450.0)))


@pytest.mark.parametrize("table", [STRAIGHT, BOWED, FALLING], ids=["straight", "bowed", "falling"])
def test_each_point_reads_as_itself(table: Calibration) -> None:
    assert [table.degrees(raw) for raw, _ in table.points] == pytest.approx([deg for _, deg in table.points])


@pytest.mark.parametrize(
    ("table", "raw", "degrees"),
    [
        (STRAIGHT, 0.5, 225.0),
        (BOWED, 0.25, 100.0),
        (BOWED, 0.65, 325.0),
        (FALLING, 0.725, 100.0),
        (FALLING, 0.275, 325.0),
    ],
)
def test_between_points_the_line_is_straight(table: Calibration, raw: float, degrees: float) -> None:
    assert table.degrees(raw) == pytest.approx(degrees)


def test_beyond_the_ends_the_last_line_goes_on() -> None:
    assert BOWED.degrees(0.07) == pytest.approx(-20.0)
    assert BOWED.degrees(0.92) == pytest.approx(460.0)
    assert FALLING.degrees(0.0) == pytest.approx(450.0 + 0.05 * 250 / 0.45)


@given(st.sampled_from([STRAIGHT, BOWED, FALLING]), st.floats(0, 1), st.floats(0, 1))
def test_it_never_turns_back(table: Calibration, a: float, b: float) -> None:
    rising = table.points[0][0] < table.points[-1][0]
    low, high = sorted((a, b), reverse=not rising)
    assert table.degrees(low) <= table.degrees(high) + 1e-9


@pytest.mark.parametrize(
    ("points", "why"),
    [
        (((0.1, 0.0),), "two points or more"),
        ((), "two points or more"),
        (((0.1, 10.0), (0.9, 10.0)), "degrees must rise"),
        (((0.9, 450.0), (0.1, 0.0)), "degrees must rise"),
        (((0.1, 0.0), (0.5, 100.0), (0.4, 450.0)), "rise, or fall, all the way"),
        (((0.1, 0.0), (0.1, 450.0)), "rise, or fall, all the way"),
        (((0.1, 0.0), (math.nan, 450.0)), "rise, or fall, all the way"),
    ],
)
def test_a_table_that_is_no_curve_is_refused(points: tuple[tuple[float, float], ...], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        Calibration(points)


# --- two ends


def test_one_place_measured_twice_is_no_two_ends() -> None:
    with pytest.raises(ValueError, match=r"the ends read 0\.500 and 0\.540: too close"):
        between_ends(0.5, 0.0, 0.54, 450.0)


@pytest.mark.parametrize(("high_end", "raw"), [(False, 0.15), (True, 0.8)])
def test_an_end_found_again_stretches_the_curve_and_keeps_its_shape(high_end: bool, raw: float) -> None:
    table = BOWED.with_end(raw, high_end=high_end)
    assert table.degrees(raw) == pytest.approx(450.0 if high_end else 0.0)
    other = 0.1 if high_end else 0.9
    assert table.degrees(other) == pytest.approx(0.0 if high_end else 450.0)
    shares = [(r - table.points[0][0]) / (table.points[-1][0] - table.points[0][0]) for r, _ in table.points]
    assert shares == pytest.approx([0.0, 0.375, 1.0])


def test_a_falling_curve_stretches_alike() -> None:
    table = FALLING.with_end(0.9, high_end=False)
    assert table.degrees(0.9) == pytest.approx(0.0)
    assert table.degrees(0.05) == pytest.approx(450.0)


@pytest.mark.parametrize(("raw", "high_end"), [(0.12, True), (0.05, True), (0.88, False), (0.95, False)])
def test_ends_too_close_or_swapped_are_refused(raw: float, high_end: bool) -> None:
    with pytest.raises(ValueError, match="too close, or the wrong way round"):
        BOWED.with_end(raw, high_end=high_end)
