"""What the order in force is: which orders are repeated with the panel's nudges, and which are over."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.flight_order import PLAN_STEP_S, AxisPlan, Fly
from rotator.exchange.orders import BOTH, Aim, Jog, LoadTimed, Nudge, Order, Stop
from rotator.exchange.sources import Source
from rotator.views.sky_plot import aimed_at
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PANEL = Source("panel")


def targets(desk: Any) -> tuple[float | None, float | None]:
    return desk.status.azimuth.target_deg, desk.status.elevation.target_deg


@pytest.mark.parametrize("order", [Aim(200.0, 150.0), Aim(20.0, 150.0)])
def test_a_knob_turns_its_own_axis_alone_also_where_the_antenna_goes_over_the_top(desk: Any, order: Aim) -> None:
    desk.step(order)
    stays_deg = targets(desk)[0]
    for knob_deg in (40.0, 120.0, 0.0, 89.0, 180.0, 9.0):
        desk.step(Aim(None, knob_deg, place=True), by=PANEL)
        assert targets(desk) == pytest.approx((stays_deg, knob_deg))
        shown = desk.status
        assert (shown.wanted_azimuth_deg, shown.wanted_elevation_deg) == pytest.approx((stays_deg, knob_deg))
    desk.step(Aim(300.0, None, place=True), by=PANEL)
    assert targets(desk) == pytest.approx((300.0, 9.0))
    shown = desk.status
    assert (shown.wanted_azimuth_deg, shown.wanted_elevation_deg) == pytest.approx((300.0, 9.0))


def test_before_the_azimuth_has_been_read_the_first_turn_is_taken(new_desk: Any) -> None:
    desk = new_desk(at=(430.0, 10.0))
    desk.instead[AZ] = None
    desk.step(Aim(60.0, 10.0))
    assert targets(desk) == pytest.approx((60.0, 10.0))


def test_between_the_orders_of_a_stream_the_target_moves_on_and_stands_when_the_stream_ends(desk: Any) -> None:
    for second in range(6):
        desk.step(Aim(110.0 + 3.0 * second, 20.0))
        desk.run(0.95)
    target_deg = desk.status.azimuth.target_deg
    desk.run(0.5)
    assert desk.status.azimuth.target_deg > target_deg + 1.0
    desk.step(Aim(None, 30.0))
    target_deg = desk.status.azimuth.target_deg
    desk.run(1.0)
    assert desk.status.azimuth.target_deg == target_deg


OUTSIDE = KnownPath(((1000.0, 20.0, 0.0), (1060.0, 40.0, 10.0))).rows
BEYOND = AxisPlan(1000.0, (20.0, 900.0), ())
REFUSED: list[Order] = [
    Aim(190.0, None, place=True),
    Aim(190.0, None),
    Aim(190.0, 40.0),
    LoadTimed(2.0, ((190.0, 40.0),)),
    Fly("SO-50", OUTSIDE, BEYOND, BEYOND),
]


@pytest.mark.long
@every_row("order", REFUSED)
@every_row("streams", [False, True])
def test_what_is_refused_leaves_the_order_in_force_as_it_is_and_as_it_is_shown(
    new_desk: Any, order: Order, streams: bool
) -> None:
    """The axis's own angle is 370° where the display shows the 10° that were ordered; nothing points at 190°."""
    desk, twin = (new_desk(azimuth=(200.0, 540.0), at=(300.0, 10.0)) for _ in range(2))
    for each in (desk, twin):
        each.step()
        for second in range(5 if streams else 1):
            each.step(Aim(10.0 + 2.0 * second, 30.0))
            each.run(0.95)
    assert desk.status.azimuth.target_deg > 360.0
    desk.step(order, by=PANEL)
    twin.step()
    assert len(desk.controller.troubles) == 1
    for _ in range(100):
        shown = [(each.status.wanted_azimuth_deg, each.status.wanted_elevation_deg) for each in (desk, twin)]
        assert shown[0] == shown[1]
        assert targets(desk) == targets(twin)
        assert desk.driven == twin.driven
        desk.step()
        twin.step()


# --- what ends an order


