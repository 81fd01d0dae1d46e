"""Boxes that no move may sweep, and the ways out of them."""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.control.sky.mount import Range, Sector
from rotator.control.sky.sectors import UNKNOWN, Box, box_at, kept, may_sweep, ways_out
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS, MINUS = Direction.PLUS, Direction.MINUS
LIMITS = Box(Range(0, 450), Range(0, 180))
CHIMNEY = kept(Sector("the chimney", Range(102, 128), Range(0, 33), 2.0))
"""With its margin from 100 to 130, up to 35."""
WIRE = kept(Sector("the wire", Range(120, 200), Range(32, 58), 2.0))
"""From 118 to 202, from 30 to 60: it overlaps with the chimney."""


def turn(from_az: float, from_el: float, to_az: float, to_el: float) -> bool:
    here = box_at((from_az, from_el))
    return may_sweep([CHIMNEY], here, here.stretched((to_az, to_el)), LIMITS)


def test_a_move_past_the_chimney_is_free() -> None:
    assert turn(50, 0, 99, 180)
    assert turn(50, 36, 200, 90)


def test_a_move_over_its_corner_is_not_for_one_motor_may_be_faster() -> None:
    assert not turn(90, 40, 140, 20)
    assert not turn(90, 30, 105, 50)


def test_along_its_edge_is_beside_it() -> None:
    assert turn(100, 0, 100, 90)
    assert turn(0, 35, 450, 35)


@every_row(
    ("place", "ways"),
    [
        ((105, 10), {(AZ, MINUS)}),
        ((125, 10), {(AZ, PLUS)}),
        ((115, 30), {(EL, PLUS)}),
        ((104, 32), {(EL, PLUS), (AZ, MINUS)}),
        ((99, 10), set()),
    ],
)
def test_the_way_out_is_the_nearest_edge(place: tuple[float, float], ways: set[tuple[Axis, Direction]]) -> None:
    assert {(way.axis, way.direction) for way in ways_out([CHIMNEY], box_at(place), LIMITS)} == ways


def test_there_is_no_way_out_beyond_the_range() -> None:
    mast = kept(Sector("the mast", Range(-10, 20), Range(-5, 100), 0.0))
    ways = ways_out([mast], box_at((3, 50)), LIMITS)
    assert [(way.axis, way.direction, way.to_deg) for way in ways] == [(AZ, PLUS, 20)]


def test_inside_only_one_axis_moves_and_only_outwards() -> None:
    assert turn(105, 10, 90, 10)
    assert not turn(105, 10, 106, 10)
    assert not turn(105, 10, 105, 20)
    assert not turn(105, 10, 90, 12)


def test_the_way_out_leads_past_a_sector_that_overlaps() -> None:
    up = next(way for way in ways_out([CHIMNEY, WIRE], box_at((126, 33)), LIMITS) if way.axis is EL)
    assert (up.to_deg, up.through) == (60, {"the chimney", "the wire"})


def test_with_the_azimuth_unknown_elevation_leaves_the_sectors_but_enters_none() -> None:
    low, between, high = (Box(UNKNOWN, Range(at_deg, at_deg)) for at_deg in (10.0, 40.0, 70.0))
    assert may_sweep([CHIMNEY], low, low.but(EL, Range(10, 90)), LIMITS)
    assert not may_sweep([CHIMNEY], between, between.but(EL, Range(34, 40)), LIMITS)
    assert may_sweep([CHIMNEY], high, high.but(EL, Range(36, 70)), LIMITS)
    assert not may_sweep([CHIMNEY, WIRE], low, low.but(EL, Range(10, 31)), LIMITS), "it may be below the wire"


def test_with_nothing_known_no_axis_knows_a_way_out() -> None:
    assert ways_out([CHIMNEY], Box(UNKNOWN, UNKNOWN), LIMITS) == []
