"""A timed list: points to visit one after another, an interval apart (GS-232 M and W lists, T and N).

Knows the list and its present point. Knows nothing of where the antenna is.
"""

from __future__ import annotations

Point = tuple[float, float | None]


class TimedList:
    """`point` is the number of the present one, from 1 as N tells it; 0 where there is no list."""

    def __init__(self) -> None:
        self.interval_s = 0.0
        self.points: tuple[Point, ...] = ()
        self.point = 0
        self._started_s: float | None = None
        self._started_point = 0

    @property
    def running(self) -> bool:
        return self._started_s is not None

    def load(self, interval_s: float, points: tuple[Point, ...]) -> Point:
        """Take a new list. Returns its first point, to aim at while waiting for `run`."""
        self.interval_s, self.points, self.point = interval_s, points, 1
        self._started_s = None
        return points[0]

    def clear(self) -> None:
        self.points, self.point, self._started_s = (), 0, None

    def run(self, now_s: float) -> None:
        """Go on to the next point at once, to the one after it an interval later, and so on (the manuals, under T).

        A run that goes on already is left alone: a T sent twice skips no point.
        """
        if self.point < len(self.points) and not self.running:
            self._started_s, self._started_point = now_s, self.point + 1

    def halt(self) -> None:
        """A stop or any other order ends the run; the list and its present point stay."""
        self._started_s = None

    def due(self, now_s: float) -> Point | None:
        """The point to aim at if a new one is due. Moments count from the start, so lateness never adds up."""
        if self._started_s is None:
            return None
        passed = int((now_s - self._started_s) / self.interval_s + 1e-9)
        point = min(self._started_point + passed, len(self.points))
        if point == self.point:
            return None
        self.point = point
        if point == len(self.points):
            self._started_s = None
        return self.points[point - 1]
