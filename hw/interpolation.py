"""A table of points with straight lines between them: from a reading to an angle, from an angle to a pulse width.

Knows numbers only: no unit, no device and no axis. It is pure, so that the control code may import it too.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from itertools import pairwise


@dataclass(frozen=True, slots=True)
class PiecewiseLinear:
    """Points (x, y): x strictly rising, y strictly rising or strictly falling, so that the table works both ways.

    `x_name` and `y_name` name the two numbers in an error. Raises ValueError for fewer than two points,
    or an order of points that is not monotonic.
    """

    points: tuple[tuple[float, float], ...]
    x_name: str = field(default="x", compare=False)
    y_name: str = field(default="y", compare=False)
    _backward: tuple[tuple[float, float], ...] = field(init=False, repr=False, compare=False)
    """The same points as (y, x), with y rising."""

    def __post_init__(self) -> None:
        if len(self.points) < 2:
            raise ValueError("needs two points or more")
        steps = [(after[0] - before[0], after[1] - before[1]) for before, after in pairwise(self.points)]
        if not all(x_step > 0 for x_step, _ in steps):
            raise ValueError(f"{self.x_name} must rise from point to point")
        if not (all(y_step > 0 for _, y_step in steps) or all(y_step < 0 for _, y_step in steps)):
            raise ValueError(f"{self.y_name} must rise, or fall, all the way")
        backward = tuple((y, x) for x, y in self.points)
        object.__setattr__(self, "_backward", backward if backward[0] < backward[-1] else backward[::-1])

    def at(self, x: float, *, clamp: bool = False) -> float:
        """The y for this x. Beyond the ends the last line goes on; with `clamp`, the result is the end's own y."""
        return _on_line(self.points, x, clamp=clamp)

    def inverse(self, y: float, *, clamp: bool = False) -> float:
        """The x for this y. Beyond the ends the last line goes on; with `clamp`, the result is the end's own x."""
        return _on_line(self._backward, y, clamp=clamp)


def _on_line(points: tuple[tuple[float, float], ...], at: float, *, clamp: bool) -> float:
    if clamp:
        at = min(max(at, points[0][0]), points[-1][0])
    right = bisect_right(points, at, 1, len(points) - 1, key=lambda point: point[0])
    (from_a, to_a), (from_b, to_b) = points[right - 1], points[right]
    return to_a + (at - from_a) * (to_b - to_a) / (from_b - from_a)
