"""Where an axis has met a stop: it ends short of it until a person releases it, and never outside its limits."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.control.axis.met_stops import MetStops
from rotator.control.sky.mount import Range
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import Tries

MINUS, PLUS = Direction.MINUS, Direction.PLUS
LIMITS = Range(0.0, 450.0)
STANDS, END = FaultKind.STANDS_STILL, FaultKind.END_STOP


@pytest.fixture
def stops() -> MetStops:
    return MetStops(Axis.AZIMUTH, LIMITS)


@pytest.mark.parametrize(
    ("way", "angle_deg", "limits"),
    [(PLUS, 448.0, Range(0.0, 446.0)), (PLUS, 452.5, LIMITS), (MINUS, 3.0, Range(5.0, 450.0)), (MINUS, -4.0, LIMITS)],
)
def test_an_axis_ends_two_degrees_before_an_end_stop_that_it_met(
    stops: MetStops, way: Direction, angle_deg: float, limits: Range
) -> None:
    stops.stood_still(END, way, angle_deg)
    assert stops.limits == limits


def test_ice_in_mid_travel_is_a_stop_only_when_it_holds_the_axis_there_again(stops: MetStops) -> None:
    stops.stood_still(STANDS, PLUS, 200.0)
    assert (stops.limits, stops.notices) == (LIMITS, ())
    stops.stood_still(STANDS, PLUS, 203.0)
    assert stops.limits == Range(0.0, 201.0)


@pytest.mark.parametrize("again_deg", [196.9, 203.1])
def test_another_place_is_no_stop(stops: MetStops, again_deg: float) -> None:
    stops.stood_still(STANDS, PLUS, 200.0)
    stops.stood_still(STANDS, PLUS, again_deg)
    assert stops.limits == LIMITS


def test_a_place_is_compared_with_the_latest_one(stops: MetStops) -> None:
    for angle_deg in (200.0, 230.0, 200.0):
        stops.stood_still(STANDS, PLUS, angle_deg)
    assert stops.limits == LIMITS


def test_held_there_from_both_sides_it_is_two_places(stops: MetStops) -> None:
    stops.stood_still(STANDS, PLUS, 200.0)
    stops.stood_still(STANDS, MINUS, 200.0)
    assert stops.limits == LIMITS


def test_a_release_forgets_the_stops_and_where_it_stood_once(stops: MetStops) -> None:
    stops.stood_still(END, PLUS, 448.0)
    stops.stood_still(STANDS, MINUS, 200.0)
    stops.forget()
    assert (stops.limits, stops.notices) == (LIMITS, ())
    stops.stood_still(STANDS, MINUS, 200.0)
    assert stops.limits == LIMITS, "it is the first time again"


def test_each_stop_is_noticed_with_its_place_its_direction_and_its_cure(stops: MetStops) -> None:
    stops.stood_still(END, PLUS, 448.2)
    stops.stood_still(END, MINUS, 2.0)
    for notice, place, way in zip(stops.notices, (" 448°", " 2°"), (" clockwise", "counter-clockwise"), strict=True):
        assert all(word in notice.text for word in (place, way, "`resume`"))
        assert notice.lcd == "STOP MET"


STOOD = st.tuples(st.sampled_from([STANDS, END]), st.sampled_from([PLUS, MINUS]), st.floats(-5.0, 455.0))


@given(st.lists(STOOD, max_size=8))
def test_from_any_place_where_it_stood_its_limits_shrink_and_stay_a_range(
    met: list[tuple[FaultKind, Direction, float]],
) -> None:
    stops = MetStops(Axis.AZIMUTH, LIMITS)
    for kind, way, angle_deg in met:
        stops.stood_still(kind, way, angle_deg)
        assert 0.0 <= stops.limits.min_deg <= stops.limits.max_deg <= 450.0


def test_the_next_run_of_the_program_knows_each_stop_and_where_it_stood_once(stops: MetStops) -> None:
    stops.stood_still(END, PLUS, 440.0)
    stops.stood_still(STANDS, MINUS, 20.0)
    next_run = MetStops(Axis.AZIMUTH, LIMITS, Tries(stood_deg=stops.stood_deg, stops_deg=stops.stops_deg))
    assert (next_run.limits, next_run.notices) == (Range(0.0, 438.0), stops.notices)
    next_run.stood_still(STANDS, MINUS, 21.0)
    assert next_run.limits == Range(23.0, 438.0)
    next_run.forget()
    assert (next_run.stood_deg, next_run.stops_deg, next_run.limits) == ((None, None), (None, None), LIMITS)
