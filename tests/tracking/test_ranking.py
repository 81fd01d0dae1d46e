"""From an order that a person drags to priorities: the order holds, and the scale of the configuration stays."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import example, given
from hypothesis import strategies as st

from rotator.store.priorities import MOST_PRIORITY, ranked
from tests.tables import every_row


@every_row(
    ("written", "expected"),
    [
        ([10, 1, 5], [10, 5, 1]),
        ([1, 1, 1], [3, 2, 1]),
        ([0.5, 0.5, 8], [8, 1.5, 0.5]),
        ([1000, 1000], [1000, 999.000999]),
        ([0.001, 0.0010000000000000002], [1.001, 0.001]),
        ([7], [7]),
        ([], []),
    ],
)
def test_the_numbers_stay_and_equal_ones_part(written: list[float], expected: list[float]) -> None:
    assert ranked(written) == expected


@example([0.001, 0.0010001, *[1000.0] * 98])
@given(st.lists(st.floats(0.001, MOST_PRIORITY), min_size=1, max_size=100))
def test_each_place_counts_more_than_the_next_within_the_bounds_of_the_file(written: list[float]) -> None:
    places = ranked(written)
    assert all(upper > lower for upper, lower in pairwise(places))
    assert places[-1] > 0
    assert places[0] <= MOST_PRIORITY
