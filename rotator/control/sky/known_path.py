"""The path of a target that is known to its end: directions at moments, and between them.

Knows the short way round in azimuth. Knows nothing of axes or motors. Moments are on the control loop's clock.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from rotator.control.sky.angles import turn_deg

Row = tuple[float, float, float]
"""A moment in seconds; azimuth and elevation in degrees."""


def rows_around(rows: Sequence[Row], at_s: float) -> tuple[Row, Row, float]:
    """The rows before and after this moment, and the share of the way between them. Beyond an end: that end's row."""
    after = min(max(bisect_right(rows, at_s, key=lambda row: row[0]), 1), len(rows) - 1)
    begins_s, ends_s = rows[after - 1][0], rows[after][0]
    return rows[after - 1], rows[after], min(max((at_s - begins_s) / (ends_s - begins_s), 0.0), 1.0)


def direction_at(rows: Sequence[Row], at_s: float) -> tuple[float, float]:
    """Azimuth from 0 to below 360, and elevation, at this moment. Azimuth takes the short way round."""
    (_, az_a, el_a), (_, az_b, el_b), share = rows_around(rows, at_s)
    return (az_a + share * turn_deg(az_a, az_b)) % 360.0, el_a + share * (el_b - el_a)


@dataclass(frozen=True, slots=True)
class KnownPath:
    """Two rows or more, at rising moments. Raises ValueError."""

    rows: tuple[Row, ...]

    def __post_init__(self) -> None:
        if len(self.rows) < 2:
            raise ValueError("a path has two rows or more")
        if any(after[0] <= before[0] for before, after in pairwise(self.rows)):
            raise ValueError("the moments of a path rise from row to row")

    @property
    def begin_s(self) -> float:
        return self.rows[0][0]

    @property
    def end_s(self) -> float:
        return self.rows[-1][0]

    def direction(self, at_s: float) -> tuple[float, float]:
        """Azimuth from 0 to below 360, and elevation; before the first row and after the last one, that row's."""
        return direction_at(self.rows, at_s)

    def directions(self, from_s: float, every_s: float) -> Sequence[tuple[float, float]]:
        """The directions every `every_s` seconds, from `from_s` to the end."""
        count = max(1, int((self.end_s - from_s) / every_s) + 1)
        return [self.direction(from_s + index * every_s) for index in range(count)]
