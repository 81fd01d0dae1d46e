"""A pass that is flown in place of a recognised stream: it goes on while the orders agree, and not a moment longer."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.flight import QUIET_S
from rotator.exchange.flight_order import AxisPlan, Fly, Stream
from rotator.exchange.orders import Aim, Jog, Leave, Mode, Nudge, Order, Park, Release, SetMode, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
BEGIN_S, RATE_DPS, LEVEL_DEG = 1000.0, 0.5, 10.0
"""The satellite of these tests goes clockwise from 100° at the desk's first moment, always 10° high."""


def azimuth_deg(at_s: float) -> float:
    return 100.0 + RATE_DPS * (at_s - BEGIN_S)


def flight(*, ahead_s: tuple[float, float] = (-1.0, 1.0), rounding_deg: float = 1.0) -> Fly:
    moments = [BEGIN_S - 10.0 + second for second in range(200)]
    return Fly(
        "ISS",
        tuple((at_s, azimuth_deg(at_s), LEVEL_DEG) for at_s in moments),
        AxisPlan(BEGIN_S, tuple(azimuth_deg(BEGIN_S + 0.5 * step) for step in range(300)), ()),
        AxisPlan(BEGIN_S, (LEVEL_DEG,) * 300, ()),
        stream=Stream(rounding_deg, ahead_s),
    )


def order(desk: Any, off_deg: float = 0.0, up_deg: float = 0.0) -> Aim:
    """The stream's next order: whole degrees of the path, and so far beside it."""
    return Aim(float(round(azimuth_deg(desk.now_s) + off_deg)), LEVEL_DEG + up_deg)


def recognised(desk: Any) -> str:
    return str(desk.status.recognised)


def stream(desk: Any, seconds: int) -> None:
    for _ in range(seconds):
        desk.step(order(desk))
        desk.run(0.95)


@pytest.fixture
def followed(desk: Any) -> Any:
    """A desk at which a stream has been recognised, and whose pass is flown."""
    stream(desk, 10)
    desk.step(flight())
    assert recognised(desk) == "ISS"
    return desk


def test_the_true_path_is_flown_while_the_orders_agree(followed: Any) -> None:
    stream(followed, 30)
    assert recognised(followed) == "ISS"
    assert followed.status.wanted_azimuth_deg == pytest.approx(azimuth_deg(followed.now_s), abs=0.2)
    assert followed.status.controlled_by == "gs232b#1"


@pytest.mark.parametrize(("up_deg", "stays"), [(2.0, True), (-2.0, True), (3.0, False), (-4.0, False), (60.0, False)])
def test_an_order_beyond_its_rounding_and_a_degree_and_a_half_is_obeyed_at_once(
    followed: Any, up_deg: float, stays: bool
) -> None:
    followed.step(order(followed, up_deg=up_deg))
    assert (recognised(followed) == "ISS") is stays
    if not stays:
        assert followed.status.wanted_elevation_deg == LEVEL_DEG + up_deg


@pytest.mark.parametrize("ahead_s", [-4.0, 4.0])
def test_the_clock_of_the_program_may_be_wrong(desk: Any, ahead_s: float) -> None:
    for _ in range(10):
        desk.step(order(desk, RATE_DPS * ahead_s))
        desk.run(0.95)
    desk.step(flight(ahead_s=(ahead_s - 1.0, ahead_s + 1.0)))
    for _ in range(20):
        desk.step(order(desk, RATE_DPS * ahead_s))
        desk.run(0.95)
        assert recognised(desk) == "ISS"
    assert desk.status.wanted_azimuth_deg == pytest.approx(azimuth_deg(desk.now_s), abs=0.2)


def test_a_clock_that_the_orders_have_excluded_explains_no_later_order(desk: Any) -> None:
    """Any of -6 to 6 s would do at first; after the orders of a right clock one 3° behind is a departure."""
    stream(desk, 10)
    desk.step(flight(ahead_s=(-6.0, 6.0)))
    stream(desk, 10)
    assert recognised(desk) == "ISS"
    desk.step(order(desk, off_deg=-5.0))
    assert recognised(desk) == ""


