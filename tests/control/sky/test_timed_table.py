"""A table of directions: smooth between its rows, and refused where the rotor cannot point."""

from __future__ import annotations

from itertools import pairwise

import pytest

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.control.sky.timed_table import TimedTable, hindrance, smooth
from rotator.rehearsal.passes import SHIPPED, read_pass
from tests.tables import every_row

WIDE = Mount(Range(0, 450), Range(0, 180))
PASSES = sorted(SHIPPED.glob("*.csv"))


@every_row("shipped", PASSES)
def test_rows_of_a_pass_ten_seconds_apart_are_enough(shipped: str) -> None:
    """A straight line between them would be off by more than 1° on most passes."""
    flown = read_pass(SHIPPED / shipped)
    curve = KnownPath(smooth(flown.rows[::10]))
    errors_deg = [great_circle_deg(*curve.direction(t_s), az, el) for t_s, az, el in flown.rows if t_s <= curve.end_s]
    assert max(errors_deg) < 0.25


def test_the_curve_goes_through_every_row_and_rises_in_time() -> None:
    rows = ((0.0, 350.0, 10.0), (7.5, 10.0, 60.0), (7.9, 11.0, 61.0), (30.0, 190.0, 80.0))
    curve = smooth(rows)
    assert [row for row in curve if row in rows] == list(rows)
    assert all(0 < after[0] - before[0] <= 1.0 for before, after in pairwise(curve))


def test_a_target_that_stands_stands() -> None:
    assert all(row[1:] == pytest.approx((40.0, 20.0)) for row in smooth(((0.0, 40.0, 20.0), (600.0, 40.0, 20.0))))


def table(*rows: tuple[float, float, float]) -> TimedTable:
    return TimedTable("test", rows, tuple(range(2, 2 + len(rows))))


def said(mount: Mount, *rows: tuple[float, float, float]) -> str:
    one = table(*rows)
    return hindrance(one, smooth(one.rows), mount)


def test_what_the_rotor_reaches_is_not_hindered() -> None:
    assert said(WIDE, (0, 350, -5), (20, 10, 5), (40, 30, 90), (60, 170, 60)) == ""
    low = Mount(Range(0, 360), Range(10, 90), horizon=((0.0, 5.0), (180.0, 20.0)))
    assert said(low, (0, 90, 0), (10, 95, 12)) == ""


@pytest.mark.parametrize(
    ("mount", "told"),
    [
        (Mount(Range(0, 180), Range(0, 90)), "is outside the rotor's azimuth range of 0° to 180°"),
        (Mount(Range(0, 360), Range(0, 60)), "is above the rotor's elevation range, which ends at 60°"),
        (
            Mount(Range(0, 360), Range(0, 90), sectors=(Sector("mast", Range(185, 195), Range(0, 90), 2.0),)),
            "is in a forbidden sector, or in its margin",
        ),
    ],
)
def test_the_first_line_that_the_rotor_cannot_follow_is_named(mount: Mount, told: str) -> None:
    words = said(mount, (0, 100, 30), (10, 120, 40), (20, 178, 55), (30, 200, 70))
    assert words.startswith("line 4: azimuth 1")
    assert words.endswith(told)


def test_on_another_turn_or_over_the_top_there_may_be_no_sector() -> None:
    mast = Sector("mast", Range(20, 40), Range(0, 90), 2.0)
    assert said(Mount(Range(0, 450), Range(0, 90), sectors=(mast,)), (0, 25, 10), (10, 35, 10)) == ""
    half = Mount(Range(0, 180), Range(0, 180), flip=True)
    assert said(half, (0, 200, 30), (10, 210, 30)) == ""
