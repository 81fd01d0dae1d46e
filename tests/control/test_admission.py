"""Which orders are refused outright, so that `W` gets its `?>` and rotctl its error."""

from __future__ import annotations

from dataclasses import replace

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.control.admission import refusal
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.motor import Trust
from rotator.exchange.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    Home,
    Jog,
    LoadTimed,
    Order,
    Park,
    RelaysChecked,
    Release,
    RunTimed,
    Speed,
    Stop,
)
from rotator.exchange.status import AxisStatus, Status
from tests.tables import every_row

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


@every_row("order", [*ALWAYS, Aim(235, 25), Aim(235, None), Park(), LoadTimed(1, ((10, 20),)), RunTimed()])
def test_a_commissioned_box_takes_every_order_it_can_carry_out(order: Order) -> None:
    assert not refused(order)
    assert not refused(order, moving=True)


@every_row("order", ALWAYS)
def test_stop_release_and_jog_are_never_refused(order: Order) -> None:
    assert not refused(order, azimuth=(Missing.CALIBRATION,), elevation=(Missing.CALIBRATION,), moving=True)


# --- an axis that was never commissioned


@every_row("order", [Aim(235, 25), Aim(235, None), Aim(235, 25, engaged=False), Park(), LoadTimed(1, ((10, 20),))])
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


def test_an_order_that_needs_an_uncalibrated_axis_is_refused() -> None:
    """A program that knows no elevation sends 0: it needs none."""
    assert refused(Aim(235, 25), azimuth=(Missing.CALIBRATION,)) == "UNCALIBRATED: azimuth needs calibration"
    assert refused(Aim(235, 25), elevation=(Missing.CALIBRATION,)) == "UNCALIBRATED: elevation needs calibration"
    assert not refused(Aim(235, 0), elevation=(Missing.CALIBRATION,))
    assert refused(Aim(235, 0), elevation=(Missing.HOMING,)).startswith("UNCALIBRATED: elevation needs homing")


FAULT = Fault(FaultKind.POT_JUMPS, Axis.AZIMUTH, "three times")


@every_row("axis", list(Axis))
@every_row(
    ("order", "needs"),
    [
        (Aim(235, 25), (Axis.AZIMUTH, Axis.ELEVATION)),
        (Aim(235, None), (Axis.AZIMUTH,)),
        (Aim(None, 25), (Axis.ELEVATION,)),
        (Aim(235, 0, engaged=False), ()),
        (Park(), (Axis.AZIMUTH, Axis.ELEVATION)),
        (Park(storm=True), ()),
        (LoadTimed(1, ((10, 20),)), (Axis.AZIMUTH, Axis.ELEVATION)),
        (LoadTimed(1, ((10, None),)), (Axis.AZIMUTH,)),
        (RunTimed(), (Axis.AZIMUTH,)),
        (Jog(Axis.AZIMUTH, Direction.PLUS), (Axis.AZIMUTH,)),
        (Jog(Axis.AZIMUTH, Direction.OFF, held=True), ()),
        (Stop(), ()),
        (Release(), ()),
    ],
)
def test_while_a_fault_stops_an_axis_an_order_that_needs_it_is_refused(
    order: Order, needs: tuple[Axis, ...], axis: Axis
) -> None:
    name = axis.value
    now, stopped = status(), replace(status().axis(axis), fault=replace(FAULT, axis=axis))
    now = replace(now, azimuth=stopped) if axis is Axis.AZIMUTH else replace(now, elevation=stopped)
    answer = refusal(order, now, MOUNT)
    assert (answer is not None) == (axis in needs)
    if answer is not None:
        assert (answer.reason, answer.faulty) == (f"{name} is stopped by a fault: pot jumps", True)


# --- out of reach


@pytest.mark.parametrize("order", [Aim(355, 10), Aim(355, None), LoadTimed(1, ((10, 20), (355, 20)))], ids=str)
def test_a_direction_out_of_reach_is_refused_with_the_range(order: Order) -> None:
    assert refused(order) == "azimuth 355 is outside the rotor's range of 0 to 350 degrees"


def test_an_elevation_that_rests_at_its_limit_or_names_a_direction_is_admitted() -> None:
    # elevation below the horizon rests at its minimum, above 90° it is a direction: neither is out of reach
    assert not refused(Aim(100, -5))
    assert not refused(Aim(100, 150))


@every_row(
    ("order", "reason"),
    [
        (Aim(541, 10), "azimuth 541 is outside -180 to 540 degrees"),
        (Aim(-181, None), "azimuth -181 is outside -180 to 540 degrees"),
        (Aim(100, 181), "elevation 181 is outside -90 to 180 degrees"),
        (Aim(100, -91), "elevation -91 is outside -90 to 180 degrees"),
        (Aim(None, 181), "elevation 181 is outside -90 to 180 degrees"),
        (LoadTimed(1, ((10, 20), (20, 200))), "elevation 200 is outside -90 to 180 degrees"),
    ],
)
def test_no_program_may_send_an_angle_that_no_rotor_has(order: Order, reason: str) -> None:
    answer = refusal(order, status(), MOUNT)
    assert answer is not None
    assert (answer.reason, answer.out_of_range) == (reason, True)


