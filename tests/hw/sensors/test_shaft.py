"""A shaft between two edges of its cam, by dead reckoning: a motor of 6°/s with a lag of 0.1 s, moment by moment."""

from __future__ import annotations

import math

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


@pytest.mark.parametrize("way", [PLUS, MINUS])
def test_after_one_lag_it_has_63_percent_of_its_speed_and_then_all_of_it(way: Direction) -> None:
    share = 1.0 - math.exp(-1.0)
    shaft = fed(way, LAG_S)
    assert shaft.speed_dps == pytest.approx(way * 6.0 * share)
    assert shaft.angle_deg == pytest.approx(100.0 + way * (0.6 - 0.6 * share))
    assert fed(way, 2.0).speed_dps == pytest.approx(way * 6.0, abs=1e-6)
    assert fed(way, 2.0).angle_deg == pytest.approx(100.0 + way * (12.0 - 0.6), abs=1e-6)


@pytest.mark.parametrize("way", [PLUS, MINUS])
def test_small_steps_lead_to_the_same_place(way: Direction) -> None:
    shaft = placed()
    shaft.feed(way)
    for step in range(1, 101):
        shaft.advance(50.0 + step * 0.01, *FAR)
    assert shaft.angle_deg == pytest.approx(fed(way, 1.0).angle_deg)
    assert shaft.fed_s == pytest.approx(1.0)


def test_a_motor_without_coast_has_its_speed_at_once() -> None:
    shaft = fed(PLUS, 1.0, coast_s=0.0)
    assert (shaft.speed_dps, shaft.angle_deg) == (6.0, 106.0)
    shaft.feed(OFF)
    assert shaft.at_rest
    shaft.advance(52.0, *FAR)
    assert (shaft.speed_dps, shaft.angle_deg) == (0.0, 106.0)


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


def test_it_is_no_longer_at_rest_when_it_is_fed() -> None:
    shaft = placed()
    assert shaft.at_rest
    shaft.feed(MINUS)
    assert not shaft.at_rest


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


def test_placed_it_stands() -> None:
    shaft = fed(PLUS, 1.0)
    shaft.held_deg = 3.0
    shaft.place(60.0, 20.0)
    assert (shaft.at_s, shaft.angle_deg, shaft.speed_dps, shaft.held_deg) == (60.0, 20.0, 0.0, 0.0)


def test_time_never_goes_back_and_the_first_moment_moves_nothing() -> None:
    shaft = fed(PLUS, 1.0)
    at_deg = shaft.angle_deg
    for earlier_s in (50.5, 51.0):
        assert not shaft.advance(earlier_s, *FAR)
        assert (shaft.at_s, shaft.angle_deg) == (51.0, at_deg)
    fresh = ReckonedShaft(Cam(5.0, 1.0, 0.0, speed_dps=6.0))
    assert (fresh.held_deg, fresh.speed_dps, fresh.fed) == (0.0, 0.0, OFF)
    fresh.feed(PLUS)
    assert not fresh.advance(50.0, *FAR)
    assert (fresh.at_s, fresh.angle_deg, fresh.fed_s) == (50.0, 0.0, 0.0)


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
