"""Timed lists: each point at its moment, to the tenth of a second, after an hour as after one."""

from __future__ import annotations

from rotator.control.sky.timed import Point, TimedList
from tests.tables import every_row

AZIMUTHS: tuple[Point, ...] = ((10.0, None), (20.0, None), (30.0, None))


@every_row("interval_s", [1.0, 3.0, 999.0])
@every_row("start_s", [0.0, 12_345.678_9])
def test_intervals_are_exact_to_the_end_of_the_longest_list(interval_s: float, start_s: float) -> None:
    timed = TimedList()
    points: tuple[Point, ...] = tuple((float(number % 360), None) for number in range(3800))
    timed.load(interval_s, points)
    timed.run(start_s)
    for number in range(1, 3800):
        due_s = start_s + (number - 1) * interval_s
        if number > 1:
            assert timed.due(due_s - 0.05) is None
        assert timed.due(due_s) == points[number]
        assert timed.point == number + 1


def test_a_late_look_does_not_put_off_the_next_point() -> None:
    timed = TimedList()
    timed.load(1.0, AZIMUTHS)
    timed.run(0.0)
    assert timed.due(0.9) == (20.0, None)
    assert timed.due(0.95) is None
    assert timed.due(1.0) == (30.0, None)


def test_a_very_late_look_skips_what_is_over() -> None:
    timed = TimedList()
    timed.load(1.0, AZIMUTHS)
    timed.run(0.0)
    assert timed.due(1.5) == (30.0, None)
    assert timed.due(99.0) is None
