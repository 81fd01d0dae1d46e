"""Which orders are refused outright, so that `W` gets its `?>` and rotctl its error."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import Axis, Direction
from rotator.control.admission import refusal
from rotator.control.sky.mount import Mount, Range
from rotator.faults import Missing
from rotator.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    Jog,
    LoadTimed,
    Order,
    Park,
    Release,
    RunTimed,
    Speed,
    Stop,
)
from rotator.status import AxisStatus, Status

MOUNT = Mount(Range(0, 350), Range(0, 180))
ALWAYS: list[Order] = [
    Stop(),
    Stop((Axis.AZIMUTH,)),
    Stop(latch=True),
    Release(),
    Jog(Axis.AZIMUTH, Direction.PLUS),
    Jog(Axis.ELEVATION, Direction.MINUS),
    ClearTimed(),
    Speed(1),
]


Lacks = tuple[Missing, ...]


def status(*, azimuth: Lacks = (), elevation: Lacks = (), moving: bool = False) -> Status:
    return Status(
        at_s=0.0,
        azimuth=AxisStatus(0, 350, angle_deg=100.0, moving=moving, missing=azimuth),
        elevation=AxisStatus(0, 180, angle_deg=10.0, missing=elevation),
    )


def refused(order: Order, *, azimuth: Lacks = (), elevation: Lacks = (), moving: bool = False) -> str:
    answer = refusal(order, status(azimuth=azimuth, elevation=elevation, moving=moving), MOUNT)
    return answer.reason if answer else ""


@pytest.mark.parametrize(
    "order", [*ALWAYS, Aim(235, 25), Aim(235, None), Park(), LoadTimed(1, ((10, 20),)), RunTimed()]
)
def test_a_commissioned_box_takes_every_order_it_can_carry_out(order: Order) -> None:
    assert not refused(order)
    assert not refused(order, moving=True)


@pytest.mark.parametrize("order", ALWAYS, ids=str)
def test_stop_release_and_jog_are_never_refused(order: Order) -> None:
    assert not refused(order, azimuth=(Missing.CALIBRATION,), elevation=(Missing.CALIBRATION,), moving=True)


# --- nobody has commissioned it


@pytest.mark.parametrize(
    "order", [Aim(235, 25), Aim(235, None), Aim(235, 25, engaged=False), Park(), LoadTimed(1, ((10, 20),))], ids=str
)
def test_an_uncalibrated_box_is_not_aimed_and_says_what_is_missing(order: Order) -> None:
    reason = refused(
        order,
        azimuth=(
            Missing.CALIBRATION,
            Missing.LIMITS,
        ),
        elevation=(Missing.CALIBRATION,),
    )
    assert reason.startswith("UNCALIBRATED")
    assert "calibration, limits" in reason


def test_one_uncalibrated_axis_keeps_the_other_from_nothing() -> None:
    assert not refused(Aim(235, 25), azimuth=(Missing.CALIBRATION,))
    assert not refused(Aim(235, 25), elevation=(Missing.CALIBRATION,))


def test_an_azimuth_alone_needs_the_azimuth() -> None:
    assert refused(Aim(235, None), azimuth=(Missing.LIMITS,))
    assert not refused(Aim(235, None), elevation=(Missing.LIMITS,))


def test_a_timed_list_of_azimuths_alone_needs_the_azimuth_too() -> None:
    assert refused(LoadTimed(1, ((10, None), (20, None))), azimuth=(Missing.LIMITS,))


def test_an_elevation_alone_needs_the_elevation() -> None:
    assert refused(Aim(None, 25), elevation=(Missing.LIMITS,))


# --- out of reach


@pytest.mark.parametrize("order", [Aim(355, 10), Aim(355, None), LoadTimed(1, ((10, 20), (355, 20)))], ids=str)
def test_a_direction_out_of_reach_is_refused_with_the_range(order: Order) -> None:
    assert refused(order) == "azimuth 355 is outside the rotor's range of 0 to 350 degrees"


def test_where_the_antenna_cannot_point_it_may_still_be_told_to_rest() -> None:
    # elevation below the horizon rests at its minimum, above 90° it is a direction: neither is out of reach
    assert not refused(Aim(100, -5))
    assert not refused(Aim(100, 150))


# --- calibrating


@pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
def test_no_calibration_while_anything_moves(axis: Axis) -> None:
    assert refused(Calibrate(axis, high_end=True), moving=True) == (
        f"{axis.value} cannot be calibrated while the antenna moves"
    )
    assert not refused(Calibrate(axis, high_end=True))


def test_only_an_axis_that_cannot_measure_takes_a_confirmed_angle() -> None:
    assert "nothing to confirm" in refused(Confirm(Axis.AZIMUTH, 42.0))
    told = status()
    told = replace(told, azimuth=replace(told.azimuth, confirmable=True))
    assert refusal(Confirm(Axis.AZIMUTH, 42.0), told, MOUNT) is None
