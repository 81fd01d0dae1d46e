"""A path that is known to its end: the rows themselves, straight on between them, and what is no path."""

from __future__ import annotations

import pytest

from rotator.control.sky.known_path import KnownPath, Row
from tests.tables import every_row

PATH = KnownPath(((100.0, 350.0, 10.0), (110.0, 20.0, 40.0), (130.0, 10.0, 20.0)))


@every_row(
    ("at_s", "direction"),
    [
        (99.0, (350.0, 10.0)),
        (100.0, (350.0, 10.0)),
        (104.0, (2.0, 22.0)),
        (110.0, (20.0, 40.0)),
        (120.0, (15.0, 30.0)),
        (130.0, (10.0, 20.0)),
        (500.0, (10.0, 20.0)),
    ],
)
def test_between_two_rows_it_goes_the_short_way_and_beyond_them_it_stands(
    at_s: float, direction: tuple[float, float]
) -> None:
    assert PATH.direction(at_s) == pytest.approx(direction)


@every_row(("from_s", "count"), [(100.0, 7), (101.0, 6), (130.0, 1), (131.0, 1), (900.0, 1)])
def test_directions_from_a_moment_to_the_end(from_s: float, count: int) -> None:
    assert PATH.directions(from_s, 5.0) == [PATH.direction(from_s + 5.0 * index) for index in range(count)]


@pytest.mark.parametrize(
    ("rows", "why"),
    [
        ((), "two rows or more"),
        (((0.0, 10.0, 0.0),), "two rows or more"),
        (((0.0, 10.0, 0.0), (0.0, 12.0, 0.0)), "rise from row to row"),
        (((0.0, 10.0, 0.0), (2.0, 12.0, 0.0), (1.0, 12.0, 0.0)), "rise from row to row"),
    ],
)
def test_what_is_no_path_is_refused(rows: tuple[Row, ...], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        KnownPath(rows)
