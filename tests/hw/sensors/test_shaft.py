"""A shaft between two edges of its cam, by dead reckoning: a motor of 6°/s with a lag of 0.1 s, moment by moment."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from hw.sensors.cam import Cam
from hw.sensors.shaft import ReckonedShaft

PLUS, MINUS, OFF = Direction.PLUS, Direction.MINUS, Direction.OFF
LAG_S = 0.1
FAR = (-1000.0, 1000.0)
"""No edge is near."""


def placed(angle_deg: float = 100.0, coast_s: float = 5 * LAG_S) -> ReckonedShaft:
    shaft = ReckonedShaft(Cam(5.0, 1.0, 0.0, speed_dps=6.0, coast_s=coast_s))
    shaft.place(50.0, angle_deg)
    return shaft


def fed(direction: Direction, seconds: float, coast_s: float = 5 * LAG_S) -> ReckonedShaft:
    shaft = placed(coast_s=coast_s)
    shaft.feed(direction)
    assert shaft.advance(50.0 + seconds, *FAR)
    return shaft


def test_without_power_it_coasts_by_its_lag_and_then_stands() -> None:
    shaft = fed(PLUS, 2.0)
    at_deg = shaft.angle_deg
    shaft.feed(OFF)
    assert shaft.advance(52.4, *FAR)
    assert shaft.speed_dps > 0.0
    assert not shaft.at_rest
    shaft.advance(52.5, *FAR)
    assert shaft.at_rest
    shaft.advance(52.8, *FAR)
    assert shaft.speed_dps == 0.0, "less than a thousandth of its speed is standing"
    assert shaft.angle_deg == pytest.approx(at_deg + 0.6, abs=0.001)
    assert not shaft.advance(60.0, *FAR), "nothing moves"
    assert shaft.at_s == 60.0


@pytest.mark.parametrize(("way", "edge_deg"), [(PLUS, 102.0), (MINUS, 98.0)])
def test_it_never_passes_an_edge_by_itself_and_says_how_far_it_should_have_gone(
    way: Direction, edge_deg: float
) -> None:
    shaft = placed()
    shaft.feed(way)
    shaft.advance(52.0, 98.0, 102.0)
    assert shaft.angle_deg == edge_deg
    assert shaft.held_deg == pytest.approx(12.0 - 0.6 - 2.0, abs=1e-6)
    shaft.advance(53.0, 98.0, 102.0)
    assert shaft.held_deg == pytest.approx(12.0 - 0.6 - 2.0 + 6.0, abs=1e-6)
    shaft.cross(edge_deg)
    assert (shaft.angle_deg, shaft.held_deg, shaft.fed_deg) == (edge_deg, 0.0, 0.0)


def test_a_shaft_that_is_fed_on_was_held_as_far_as_before_and_one_that_turns_back_was_not() -> None:
    held = placed()
    held.feed(PLUS)
    held.advance(51.0, 98.0, 102.0)
    held_deg = held.held_deg
    assert held_deg > 3.0
    held.feed(OFF)
    held.feed(PLUS)
    assert held.held_deg == held_deg, "it still turns"
    held.feed(MINUS)
    assert held.held_deg == 0.0
    standing = placed()
    standing.held_deg = 2.0
    standing.feed(PLUS)
    assert standing.held_deg == 0.0


def test_how_far_it_should_have_turned_counts_from_the_last_edge_or_order() -> None:
    shaft = fed(PLUS, 1.0)
    assert shaft.fed_deg == 6.0
    shaft.feed(PLUS)
    assert shaft.fed_deg == 6.0, "the same order again"
    shaft.feed(OFF)
    assert shaft.fed_deg == 0.0
    shaft.advance(52.0, *FAR)
    assert shaft.fed_s == 0.0, "only time under power"


def test_each_direction_learns_its_own_speed_by_a_quarter_of_what_is_new() -> None:
    shaft = placed()
    shaft.learn(MINUS, 4.0)
    shaft.learn(MINUS, 4.0)
    assert shaft.top_speed_dps == 6.0
    shaft.feed(MINUS)
    shaft.advance(52.0, *FAR)
    assert shaft.fed_deg == pytest.approx(2.0 * 5.125)
    assert shaft.speed_dps == pytest.approx(-5.125, abs=1e-6)
    shaft.learn(PLUS, 10.0)
    assert shaft.top_speed_dps == 7.0
