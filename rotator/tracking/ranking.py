"""The priorities for an order of targets: the higher a person drags a target, the more it counts.

Knows only numbers. The numbers of the configuration keep their places in the list and only the names move, so the
scale stays: 10, 5, 1 stay 10, 5, 1. Of two equal numbers the upper one becomes larger, so that the order counts; two
that the file's six decimals would hardly tell apart are equal.
"""

from __future__ import annotations

from collections.abc import Sequence

MOST = 1000.0
"""The largest priority. Beyond it all numbers shrink by one factor, because only their ratios count."""

EQUAL_WITHIN = 1e-4
"""Two numbers this close are equal: after the shrinking and the six decimals they could be one number."""


def ranked(priorities: Sequence[float]) -> list[float]:
    """The priority of each place in the list, from the first on. `priorities`: of all targets, in any order."""
    places = sorted(priorities)
    for index in range(1, len(places)):
        if places[index] < places[index - 1] + EQUAL_WITHIN:
            places[index] = places[index - 1] + 1.0
    shrink = MOST / max(MOST, *places) if places else 1.0
    return [round(each * shrink, 6) for each in reversed(places)]