@pytest.mark.parametrize("names_its_turn", [Aim(460.0, LEVEL_DEG), Aim(285.0, 170.0)], ids=["overlap", "flipped"])
def test_an_order_that_names_its_turn_is_obeyed(followed: Any, names_its_turn: Aim) -> None:
    followed.step(names_its_turn)
    assert recognised(followed) == ""
    assert followed.status.wanted_azimuth_deg == names_its_turn.azimuth_deg


@pytest.mark.parametrize(
    "other",
    [
        Stop(),
        Stop((AZ,)),
        Jog(AZ, Direction.PLUS, 0.1),
        Park(),
        Aim(None, 20.0),
        Aim(104.0, LEVEL_DEG, engaged=False),
        Aim(104.0, LEVEL_DEG, place=True),
        SetMode(Mode.PARK),
        Nudge(AZ, 3.0),
        Leave(),
    ],
)
def test_any_other_order_ends_it(followed: Any, other: Order) -> None:
    followed.step(other)
    assert recognised(followed) == ""


@pytest.mark.parametrize("sender", ["OTHER", "CONSOLE"])
def test_an_order_of_another_takes_the_antenna_even_where_it_agrees(followed: Any, sender: str) -> None:
    source = getattr(followed, sender)
    followed.step(order(followed), by=source)
    assert recognised(followed) == ""
    assert followed.status.controlled_by == str(source)


# --- the plan takes a while: what has happened since stays in force


@pytest.mark.parametrize(
    "since",
    [Stop(), Stop(latch=True), Stop((EL,)), Park(), Aim(200.0, 40.0), Aim(105.0, None), SetMode(Mode.MANUAL)],
)
def test_a_plan_that_comes_too_late_moves_nothing(desk: Any, since: Order) -> None:
    stream(desk, 10)
    desk.step(since)
    before = desk.status.azimuth.target_deg, desk.status.elevation.target_deg
    desk.step(flight())
    assert recognised(desk) == ""
    assert (desk.status.azimuth.target_deg, desk.status.elevation.target_deg) == before


def test_a_plan_for_a_stream_that_has_lost_the_antenna_moves_nothing(desk: Any) -> None:
    stream(desk, 10)
    desk.step(Aim(200.0, 40.0), by=desk.CONSOLE)
    desk.step(flight())
    assert recognised(desk) == ""
    assert desk.status.controlled_by == "console"
    assert desk.status.azimuth.target_deg == 200.0


def test_before_any_order_a_plan_for_a_stream_moves_nothing(desk: Any) -> None:
    desk.step(flight())
    assert desk.run(5.0) == set()


def test_with_the_panels_nudge_the_orders_are_followed_as_they_are(desk: Any) -> None:
    desk.step(Nudge(AZ, 5.0), by=desk.CONSOLE)
    stream(desk, 10)
    desk.step(flight())
    assert recognised(desk) == ""


# --- how it ends


def test_a_program_that_falls_silent_leaves_the_antenna_standing(followed: Any) -> None:
    followed.run(QUIET_S + 1.0)
    assert recognised(followed) == ""
    followed.run(5.0)
    assert followed.run(30.0) == set()


def test_after_a_fault_no_motor_starts_without_an_order(followed: Any) -> None:
    followed.instead[AZ] = None
    followed.run(3.0)
    assert followed.status.faults
    assert recognised(followed) == ""
    del followed.instead[AZ]
    followed.run(1.0)
    followed.step(Release(), by=followed.CONSOLE)
    assert not followed.status.faults
    assert followed.run(20.0) == set()


def test_a_stream_that_departs_is_followed_on_its_way(new_desk: Any) -> None:
    """On the second turn of the overlap: the antenna does not turn back for a program that is a little elsewhere."""
    desk = new_desk(at=(370.0, 10.0))
    desk.step()

    def send(seconds: int, up_deg: float = 0.0) -> None:
        for _ in range(seconds):
            desk.step(order(desk, -90.0, up_deg))
            desk.run(0.95)

    send(10)
    plan = flight()
    rows = tuple((at_s, az_deg - 90.0, el_deg) for at_s, az_deg, el_deg in plan.path)
    second_turn = AxisPlan(BEGIN_S, tuple(angle_deg + 270.0 for angle_deg in plan.azimuth.angles_deg), ())
    desk.step(replace(plan, path=rows, azimuth=second_turn))
    assert recognised(desk) == "ISS"
    send(10)
    send(5, up_deg=3.0)
    assert recognised(desk) == ""
    assert desk.status.azimuth.target_deg > 370.0
