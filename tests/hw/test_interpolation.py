"""Straight lines between points: both ways, beyond the ends or clamped to them, and tables that are refused."""

from __future__ import annotations

import math

import pytest

from hw.interpolation import PiecewiseLinear
from tests.tables import every_row

RISING = PiecewiseLinear(((0.0, 520.0), (90.0, 1470.0), (180.0, 2480.0)))
FALLING = PiecewiseLinear(((0.0, 0.95), (200.0, 0.5), (450.0, 0.05)))
TABLES = pytest.mark.parametrize("table", [RISING, FALLING], ids=["rising", "falling"])


@pytest.mark.parametrize(("table", "x", "y"), [(RISING, 45.0, 995.0), (FALLING, 100.0, 0.725), (FALLING, 325.0, 0.275)])
def test_between_two_points_the_line_is_straight(table: PiecewiseLinear, x: float, y: float) -> None:
    assert (table.at(x), table.inverse(y)) == pytest.approx((y, x))


@pytest.mark.parametrize(
    ("x", "y"), [(-10.0, 520.0 - 10 * 950 / 90), (190.0, 2480.0 + 10 * 1010 / 90)], ids=["below", "above"]
)
def test_beyond_an_end_the_last_line_goes_on(x: float, y: float) -> None:
    assert (RISING.at(x), RISING.inverse(y)) == pytest.approx((y, x))


@TABLES
def test_clamped_nothing_is_beyond_an_end(table: PiecewiseLinear) -> None:
    (low_x, low_y), (high_x, high_y) = table.points[0], table.points[-1]
    assert [table.at(x, clamp=True) for x in (-1e6, 1e6)] == pytest.approx([low_y, high_y])
    ends_x = [table.inverse(y, clamp=True) for y in (-1e6, 1e6)]
    assert ends_x == pytest.approx([low_x, high_x] if low_y < high_y else [high_x, low_x])


@every_row(
    ("points", "why"),
    [
        ((), "two points or more"),
        (((0.0, 1.0),), "two points or more"),
        (((0.0, 1.0), (0.0, 2.0)), "angles must rise from point to point"),
        (((9.0, 1.0), (0.0, 2.0)), "angles must rise from point to point"),
        (((math.nan, 1.0), (9.0, 2.0)), "angles must rise from point to point"),
        (((0.0, 1.0), (9.0, 1.0)), "readings must rise, or fall, all the way"),
        (((0.0, 1.0), (4.0, 3.0), (9.0, 2.0)), "readings must rise, or fall, all the way"),
        (((0.0, 1.0), (9.0, math.nan)), "readings must rise, or fall, all the way"),
    ],
)
def test_a_table_that_is_not_monotonic_is_refused(points: tuple[tuple[float, float], ...], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        PiecewiseLinear(points, "angles", "readings")
