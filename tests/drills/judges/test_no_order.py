"""An axis that moves with no order in force: which orders are in force for which axis, and until when."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from benchmarks.drills.front_panel import STILL_S
from tests.drills.judges.mast import Mast


def test_driven_before_any_order() -> None:
    assert Mast().run(0.6, coil=1) == [accusations.NO_ORDER]


def test_the_wind_turns_what_it_likes() -> None:
    assert Mast().run(60.0, dps=2.0) == []


def test_a_new_mode_ends_the_orders_before_it_and_none_after_it() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.order("panel", "mode", "manual")
    mast.run(1.2, coil=1)
    mast.order("panel", "knob", "elevation", 0.5)
    assert mast.run(0.2) == []
    assert not mast.orders.holds("azimuth")
    assert mast.orders.holds("elevation")


def test_a_knob_turned_just_before_a_mode_counts_may_be_seen_in_that_mode() -> None:
    for before_s, found in ((0.1, []), (0.5, [accusations.AFTER_STOP])):
        mast = Mast()
        mast.order("panel", "mode", "manual")
        mast.run(STILL_S - before_s)
        mast.order("panel", "knob", "azimuth", 0.5)
        mast.run(0.6 + before_s)
        assert mast.run(1.0, coil=1) == found


def test_an_order_for_azimuth_may_turn_both_axes_round_a_sector() -> None:
    mast = Mast()
    mast.order("rotctld", "aim-azimuth", 200.0)
    assert not mast.orders.holds("elevation")
    mast.orders.goes_round = True
    mast.order("rotctld", "aim-azimuth", 200.0)
    assert mast.orders.holds("elevation")


def test_one_coordinate_alone_moves_both_axes_only_over_the_top() -> None:
    for stands_deg, found in ((150.0, []), (60.0, [accusations.NO_ORDER])):
        mast = Mast()
        mast.elevation.shaft_deg = stands_deg
        mast.order("easycomm2", "aim-elevation", 26.0)
        assert mast.run(3.0, coil=1) == found


def test_an_idle_park_begins_after_any_order() -> None:
    mast = Mast(idle=True)
    mast.order("rotctld", "jog", "cw")
    mast.order("rotctld", "leave")
    assert mast.run(4.0, coil=-1) == []


def test_what_links_ordered_ends_when_no_stop_could_arrive_but_not_a_storm_park() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.orders.links_lost(mast.now_s)
    assert not mast.orders.holds("azimuth")
    mast.order("console", "storm")
    mast.orders.links_lost(mast.now_s)
    assert mast.orders.holds("azimuth")


@pytest.mark.parametrize(("before", "holds"), [("storm", True), ("home", True), ("aim", False)])
def test_a_person_who_gives_an_angle_ends_an_aim_but_neither_a_storm_park_nor_a_homing(
    before: str, holds: bool
) -> None:
    mast = Mast()
    match before:
        case "aim":
            mast.order("console", before, 200.0, 0.0)
        case "home":
            mast.order("console", before, "azimuth")
        case _:
            mast.order("console", before)
    mast.order("console", "confirm", "azimuth", 0.0)
    assert mast.orders.holds("azimuth") is holds
