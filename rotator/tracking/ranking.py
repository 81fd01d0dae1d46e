"""The priorities that belong to an order: what a person drags further up counts more than what stands below it.

Knows numbers alone. The numbers of the configuration keep their places in the list and the names move, so its scale
stays: 10, 5, 1 stay 10, 5, 1. Two equal numbers would leave the order without a meaning: the upper one becomes larger.
"""

from __future__ import annotations

from collections.abc import Sequence

MOST = 1000.0
"""Beyond this all numbers shrink by one factor: only their ratios count."""


def ranked(priorities: Sequence[float]) -> list[float]:
    """From the priorities of all targets, in any order, to those of the places from the first to the last."""
    places = sorted(priorities)
    for index in range(1, len(places)):
        if places[index] <= places[index - 1]:
            places[index] = places[index - 1] + 1.0
    shrink = MOST / max(MOST, *places) if places else 1.0
    return [round(each * shrink, 6) for each in reversed(places)]
