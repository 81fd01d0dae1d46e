"""A person on the page: the antenna is theirs until it is given back, and a button turns it while it is held."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.senders import PAUSE_S
from rotator.exchange.orders import Aim, GiveBack, Jog, Order, Park, Stop, Take
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
ANNA, BERT = Source("page", 1), Source("page", 2)
PROGRAM, CONSOLE, TRACKER = Source("gs232b", 1), Source("console", 1), Source("track")
LEASE_S = 0.4


def held(axis: Axis, direction: Direction) -> Jog:
    return Jog(axis, direction, LEASE_S, held=True)


@pytest.mark.parametrize("order", [Aim(200.0, 30.0), held(AZ, PLUS), Take()], ids=["aim", "jog", "take"])
def test_a_stream_does_not_snatch_what_the_page_has_taken(desk: Any, order: Order) -> None:
    desk.step(order, by=ANNA)
    desk.run(PAUSE_S + 60.0)
    for _ in range(5):
        desk.step(Aim(20.0, 80.0), by=PROGRAM)
        desk.run(1.0)
    assert desk.status.wanted_azimuth_deg != 20.0
    assert desk.status.held_by == "page#1"
    assert "page#1 holds the antenna" in desk.status.notices[0]


def test_a_program_s_order_counts_at_once_when_it_is_given_back(desk: Any) -> None:
    for _ in range(5):
        desk.step(Aim(120.0, 20.0), by=PROGRAM)
        desk.run(1.0)
    desk.step(Take(), by=ANNA)
    desk.step(Aim(20.0, 80.0), by=PROGRAM)
    assert desk.status.wanted_azimuth_deg is None or desk.status.wanted_azimuth_deg == 120.0
    desk.step(GiveBack(), by=ANNA)
    desk.step(Aim(121.0, 20.0), by=PROGRAM)
    assert desk.status.wanted_azimuth_deg == 121.0
    assert desk.status.held_by == ""


@pytest.mark.parametrize("taken", [False, True], ids=["not taken", "taken"])
def test_giving_back_lifts_no_stop_of_another_program(desk: Any, *, taken: bool) -> None:
    for _ in range(5):
        desk.step(Aim(120.0, 20.0), by=PROGRAM)
        desk.run(1.0)
    if taken:
        desk.step(Take(), by=ANNA)
    desk.step(Stop(), by=Source("gs232a", 2))
    desk.step(GiveBack(), by=ANNA)
    for _ in range(3):
        desk.step(Aim(200.0, 60.0), by=PROGRAM)
        assert not desk.run(1.0)
    assert "gs232a#2 has stopped the antenna" in desk.status.notices[0]


def test_to_take_what_one_tracks_stops_nothing_and_what_a_program_moves_stops(desk: Any) -> None:
    desk.step(Aim(200.0, 60.0), by=TRACKER)
    desk.run(1.0)
    desk.step(Take(stops=False), by=ANNA)
    assert desk.driven[AZ] is PLUS
    desk.step(Aim(20.0, 60.0), by=PROGRAM)
    assert (desk.status.held_by, desk.status.controlled_by) == ("page#1", "track")
    assert desk.status.wanted_azimuth_deg == 200.0
    desk.step(GiveBack(), by=ANNA)
    desk.step(Aim(200.0, 60.0), by=PROGRAM)
    desk.step(Take(stops=False), by=ANNA)
    desk.run(2.0)
    assert desk.at_rest()


def test_another_person_on_the_page_takes_it_over_before_giving_it_back(desk: Any) -> None:
    desk.step(Take(), by=ANNA)
    desk.step(GiveBack(), by=BERT)
    assert desk.status.held_by == "page#1"
    desk.step(GiveBack(), by=CONSOLE)
    assert desk.status.held_by == ""


def test_to_take_it_does_not_halt_a_storm_park_half_way(desk: Any) -> None:
    desk.step(Aim(200.0, 60.0), by=PROGRAM)
    desk.run(10.0)
    desk.step(Park(storm=True), by=ANNA)
    desk.step(Take(), by=BERT)
    assert desk.status.storm
    desk.run(60.0)
    assert desk.status.azimuth.angle_deg == pytest.approx(0.0, abs=5.0)
    desk.step(Stop(latch=True), by=BERT)
    desk.step(Take(), by=BERT)
    assert desk.status.held_by == "page#2"


def test_two_people_on_the_page_do_not_snatch_it_from_each_other(desk: Any) -> None:
    desk.step(Aim(200.0, 30.0), by=ANNA)
    desk.step(Aim(20.0, 30.0), by=BERT)
    assert desk.status.wanted_azimuth_deg == 200.0
    desk.step(Take(), by=BERT)
    desk.step(Aim(20.0, 30.0), by=BERT)
    assert desk.status.wanted_azimuth_deg == 20.0
    desk.step(held(AZ, PLUS), by=ANNA)
    assert desk.status.wanted_azimuth_deg == 20.0
    assert desk.status.held_by == "page#2"


@pytest.mark.parametrize("source", [CONSOLE, TRACKER], ids=str)
def test_a_person_at_the_box_is_not_held_off(desk: Any, source: Source) -> None:
    desk.step(Take(), by=ANNA)
    desk.step(Aim(200.0, 30.0), by=source)
    assert desk.status.wanted_azimuth_deg == 200.0


def test_a_held_button_that_is_heard_no_more_ends_in_its_lease(desk: Any) -> None:
    for _ in range(8):
        desk.step(held(AZ, PLUS), by=ANNA, seconds=0.15)
    assert desk.driven[AZ] is PLUS
    desk.run(LEASE_S - 0.1)
    assert desk.driven[AZ] is PLUS
    desk.run(0.15)
    assert desk.driven[AZ] is OFF


def test_to_let_go_stops_at_once_and_nothing_else(desk: Any) -> None:
    desk.step(held(AZ, PLUS), by=ANNA)
    assert desk.step(Jog(AZ, OFF, held=True), by=ANNA)[AZ] is OFF
    desk.step(Take(), by=BERT)
    desk.step(held(EL, PLUS), by=BERT)
    assert desk.step(Jog(EL, OFF, held=True), by=ANNA)[EL] is PLUS


def test_to_let_go_does_not_end_a_storm_park(desk: Any) -> None:
    desk.step(held(AZ, PLUS), by=ANNA)
    desk.step(Park(storm=True), by=CONSOLE)
    desk.step(Jog(AZ, OFF, held=True), by=ANNA)
    assert desk.status.storm
    desk.run(60.0)
    assert desk.status.azimuth.angle_deg == pytest.approx(0.0, abs=5.0)


def test_a_press_the_other_way_that_is_let_go_while_its_relay_waits_moves_nothing_later(desk: Any) -> None:
    """The other relay must be seen to open first. A press with a time of its own would wait for that."""
    for _ in range(10):
        desk.step(held(AZ, PLUS), by=ANNA, seconds=0.15)
    desk.step(held(AZ, MINUS), by=ANNA)
    assert (AZ, MINUS) not in desk.run(8.0)