def test_the_last_angles_that_may_be_sent_are_no_mistake_of_the_sender() -> None:
    wide = Mount(Range(-180, 540), Range(-90, 180))
    for order in (Aim(540, 180), Aim(-180, -90)):
        assert refusal(order, status(), wide) is None


def test_one_coordinate_over_the_top_is_looked_at_with_the_other_one_as_it_goes() -> None:
    """Elevation goes to 150 at azimuth 200: that is azimuth 20 at 30. Azimuth alone then keeps the 30."""
    narrow = Mount(Range(0, 350), Range(0, 180), flip=True)
    over = status()
    over = replace(
        over,
        azimuth=replace(over.azimuth, target_deg=200.0),
        elevation=replace(over.elevation, target_deg=150.0),
    )
    assert refusal(Aim(None, 40), over, narrow) is None
    # Azimuth 175 is reached over the top alone on this rotor, and only with an elevation to turn round.
    half = Mount(Range(180, 360), Range(0, 180), flip=True)
    assert refusal(Aim(10, None), over, half) is None
    # Without the way over the top azimuth 20 is out of reach: within this range it needs an elevation of 140.
    answer = refusal(Aim(None, 40), over, replace(half, azimuth=Range(180, 350), flip=False))
    assert answer is not None
    assert answer.reason.startswith("azimuth 20 is outside")
    level = replace(over, elevation=replace(over.elevation, target_deg=None, angle_deg=None))
    answer = refusal(Aim(10, None), level, half)
    assert answer is not None, "where elevation is not known, there is none to turn round"
    assert answer.out_of_range


def test_what_needs_a_person_at_the_rotor_says_so() -> None:
    assert refused(Home(Axis.ELEVATION)) == "elevation knows its angle: it needs no homing"
    counted = status()
    counted = replace(counted, elevation=replace(counted.elevation, source=AngleSource.COUNTED))
    lost = replace(counted, elevation=replace(counted.elevation, missing=(Missing.HOMING,)))
    told = refusal(Home(Axis.ELEVATION), lost, MOUNT)
    assert told is not None, "a counted axis without an end stop"
    assert "no end stop to find" in told.reason
    counted = replace(counted, elevation=replace(counted.elevation, homeable=True))
    assert refusal(Home(Axis.ELEVATION), counted, MOUNT) is None
    answer = refusal(Calibrate(Axis.AZIMUTH, high_end=True), status(moving=True), MOUNT)
    assert answer is not None
    assert not answer.out_of_range


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


def test_the_angle_of_an_axis_that_turns_is_not_confirmed_but_that_of_the_other_is() -> None:
    told = status()
    axis = replace(told.azimuth, confirmable=True)
    told = replace(told, azimuth=replace(axis, moving=True), elevation=replace(axis, moving=False))
    refused = refusal(Confirm(Axis.AZIMUTH, 42.0), told, MOUNT)
    assert refused is not None
    assert "azimuth turns: stop it" in refused.reason
    assert refusal(Confirm(Axis.ELEVATION, 42.0), told, MOUNT) is None


def relays_checked(azimuth: AxisStatus) -> str:
    answer = refusal(RelaysChecked(Axis.AZIMUTH), replace(status(), azimuth=azimuth), MOUNT)
    return answer.reason if answer else ""


def test_relays_are_looked_at_only_where_it_matters_and_the_axis_stands() -> None:
    healthy = AxisStatus(0, 350, angle_deg=100.0, trusts=(Trust.OPEN, Trust.UNSEEN))
    assert relays_checked(healthy) == "nothing is in doubt about the relays of azimuth"
    assert relays_checked(replace(healthy, moving=True)) == (
        "azimuth turns: its relays can be looked at when it stands; `rotator stop` stops it"
    )
    fault = Fault(FaultKind.RELAY_UNSEEN, Axis.AZIMUTH, "the relay clockwise is off, and it stands at 350°")
    for doubted in (
        replace(healthy, trusts=(Trust.OPEN, Trust.DOUBTED)),
        replace(healthy, trusts=(Trust.WELDED, Trust.OPEN)),
        replace(healthy, waiting=True),
        replace(healthy, fault=fault),
    ):
        assert relays_checked(doubted) == ""
        assert relays_checked(replace(doubted, moving=True)), "not while it turns"


@every_row("storm", [False, True])
@every_row(
    ("park_deg", "told"),
    [
        ((355.0, 0.0), "azimuth 355 is outside the rotor's range of 0 to 350 degrees"),
        ((0.0, -5.0), "elevation -5 is outside the rotor's range of 0 to 180 degrees"),
        ((100.0, 10.0), "it lies in a forbidden sector"),
        ((90.0, 0.0), ""),
    ],
)
def test_a_park_position_that_cannot_be_reached_is_refused(
    park_deg: tuple[float, float], told: str, *, storm: bool
) -> None:
    mast = Sector("the mast", Range(95, 120), Range(0, 40), 2.0)
    mount = replace(MOUNT, park_azimuth_deg=park_deg[0], park_elevation_deg=park_deg[1], sectors=(mast,))
    answer = refusal(Park(storm=storm), status(), mount)
    assert (answer.reason if answer else "") == (told and f"the park position cannot be reached: {told}")
