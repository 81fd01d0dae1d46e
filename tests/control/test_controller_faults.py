"""What stops an axis, who stops the box, and who lets it move again."""

from __future__ import annotations

import math
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, LoadTimed, Order, Park, Release, RunTimed, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
RESTING = {AZ: OFF, EL: OFF}
MOVES: list[Order] = [Aim(235, 60), Jog(AZ, PLUS), Jog(AZ, PLUS, 1.0), Park(), LoadTimed(1.0, ((235, 60),))]
BROKEN = [0.0, 0.01, 0.99, 1.0, math.nan, None]


# --- a sensor out of range


@pytest.mark.parametrize("raw", BROKEN)
def test_the_third_bad_reading_in_a_row_stops_the_axis_and_only_that(desk: Any, raw: float | None) -> None:
    desk.step(Aim(235, 60))
    desk.instead[AZ] = raw
    desk.step()
    assert desk.step() == {AZ: PLUS, EL: PLUS}, "the second one too is ridden out"
    assert desk.step() == {AZ: OFF, EL: PLUS}


@pytest.mark.parametrize("raw", BROKEN)
def test_a_bad_reading_starts_nothing(desk: Any, raw: float | None) -> None:
    desk.instead[AZ] = raw
    assert desk.step(Aim(235, 60)) == {AZ: OFF, EL: PLUS}
    desk.instead.clear()
    assert desk.step() == {AZ: PLUS, EL: PLUS}


def test_a_wire_that_flickers_does_not_make_the_relay_chatter(desk: Any) -> None:
    desk.step(Aim(400, 10))
    starts = 0
    for count in range(200):
        before = desk.driven[AZ]
        desk.instead = {AZ: 1.0} if count % 2 else {}
        desk.step()
        starts += before is OFF and desk.driven[AZ] is not OFF
    assert starts <= 10
    assert [fault.axis for fault in desk.status.faults] == [AZ]


def test_readings_that_stop_coming_are_a_fault(desk: Any) -> None:
    desk.step(Aim(235, 60))
    desk.frozen_since_s[AZ] = desk.now_s
    desk.run(0.5)
    assert [fault.name for fault in desk.status.faults] == ["sensor late"]
    assert desk.driven == {AZ: OFF, EL: PLUS}


# --- soft limits


def test_coasting_back_from_beyond_the_limit_a_jog_outward_waits(desk: Any) -> None:
    desk.place(AZ, 451.7)
    for azimuth_deg in (451.4, 451.1, 450.8, 450.5, 450.2):
        desk.angle_deg[AZ] = azimuth_deg
        desk.step()
    desk.angle_deg[AZ] = 450.05
    assert desk.step(Jog(AZ, PLUS)) == RESTING


# --- STOP from the console, the panel, the page


@pytest.mark.parametrize("order", MOVES, ids=str)
def test_while_latched_orders_have_no_effect(desk: Any, order: Order) -> None:
    desk.step(Aim(235, 60))
    assert desk.step(Stop(latch=True), by=desk.CONSOLE) == RESTING
    assert desk.status.latched == "console"
    desk.step(order)
    assert desk.run(20.0) == set()
    desk.step(Stop())
    desk.step(order)
    assert desk.run(5.0) == set(), "S on a link does not release what a person latched"


# --- S on one link, a stream on another


@pytest.mark.parametrize("by", [Release(), Stop()], ids=["resume", "S"])
@pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
def test_a_timed_list_does_not_go_on_after_a_fault_is_acknowledged(desk: Any, axis: Axis, by: Order) -> None:
    desk.step(LoadTimed(5.0, ((110, 20), (200, 30), (300, 40))), RunTimed())
    desk.run(2.0)
    desk.instead[axis] = None
    desk.run(2.0)
    assert desk.status.faults
    desk.instead.clear()
    desk.run(1.0)
    desk.step(by)
    assert desk.status.faults == ()
    other = EL if axis is AZ else AZ
    assert {moved for moved, _ in desk.run(20.0)} <= {other}, "it goes on to the point that it had been given"
    assert desk.run(20.0) == set()
    assert desk.step(RunTimed()) != RESTING, "the next point comes with T, and only then"


def test_a_timed_list_does_not_run_on_after_a_stop_from_elsewhere(desk: Any) -> None:
    desk.step(LoadTimed(1.0, ((110, None), (200, None), (300, None))), RunTimed(), by=desk.OTHER)
    desk.step(Stop(), by=desk.LINK)
    assert desk.run(10.0) == set()


def test_after_a_late_cycle_its_relay_rests_for_a_second(desk: Any) -> None:
    """The lease of 0.25 s has opened it. A computer that is late again and again would make it chatter."""
    desk.step(Aim(300.0, 0.0))
    desk.run(2.0)
    assert desk.step(seconds=0.2)[AZ] is PLUS
    assert desk.step(seconds=0.3)[AZ] is OFF
    assert not desk.run(0.9)
    assert (AZ, PLUS) in desk.run(0.3)
