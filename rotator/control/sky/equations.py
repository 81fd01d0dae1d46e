"""Linear equations: as many as there are unknowns, from a sum of squares that is to be least.

Knows numbers alone. Such a matrix is symmetric and positive definite, so no rows need to be exchanged.
"""

from __future__ import annotations

from collections.abc import Sequence


def solved(matrix: Sequence[Sequence[float]], side: Sequence[float]) -> list[float]:
    """By Gauss elimination. Raises ZeroDivisionError where one unknown does not count at all."""
    rows, right = [list(row) for row in matrix], list(side)
    size = len(right)
    for i in range(size):
        for row in range(i + 1, size):
            factor = rows[row][i] / rows[i][i]
            for column in range(i, size):
                rows[row][column] -= factor * rows[i][column]
            right[row] -= factor * right[i]
    solution = [0.0] * size
    for i in reversed(range(size)):
        known = sum(rows[i][j] * solution[j] for j in range(i + 1, size))
        solution[i] = (right[i] - known) / rows[i][i]
    return solution