@pytest.mark.parametrize("axes", [(AZ,), (EL,), BOTH], ids=lambda axes: "+".join(each.value for each in axes))
def test_a_stop_ends_the_motion_of_the_axes_that_it_names_and_of_no_other(desk: Any, axes: tuple[Axis, ...]) -> None:
    desk.step(Aim(200.0, 40.0))
    desk.run(1.0)
    driven = desk.step(Stop(axes))
    others = [axis for axis in Axis if axis not in axes]
    assert [axis for axis, way in driven.items() if way is not Direction.OFF] == others
    wanted = {AZ: desk.status.wanted_azimuth_deg, EL: desk.status.wanted_elevation_deg}
    for axis, ordered_deg in ((AZ, 200.0), (EL, 40.0)):
        assert (desk.status.axis(axis).target_deg is None) is (axis in axes)
        assert wanted[axis] == (None if axis in axes else ordered_deg)
    desk.run(60.0)
    for axis, ordered_deg in ((AZ, 200.0), (EL, 40.0)):
        assert (abs(desk.angle_deg[axis] - ordered_deg) < 5.0) is (axis not in axes)


HANDS = [Source("console", 1), Source("page", 1), Source("panel"), Source("gs232b", 1)]


@pytest.mark.parametrize("axis", [AZ, EL])
@pytest.mark.parametrize("hand", HANDS, ids=str)
def test_a_jog_leaves_the_other_axis_its_order(desk: Any, axis: Axis, hand: Source) -> None:
    """`W200 040`, then `L`; or a button on the page."""
    desk.step(Aim(200.0, 40.0))
    desk.run(1.0)
    desk.step(Jog(axis, Direction.PLUS, 1.0, held=True), by=hand)
    assert set(desk.driven.values()) == {Direction.PLUS}
    assert targets(desk) == ((None, 40.0) if axis is AZ else (200.0, None))
    assert aimed_at(desk.status) is None, "no target rides along with the axis that is turned by hand"
    desk.run(60.0)
    other, ordered_deg = (EL, 40.0) if axis is AZ else (AZ, 200.0)
    assert desk.angle_deg[other] == pytest.approx(ordered_deg, abs=4.0)
    desk.step(Jog(other, Direction.MINUS, 1.0, held=True), by=hand)
    desk.step(Jog(axis, Direction.PLUS, 1.0, held=True), by=hand)
    assert desk.driven == {axis: Direction.PLUS, other: Direction.MINUS}, "a second button does not end the first"


def test_an_order_that_is_not_engaged_stops_both_axes_and_is_shown(desk: Any) -> None:
    desk.step(Aim(200.0, 40.0))
    desk.run(1.0)
    driven = desk.step(Aim(10.0, 20.0, engaged=False))
    assert set(driven.values()) == {Direction.OFF}
    assert targets(desk) == (None, None)
    assert (desk.status.wanted_azimuth_deg, desk.status.wanted_elevation_deg) == (10.0, 20.0)


# --- a planned pass


def flown(desk: Any, *, over: bool = False, lasts_s: float = 60.0) -> None:
    """From 100° and 10° clockwise and up: 0.5 and 0.25 degrees a second; the path of the axes goes over the top."""
    moments_s = [desk.now_s + PLAN_STEP_S * count for count in range(round(lasts_s / PLAN_STEP_S) + 1)]
    rows = tuple((at_s, 100.0 + (at_s - desk.now_s) / 2, 10.0 + (at_s - desk.now_s) / 4) for at_s in moments_s)
    azimuths_deg = tuple(azimuth_deg + (180.0 if over else 0.0) for _, azimuth_deg, _ in rows)
    elevations_deg = tuple(180.0 - raised_deg if over else raised_deg for *_, raised_deg in rows)
    azimuth, elevation = (AxisPlan(desk.now_s, angles_deg, ()) for angles_deg in (azimuths_deg, elevations_deg))
    desk.step(Fly("SO-50", rows, azimuth, elevation))


def shown(desk: Any) -> tuple[float, float]:
    return desk.status.wanted_azimuth_deg, desk.status.wanted_elevation_deg


@pytest.mark.parametrize("over", [False, True])
def test_a_pass_is_flown_along_its_plan_and_the_display_shows_the_satellite(desk: Any, over: bool) -> None:
    flown(desk, over=over)
    assert desk.status.flown.name == "SO-50"
    desk.run(20.0)
    assert shown(desk) == pytest.approx((110.0, 15.0), abs=0.1)
    assert targets(desk) == pytest.approx((290.0, 165.0) if over else (110.0, 15.0), abs=0.3)


def test_a_pass_that_is_over_ends_and_the_antenna_stands(desk: Any) -> None:
    flown(desk, lasts_s=30.0)
    desk.run(29.0)
    assert desk.status.flown is not None
    desk.run(3.0)
    assert desk.status.flown is None
    stood = targets(desk)
    desk.step(Nudge(AZ, 3.0), by=PANEL)
    desk.run(10.0)
    assert targets(desk) == stood, "no order is in force that a nudge could shift"
