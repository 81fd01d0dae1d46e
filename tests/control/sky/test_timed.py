"""Timed lists: each point at its moment, to the tenth of a second, after an hour as after one."""

from __future__ import annotations

import pytest

from rotator.control.sky.timed import Point, TimedList

AZIMUTHS: tuple[Point, ...] = ((10.0, None), (20.0, None), (30.0, None))


def visits(timed: TimedList, start_s: float, seconds: float, period_s: float = 0.05) -> list[tuple[float, Point]]:
    """Ask at 20 Hz, as the control loop does; returns when which point came due."""
    found = []
    for count in range(round(seconds / period_s) + 1):
        now_s = start_s + count * period_s
        point = timed.due(now_s)
        if point is not None:
            found.append((now_s - start_s, point))
    return found


def test_at_first_there_is_no_list() -> None:
    timed = TimedList()
    timed.run(0.0)
    assert (timed.point, timed.points, timed.due(100.0)) == (0, (), None)


def test_loading_aims_at_the_first_point_and_waits() -> None:
    timed = TimedList()
    assert timed.load(2.0, AZIMUTHS) == (10.0, None)
    assert timed.point == 1
    assert visits(timed, 0.0, 60.0) == []


def test_running_turns_to_the_next_point_at_once_and_then_waits() -> None:
    timed = TimedList()
    timed.load(2.0, AZIMUTHS)
    timed.run(100.0)
    assert visits(timed, 100.0, 60.0) == [(0.0, (20.0, None)), (pytest.approx(2.0), (30.0, None))]
    assert timed.point == 3


def test_run_again_while_running_skips_no_point() -> None:
    timed = TimedList()
    timed.load(2.0, AZIMUTHS)
    timed.run(100.0)
    assert timed.due(100.0) == (20.0, None)
    timed.run(100.5)
    assert timed.due(100.5) is None
    assert timed.due(102.0) == (30.0, None)


def test_at_the_last_point_there_is_nothing_to_run() -> None:
    timed = TimedList()
    timed.load(2.0, AZIMUTHS)
    timed.run(0.0)
    timed.due(10.0)
    timed.run(20.0)
    assert not timed.running
    assert visits(timed, 20.0, 10.0) == []


@pytest.mark.parametrize("interval_s", [1.0, 3.0, 999.0])
@pytest.mark.parametrize("start_s", [0.0, 12_345.678_9])
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


def test_halted_it_keeps_its_list_and_its_point_and_goes_on_from_there() -> None:
    timed = TimedList()
    timed.load(1.0, AZIMUTHS)
    timed.run(0.0)
    timed.due(0.5)
    timed.halt()
    assert visits(timed, 1.0, 60.0) == []
    assert (timed.point, len(timed.points)) == (2, 3)
    timed.run(100.0)
    assert visits(timed, 100.0, 10.0) == [(0.0, (30.0, None))]


def test_a_new_list_replaces_a_running_one() -> None:
    timed = TimedList()
    timed.load(1.0, AZIMUTHS)
    timed.run(0.0)
    assert timed.load(5.0, ((1.0, 2.0), (3.0, 4.0))) == (1.0, 2.0)
    assert visits(timed, 1.0, 10.0) == []
    timed.run(20.0)
    assert visits(timed, 20.0, 10.0) == [(0.0, (3.0, 4.0))]


def test_cleared_there_is_nothing_to_run() -> None:
    timed = TimedList()
    timed.load(1.0, AZIMUTHS)
    timed.run(0.0)
    timed.clear()
    assert visits(timed, 0.0, 10.0) == []
    timed.run(20.0)
    assert (timed.point, timed.points, timed.due(30.0)) == (0, (), None)
