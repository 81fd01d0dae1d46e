"""What every rotor does with orders: nothing before the first, then it goes there, and stands.

One suite for all kinds: each test runs on every one of them, from its shipped configuration.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from hw.ports import Axis, Direction
from rotator.control.sky.angles import great_circle_deg
from rotator.exchange.orders import Aim, Jog, Nudge, Stop
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus
from tests.rotors.rig import AZ, EL, Box, Kind, all_but, configured

MINUS, OFF, PLUS = Direction
PANEL = Source("panel")
NewBox = Callable[..., Box]
PRESS_DEG = 12.0
"""A jog that lasts for so much of the axis's travel at its speed."""
EACH_AXIS = pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


def arrived(box: Box, azimuth_deg: float, elevation_deg: float) -> bool:
    """Where the antenna really is, within what the kind can do; and the status says so too."""
    near = [abs(box.boom_deg(AZ) - azimuth_deg), abs(box.boom_deg(EL) - elevation_deg)]
    said = [abs((box.axis(axis).angle_deg or 0.0) - box.boom_deg(axis)) for axis in Axis]
    return max(near + said) <= box.kind.within_deg


# --- before an order


def test_nothing_moves_before_an_order(kind: Kind, new_box: NewBox) -> None:
    box = new_box(kind)
    box.run(10.0)
    box.order(Stop())
    box.run(1.0)
    assert box.world.antenna() == pytest.approx(kind.start_deg, abs=1e-6)
    assert box.world.relay_starts in (None, 0)
    assert (box.status.moving, box.status.faults, box.status.wanted_azimuth_deg) == (False, (), None)


# --- aims


@EACH_AXIS
@pytest.mark.parametrize("elevation_deg", [20.0, 65.0])
@pytest.mark.parametrize("beside_deg", [3.0])
def test_a_nudge_moves_what_it_says(box: Box, axis: Axis, elevation_deg: float, beside_deg: float) -> None:
    """An index of 5° after the other, also where the tolerance is wider, or lets the antenna rest beside its order."""
    at_deg = {AZ: 120.0, EL: elevation_deg}
    box.order(Aim(at_deg[AZ], at_deg[EL]))
    box.until_it_stands()
    at_deg[axis] += beside_deg
    box.order(Aim(at_deg[AZ], at_deg[EL]))
    box.until_it_stands()
    for index in (1, 2, 1, 0, -1, -2, 0):
        box.order(Nudge(axis, 5.0 * index), by=PANEL)
        box.until_it_stands()
        wanted_deg = {each: at_deg[each] + (5.0 * index if each is axis else 0.0) for each in Axis}
        assert box.boom_deg(axis) == pytest.approx(wanted_deg[axis], abs=box.kind.within_deg)
    # After a stop on the way nothing of it is left: an order within the tolerance moves nothing.
    box.order(Nudge(axis, 20.0), by=PANEL)
    box.run(1.0)
    box.order(Stop())
    box.until_it_stands()
    stood_deg = box.world.shafts()
    if (box.axis(axis).tolerance_deg or 0.0) > 0.0:
        box.order(Nudge(axis, 0.0), by=PANEL)
        box.order(Aim(box.axis(AZ).angle_deg, box.axis(EL).angle_deg))
        box.until_it_stands()
        assert box.world.shafts() == pytest.approx(stood_deg, abs=box.kind.trembles_deg)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_orders_that_turn_it_round_on_its_way_are_no_fault(kind: Kind, new_box: NewBox, seed: int) -> None:
    chance = random.Random(seed)
    for _ in range(3):
        box = new_box(kind, (chance.uniform(60.0, 300.0), chance.uniform(20.0, 70.0)))
        box.run(1.0)
        for _ in range(6):
            box.order(Aim(chance.uniform(20.0, 340.0), chance.uniform(5.0, 85.0)))
            box.run(chance.uniform(0.3, 6.0))
        assert box.status.faults == ()


def test_a_target_that_moves_is_followed(box: Box) -> None:
    box.order(Aim(100.0, 40.0))
    box.until_it_stands()
    off_deg: list[float] = []
    for second in range(30):
        box.order(Aim(100.0 + 0.5 * second, 40.0 + 0.25 * second))
        box.run(1.0)
        if second > 10:
            target_deg = (100.0 + 0.5 * (second + 1), 40.0 + 0.25 * (second + 1))
            off_deg.append(great_circle_deg(*target_deg, box.boom_deg(AZ), box.boom_deg(EL)))
    # A switched motor waits till its tolerance is used up; the others have theirs all the time.
    allowed_deg = box.kind.within_deg + (0.5 if not box.config.rotor.switched else box.config.azimuth.tolerance_deg)
    assert max(off_deg) <= allowed_deg
    assert box.status.faults == ()


# --- jogs


