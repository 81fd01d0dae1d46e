"""A timed table that names its turns: which tables do, the curve between their rows, and where the axes go for them."""

from __future__ import annotations

import pytest

from rotator.control.sky.known_path import Row
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.control.sky.named_turns import axis_rows, names_turns, on_the_sky, smooth_turns
from rotator.control.sky.timed_table import TimedTable
from tests.tables import every_row

MOUNT = Mount(
    Range(0.0, 450.0), Range(0.0, 180.0), sectors=(Sector("mast", Range(200.0, 210.0), Range(0.0, 60.0), 2.0),)
)


@pytest.mark.parametrize(
    ("row", "names"),
    [((5.0, 360.0, 90.0), False), ((5.0, 360.5, 0.0), True), ((5.0, 0.0, 90.5), True), ((500.0, 0.0, -5.0), False)],
)
def test_one_azimuth_above_360_or_one_elevation_above_90_names_turns(row: Row, names: bool) -> None:
    assert names_turns([(0.0, 10.0, 10.0), row]) is names


def test_the_curve_goes_through_every_row_with_a_point_each_second() -> None:
    rows = [(0.0, 340.0, 10.0), (4.0, 360.0, 20.0), (5.0, 364.0, 22.0), (8.5, 370.0, 91.0)]
    found = smooth_turns(rows)
    assert [row[0] for row in found] == pytest.approx([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 8.5])
    assert set(rows) <= set(found)


def test_a_steady_turn_stays_straight_through_north_and_over_the_top() -> None:
    rows = [(10.0 * at, 340.0 + 15.0 * at, 60.0 + 10.0 * at) for at in range(7)]
    for at_s, azimuth_deg, elevation_deg in smooth_turns(rows):
        assert (azimuth_deg, elevation_deg) == pytest.approx((340.0 + 1.5 * at_s, 60.0 + 1.0 * at_s))


def test_between_rows_the_speed_is_that_from_the_row_before_to_the_row_after() -> None:
    """Azimuth as the square of time: a curve through three of its points is that square again."""
    rows = [(10.0 * at, 370.0 + float(at * at), 0.0) for at in range(5)]
    inner = [row for row in smooth_turns(rows) if 10.0 <= row[0] <= 30.0]
    assert len(inner) == 21
    for at_s, azimuth_deg, _ in inner:
        assert azimuth_deg == pytest.approx(370.0 + (at_s / 10.0) ** 2)


def test_no_point_is_beyond_the_least_and_the_greatest_angle_of_the_table() -> None:
    """Up to the end stop and back: a curve would swing beyond it."""
    rows = [(0.0, 400.0, 10.0), (10.0, 450.0, 0.0), (20.0, 450.0, 0.0), (30.0, 400.0, 10.0)]
    found = smooth_turns(rows)
    assert max(row[1] for row in found) == 450.0
    assert min(row[2] for row in found) == 0.0


def rows_of(*points: Row) -> tuple[Row, ...] | str:
    return axis_rows(TimedTable("turns", points, tuple(range(2, 2 + len(points)))), points, MOUNT)


def test_the_axes_go_where_the_table_says() -> None:
    points = (0.0, 430.0, 10.0), (10.0, 450.0, 90.0), (20.0, 440.0, 180.0)
    assert rows_of(*points) == points


def test_below_the_horizon_the_elevation_rests() -> None:
    assert rows_of((0.0, 430.0, -5.0)) == ((0.0, 430.0, 0.0),)


@every_row(
    ("point", "said"),
    [
        ((10.0, 460.0, 20.0), "line 3: azimuth 460.0°, elevation 20.0° is outside the rotor's azimuth range of 0° to"),
        ((10.0, -20.0, 95.0), "line 3: azimuth -20.0°, elevation 95.0° is outside the rotor's azimuth range of 0° to"),
        ((10.0, 400.0, 180.1), "is above the rotor's elevation range, which ends at 180°"),
        ((10.0, 205.0, 60.0), "is in a forbidden sector, or in its margin"),
        ((10.0, 198.5, 61.5), "is in a forbidden sector, or in its margin"),
    ],
)
def test_what_the_antenna_cannot_do_is_said_with_the_line(point: Row, said: str) -> None:
    found = rows_of((0.0, 430.0, 10.0), point)
    assert isinstance(found, str)
    assert said in found


def test_a_table_may_pass_close_to_the_margin_of_a_sector() -> None:
    assert isinstance(rows_of((0.0, 197.9, 30.0), (10.0, 205.0, 62.1)), tuple)


@pytest.mark.parametrize(
    ("row", "shown"),
    [
        ((7.0, 430.0, 10.0), (7.0, 70.0, 10.0)),
        ((7.0, 430.0, 100.0), (7.0, 250.0, 80.0)),
        ((7.0, 200.0, 90.0), (7.0, 200.0, 90.0)),
        ((7.0, 200.0, 180.0), (7.0, 20.0, 0.0)),
    ],
)
def test_displays_show_the_direction_on_the_sky(row: Row, shown: Row) -> None:
    assert on_the_sky(row) == shown
