"""Linear equations: solved as numpy solves them, and what has no single solution."""

from __future__ import annotations

import numpy as np
import pytest

from rotator.control.sky.equations import solved


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("unknowns", [1, 2, 3, 6])
def test_they_are_solved_as_numpy_solves_them(seed: int, unknowns: int) -> None:
    draw = np.random.default_rng(seed)
    rows = draw.normal(size=(24, unknowns))
    matrix, side = rows.T @ rows, draw.normal(size=unknowns)
    assert solved(matrix.tolist(), side.tolist()) == pytest.approx(np.linalg.solve(matrix, side).tolist())


def test_what_is_given_is_not_changed() -> None:
    matrix, side = [[4.0, 2.0], [2.0, 3.0]], [8.0, 7.0]
    assert solved(matrix, side) == pytest.approx([1.25, 1.5])
    assert (matrix, side) == ([[4.0, 2.0], [2.0, 3.0]], [8.0, 7.0])


@pytest.mark.parametrize("matrix", [[[0.0]], [[1.0, 1.0], [1.0, 1.0]], [[1.0, 0.0], [0.0, 0.0]]])
def test_an_unknown_that_counts_for_nothing_has_no_value(matrix: list[list[float]]) -> None:
    with pytest.raises(ZeroDivisionError):
        solved(matrix, [1.0] * len(matrix))