@EACH_AXIS
@BOTH_WAYS
def test_a_jog_turns_the_right_way_and_ends_by_itself(box: Box, axis: Axis, way: Direction) -> None:
    box.order(Aim(100.0, 45.0))
    box.until_it_stands()
    from_deg = {axis: box.shaft_deg(axis) for axis in Axis}
    seconds = PRESS_DEG / box.config.axis(axis).speed_dps
    box.order(Jog(axis, way, seconds))
    box.run(0.9 * seconds)
    assert (box.shaft_deg(axis) - from_deg[axis]) * way > 1.0
    assert box.axis(axis).moving
    box.until_it_stands()
    assert 1.0 < (box.shaft_deg(axis) - from_deg[axis]) * way < 1.1 * PRESS_DEG + box.kind.run_on_deg
    for each in Axis:
        moved_deg = abs(box.shaft_deg(each) - from_deg[each])
        assert each is axis or moved_deg <= max(0.01, box.kind.trembles_deg)


@all_but()
@EACH_AXIS
@BOTH_WAYS
def test_a_jog_ends_at_the_limit(kind: Kind, new_box: NewBox, axis: Axis, way: Direction) -> None:
    limits = configured(kind.profile).axis(axis)
    near_deg = limits.max_deg - 25.0 if way is PLUS else limits.min_deg + 25.0
    box = new_box(kind, (near_deg, kind.start_deg[1]) if axis is AZ else (kind.start_deg[0], near_deg))
    box.run(1.0)
    box.order(Aim(near_deg, None) if axis is AZ else Aim(None, near_deg))
    box.until_it_stands()
    box.order(Jog(axis, way))
    box.until_it_stands()
    end_deg = limits.max_deg if way is PLUS else limits.min_deg
    assert (box.shaft_deg(axis) - end_deg) * way <= max(0.5, kind.trembles_deg), "it went beyond its limit"
    short_deg = kind.short_deg if way is MINUS else 0.0
    assert box.shaft_deg(axis) == pytest.approx(end_deg, abs=short_deg + kind.within_deg + 0.5)
    assert box.status.faults == ()


def test_no_order_leads_beyond_the_limits(box: Box) -> None:
    limits = {axis: box.config.axis(axis) for axis in Axis}
    beyond_deg: list[float] = []

    def look(_now_s: float) -> None:
        for axis in Axis:
            shaft_deg = box.shaft_deg(axis)
            beyond_deg.append(max(shaft_deg - limits[axis].max_deg, limits[axis].min_deg - shaft_deg))

    box.clock.every(0.05, look)
    client = box.client()
    for order in (Aim(limits[AZ].max_deg, 300.0), Aim(0.0, -30.0), Aim(720.0, 20.0)):
        client.order(order)
        box.until_it_stands()
    assert max(beyond_deg) <= max(0.5, box.kind.trembles_deg)


# --- stops


def at_full_speed(box: Box) -> None:
    box.order(Aim(100.0, 45.0))
    box.until_it_stands()
    box.order(Jog(AZ, PLUS), Jog(EL, PLUS))
    box.run(1.2)


def test_stop_stops_at_once(box: Box) -> None:
    at_full_speed(box)
    assert box.axis(AZ).moving
    box.order(Stop())
    box.loop.act()
    # A bridge goes on feeding its motor while it brakes.
    assert box.world.relay_starts is None or box.world.drives() == (0, 0)
    stopped_deg = box.world.shafts()
    box.until_it_stands()
    for was_deg, is_deg in zip(stopped_deg, box.world.shafts(), strict=True):
        assert -box.kind.trembles_deg <= is_deg - was_deg <= box.kind.run_on_deg
    assert (box.axis(AZ).target_deg, box.axis(EL).target_deg) == (None, None)


# --- the scale


@pytest.mark.parametrize("axis_tables", [True, False], ids=["mounted-askew", "magnetic-north"])
def test_offsets_shift_what_is_reported_and_what_is_ordered(kind: Kind, new_box: NewBox, axis_tables: bool) -> None:
    plain = new_box(kind)
    by_deg = (20.0, 5.0) if axis_tables else (-7.5, 0.0)
    tables: dict[str, dict[str, object]] = {"mount": {"north": "magnetic", "declination_deg": -7.5}}
    if axis_tables:
        tables = {"azimuth": {"offset_deg": 20.0}, "elevation": {"offset_deg": 5.0}}
    shifted = new_box(kind, **tables)
    for box in (plain, shifted):
        box.run(1.0)
    for axis, shift_deg in zip(Axis, by_deg, strict=True):
        before, after = plain.axis(axis), shifted.axis(axis)
        assert shown_deg(after) - shown_deg(before) == pytest.approx(shift_deg, abs=0.5)
        assert after.min_deg - before.min_deg == after.max_deg - before.max_deg == shift_deg
    plain.order(Aim(120.0, 60.0))
    shifted.order(Aim(120.0 + by_deg[0], 60.0 + by_deg[1]))
    for box in (plain, shifted):
        box.until_it_stands()
    assert shifted.world.antenna() == pytest.approx(plain.world.antenna(), abs=2 * kind.within_deg)
    assert arrived(shifted, 120.0 + by_deg[0], 60.0 + by_deg[1])


def shown_deg(axis: AxisStatus) -> float:
    assert axis.angle_deg is not None
    return axis.angle_deg
