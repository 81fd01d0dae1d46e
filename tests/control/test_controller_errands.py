"""What the controller does beside aiming: lost links, late cycles, errands for the rotor, words for a person."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.commands import Acknowledge, Place
from rotator.exchange.faults import FaultKind, Notice
from rotator.exchange.motor import Trust
from rotator.exchange.orders import (
    Aim,
    Confirm,
    Home,
    Jog,
    LetGo,
    Mode,
    Order,
    Park,
    RelaysChecked,
    Release,
    Remark,
    SetMode,
    Stop,
)
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
CONSOLE, PANEL, BROWSER = Source("console"), Source("panel"), Source("page", 1)
RESTING = {AZ: OFF, EL: OFF}


# --- no order can arrive any more


@pytest.mark.parametrize("order", [Aim(235, 60), Jog(AZ, PLUS), Park()], ids=str)
def test_with_the_links_lost_what_they_ordered_ends(desk: Any, order: Order) -> None:
    desk.step(order)
    desk.run(1.0)
    desk.controller.links_lost()
    assert desk.step() == RESTING
    assert desk.run(10.0) == set()


def test_with_the_links_lost_a_storm_park_goes_on(desk: Any) -> None:
    desk.step(Park(storm=True), by=CONSOLE)
    desk.controller.links_lost()
    assert (AZ, MINUS) in desk.run(1.0)


SENDERS = [CONSOLE, PANEL, BROWSER, Source("gs232b", 1), Source("mqtt"), Source("track")]


@pytest.mark.parametrize("sender", SENDERS, ids=str)
def test_with_the_links_lost_only_what_page_and_panel_ordered_goes_on(desk: Any, sender: Source) -> None:
    """Each of these two has a thread of its own, and a STOP that works."""
    desk.step(Jog(AZ, PLUS), by=sender)
    desk.controller.links_lost()
    assert (desk.step()[AZ] is PLUS) is (sender in (PANEL, BROWSER))


@pytest.mark.parametrize("sender", SENDERS, ids=str)
def test_with_the_page_lost_only_what_it_ordered_ends(desk: Any, sender: Source) -> None:
    desk.step(Jog(AZ, PLUS), by=sender)
    desk.controller.page_lost()
    assert (desk.step()[AZ] is PLUS) is (sender is not BROWSER)


@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG])
def test_a_mode_that_the_console_has_set_does_not_outlast_the_links(desk: Any, mode: Mode) -> None:
    desk.step(SetMode(mode), by=CONSOLE)
    desk.step(Jog(AZ, PLUS), by=CONSOLE)
    desk.controller.links_lost()
    assert desk.step() == RESTING


def test_with_the_links_lost_no_other_axis_begins_to_home(new_desk: Any) -> None:
    desk = new_desk(counted=True)
    desk.step()
    desk.step(Home(AZ), Home(EL), by=CONSOLE)
    desk.run(1.0)
    assert desk.status.azimuth.homing
    desk.controller.links_lost()
    assert desk.run(30.0) == set()
    assert not desk.status.elevation.homing


# --- a cycle that comes late


@pytest.mark.parametrize(("gap_s", "told"), [(0.5, False), (0.6, True)])
def test_a_late_cycle_is_a_fault_of_both_axes_while_a_motor_runs(desk: Any, gap_s: float, told: bool) -> None:
    desk.step(Jog(AZ, PLUS))
    desk.run(1.0)
    desk.step(seconds=gap_s)
    kinds = [status.fault.kind if status.fault else None for status in (desk.status.azimuth, desk.status.elevation)]
    assert kinds == ([FaultKind.CONTROL_LATE] * 2 if told else [None] * 2)


def test_a_late_cycle_at_rest_is_no_fault(desk: Any) -> None:
    desk.step(seconds=5.0)
    desk.run(0.5)
    assert (desk.status.azimuth.fault, desk.status.elevation.fault) == (None, None)


# --- what the rotor is to do once


@pytest.mark.parametrize("order", [Stop(), Release()], ids=str)
def test_what_is_acknowledged_is_acknowledged_at_the_rotor_too(desk: Any, order: Order) -> None:
    desk.step(order)
    assert [each for each in desk.controller.errands if each != order] == [Acknowledge(AZ), Acknowledge(EL)]


@pytest.mark.parametrize("order", [Stop((AZ,)), Stop(latch=True), Aim(235, 60)], ids=str)
def test_other_orders_acknowledge_nothing_at_the_rotor(desk: Any, order: Order) -> None:
    desk.step(order, by=CONSOLE)
    assert [each for each in desk.controller.errands if each != order] == []


@pytest.mark.parametrize("order", [Stop(), Stop((AZ,)), Stop(latch=True)], ids=str)
def test_a_stop_is_passed_on_though_this_box_turns_nothing(desk: Any, order: Order) -> None:
    """A controller of its own may be turning the antenna."""
    desk.step(order, by=CONSOLE)
    assert order in desk.controller.errands


def test_a_person_s_let_go_stops_latches_and_is_passed_on(desk: Any) -> None:
    desk.step(Aim(235, 60))
    assert desk.step(LetGo(), by=CONSOLE) == RESTING
    assert desk.controller.errands == [LetGo()]
    assert desk.status.latched == "console"


def test_a_confirmed_angle_is_passed_on_by_an_axis_that_counts_and_refused_by_one_that_measures(new_desk: Any) -> None:
    for counted, errands, troubles in (
        (True, [Place(AZ, 30.0)], 0),
        (False, [], 1),
    ):
        desk = new_desk(counted=counted)
        desk.step()
        desk.step(Aim(235, 60))
        desk.step(Confirm(AZ, 30.0), by=CONSOLE)
        assert desk.controller.errands == errands
        assert len(desk.controller.troubles) == troubles
        assert (desk.status.azimuth.target_deg is None) is counted, "refused, its target stays"


# --- words for persons


def test_what_the_panel_remarks_of_an_axis_is_shown_until_it_takes_it_back(desk: Any) -> None:
    desk.step(Remark(EL, "the knob's wire is broken", "KNOB"), by=PANEL)
    assert desk.status.elevation.notices == (Notice("the knob's wire is broken", "KNOB"),)
    assert desk.status.azimuth.notices == ()
    desk.step(Remark(EL, "", ""), by=PANEL)
    assert desk.status.elevation.notices == ()


def test_the_sender_that_moves_the_antenna_is_shown_until_a_stop(desk: Any) -> None:
    assert desk.status.controlled_by == ""
    desk.step(Aim(235, 60))
    assert desk.status.controlled_by == "gs232b#1"
    desk.step(Stop(), by=CONSOLE)
    assert desk.status.controlled_by == ""


def test_a_person_who_has_looked_at_the_relays_ends_the_doubt_of_that_axis(new_desk: Any) -> None:
    desk = new_desk(at=(448.5, 10.0))
    desk.run(1.0)
    desk.instead[AZ] = desk.raw(AZ)  # it stands at its stop, and goes on being driven
    desk.step(Jog(AZ, PLUS))
    desk.driven[AZ] = OFF
    for _ in range(60):
        desk.controller.note_driven(desk.now_s, {AZ: PLUS, EL: OFF})
        desk.step()
    desk.controller.note_driven(desk.now_s, RESTING)
    desk.run(3.0)
    assert desk.status.azimuth.trusts[0] is Trust.DOUBTED
    desk.step(RelaysChecked(EL), by=CONSOLE)
    assert desk.status.azimuth.trusts[0] is Trust.DOUBTED
    desk.step(RelaysChecked(AZ), by=CONSOLE)
    assert desk.status.azimuth.trusts == (Trust.OPEN, Trust.OPEN)
