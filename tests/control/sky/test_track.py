"""Where a target is going, from the orders of a tracking program once a second.

The target here flies along a straight line in space past the station, as a satellite nearly does.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.track import COASTING_S, KEPT_S, LEAST_ORDERS, LONGEST_GAP_S, THIN_S, Track
from tests.tables import every_row

Direction = tuple[float, float]


def flying(t_s: float) -> Direction:
    """Past the station in the east, 500 km up at the nearest, at 7 km/s: from the south to the north."""
    east_km, north_km, up_km = 400.0, -1000.0 + 7.0 * t_s, 500.0
    azimuth_deg = math.degrees(math.atan2(east_km, north_km)) % 360.0
    return azimuth_deg, math.degrees(math.atan2(up_km, math.hypot(east_km, north_km)))


def rounded(direction: Direction, decimals: int) -> Direction:
    return round(direction[0], decimals), round(direction[1], decimals)


def tracked(
    until_s: float, decimals: int, target: Callable[[float], Direction] = flying, *, every_s: float = 1.0
) -> Track:
    track = Track()
    for count in range(int(until_s / every_s) + 1):
        track.note(count * every_s, *rounded(target(count * every_s), decimals))
    return track


def off_deg(track: Track, at_s: float) -> float:
    return great_circle_deg(*track.direction(at_s), *flying(at_s))


@pytest.mark.parametrize(
    ("decimals", "now_deg", "soon_deg"),
    [(0, 0.6, 2.5), (1, 0.1, 0.9), (2, 0.02, 0.3)],
)
def test_it_knows_the_target_between_the_orders_and_ahead_of_them(
    decimals: int, now_deg: float, soon_deg: float
) -> None:
    track = tracked(60.0, decimals)
    assert track.moving(60.0)
    for at_s in (60.0, 60.4, 60.9):
        assert off_deg(track, at_s) < now_deg
    assert off_deg(track, 75.0) < soon_deg


@every_row("stood_s", [3.0, 20.0, 300.0])
@every_row(("decimals", "at_once_deg", "soon_deg"), [(0, 11.0, 11.0), (1, 11.0, 3.5), (2, 11.0, 2.5)])
def test_a_target_that_is_held_where_it_will_rise_and_then_begins_to_move(
    decimals: int, at_once_deg: float, soon_deg: float, stood_s: float
) -> None:
    """As Gpredict does it over rotctld. Where it will be in 20 s: at most that far off, and after some orders less."""
    track = Track()
    for second in range(-int(stood_s), 15):
        track.note(float(second), *rounded(flying(max(0.0, float(second))), decimals))
        if second > 0 and track.moving(float(second)):
            assert off_deg(track, second + 20.0) < (at_once_deg if second < LEAST_ORDERS else soon_deg), second


@pytest.mark.long
@pytest.mark.parametrize(
    ("decimals", "now_deg", "in_20_s_deg"),
    [(0, 0.12, 0.45), (1, 0.015, 0.065), (2, 0.003, 0.028)],
)
def test_roundings_are_averaged_far_below_themselves(decimals: int, now_deg: float, in_20_s_deg: float) -> None:
    for ahead_s, limit_deg in ((0.0, now_deg), (20.0, in_20_s_deg)):
        squares = [off_deg(tracked(now_s, decimals), now_s + ahead_s) ** 2 for now_s in range(60, 120, 3)]
        assert math.sqrt(sum(squares) / len(squares)) < limit_deg


@pytest.mark.parametrize("decimals", [0, 2])
def test_it_goes_through_the_north_and_beside_the_zenith(decimals: int) -> None:
    def over(t_s: float) -> Direction:
        east_km, north_km = 40.0, -300.0 + 7.0 * t_s
        return math.degrees(math.atan2(east_km, north_km)) % 360.0, math.degrees(
            math.atan2(500.0, math.hypot(east_km, north_km))
        )

    def north(t_s: float) -> Direction:
        return (340.0 + 0.5 * t_s) % 360.0, 20.0

    for target, limit_deg in ((over, 1.0), (north, 0.6)):
        track = tracked(60.0, decimals, target)
        assert great_circle_deg(*track.direction(60.5), *target(60.5)) < limit_deg
        assert 0.0 <= track.direction(60.5)[0] < 360.0


def test_without_an_order_it_does_not_move() -> None:
    track = Track()
    assert not track.moving(1.0)
    assert track.age_s(1.0) == 0.0


def test_three_orders_are_no_stream_and_four_are() -> None:
    track = Track()
    for count in range(LEAST_ORDERS):
        assert not track.moving(float(count))
        track.note(float(count), *rounded(flying(3.0 * count), 2))
    assert track.moving(3.0)
    assert track.age_s(3.0) == 3.0
    assert track.age_s(3.5) == 3.5


def test_one_order_stands() -> None:
    track = Track()
    track.note(0.0, 123.0, 45.0)
    assert track.direction(0.0) == track.direction(50.0) == (123.0, 45.0)


@pytest.mark.parametrize(("flicker_deg", "moves"), [(0, False), (1, False), (2, True)])
def test_whole_degrees_that_change_by_one_may_be_a_target_that_stands(flicker_deg: int, moves: bool) -> None:
    track = Track()
    for count in range(20):
        track.note(float(count), 120.0 + (0 if count < 19 else flicker_deg), 10.0)
    assert track.moving(19.0) is moves


def test_hundredths_that_hardly_change_are_no_path() -> None:
    still, moving = Track(), Track()
    for count in range(20):
        still.note(float(count), 120.03, 10.0 + 0.004 * count)
        moving.note(float(count), 120.03, 10.01 + 0.01 * count)
    assert not still.moving(19.0)
    assert moving.moving(19.0)


def test_when_the_orders_end_it_goes_on_for_three_seconds_and_no_more() -> None:
    track = tracked(30.0, 2)
    assert track.moving(30.0 + COASTING_S)
    assert not track.moving(30.0 + COASTING_S + 0.01)


@pytest.mark.parametrize(("gap_s", "goes_on"), [(LONGEST_GAP_S, True), (LONGEST_GAP_S + 0.1, False)])
def test_after_a_gap_a_path_begins_anew(gap_s: float, goes_on: bool) -> None:
    track = tracked(30.0, 2)
    track.note(30.0 + gap_s, *rounded(flying(30.0 + gap_s), 2))
    assert track.moving(30.0 + gap_s) is goes_on


@pytest.mark.parametrize(("aside_deg", "goes_on"), [(3.0, True), (5.0, False)])
def test_an_order_far_from_the_path_is_a_new_target(aside_deg: float, goes_on: bool) -> None:
    track = tracked(30.0, 2)
    azimuth_deg, elevation_deg = flying(31.0)
    track.note(31.0, azimuth_deg, elevation_deg + aside_deg)
    assert track.moving(31.0) is goes_on
    if not goes_on:
        assert track.direction(31.0) == (azimuth_deg, elevation_deg + aside_deg)


def test_the_end_of_a_stream_leaves_its_last_order() -> None:
    track = tracked(30.0, 2)
    track.end()
    assert not track.moving(30.0)
    assert track.direction(99.0) == rounded(flying(30.0), 2)
    track.note(31.0, *flying(31.0))
    assert not track.moving(31.0), "it begins anew"


def test_cleared_it_knows_nothing() -> None:
    track = tracked(30.0, 2)
    track.clear()
    assert not track.moving(30.0)
    assert track.age_s(30.0) == 0.0
    track.end()
    assert not track.moving(30.0)


def test_old_orders_are_forgotten() -> None:
    track = tracked(300.0, 0, lambda t_s: (100.0 + t_s / 2.0, 20.0))
    assert track.age_s(300.0) == KEPT_S


def test_faster_orders_carry_no_more_than_one_in_the_least_time() -> None:
    """A program that sends at 100 Hz leads to the same path, and to no longer list of orders."""
    quick = tracked(40.0, 2, every_s=0.01)
    assert off_deg(quick, 40.5) < 0.05
    begun = Track()
    for count in range(10):
        begun.note(count * THIN_S / 10, *flying(count * THIN_S))
    assert not begun.moving(THIN_S), "ten orders in 0.4 s are two"


def test_of_two_orders_at_one_moment_the_second_counts() -> None:
    track = Track()
    track.note(5.0, 100.0, 10.0)
    track.note(5.0, 101.0, 11.0)
    assert track.direction(5.0) == (101.0, 11.0)
    for count in range(10):
        track.note(5.0, 101.0 + count / 5.0, 11.0)
    assert not track.moving(5.0)
