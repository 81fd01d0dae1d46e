"""Solves linear equations, as many as there are unknowns, that come from a least squares fit.

Knows numbers alone. The matrix of such a fit is symmetric and positive definite, so no rows need to be exchanged.
"""

from __future__ import annotations

from collections.abc import Sequence


def solved(matrix: Sequence[Sequence[float]], side: Sequence[float]) -> list[float]:
    """By Gauss elimination. Raises ZeroDivisionError where one unknown does not count at all."""
    rows, right = [list(row) for row in matrix], list(side)
    size = len(right)
    for i in range(size):
        for at in range(i + 1, size):
            factor = rows[at][i] / rows[i][i]
            for column in range(i, size):
                rows[at][column] -= factor * rows[i][column]
            right[at] -= factor * right[i]
    backwards: list[float] = []
    for row, value in zip(reversed(rows), reversed(right), strict=True):
        known = sum(factor * each for factor, each in zip(reversed(row), backwards, strict=False))
        backwards.append((value - known) / row[-1 - len(backwards)])
    return backwards[::-1]
