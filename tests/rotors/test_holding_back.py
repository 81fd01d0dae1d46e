"""What every rotor does not do: go on without a control thread, move with a fault, turn past a limit switch.

One suite for all kinds. The fault that every kind can have is a control thread that gets no turn.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from hw.drives.leases import LONGEST_LEASE_S
from hw.ports import Axis, Direction
from rotator.control.commands import HOLD, Command, Run, Steer
from rotator.exchange.orders import Aim, Jog, Order, Release, Stop
from tests.rotors.rig import AZ, EL, PERSON, Box, Kind

MINUS, OFF, PLUS = Direction
NewBox = Callable[..., Box]
EACH_AXIS = pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
LIMITS = {"azimuth_low": 5, "azimuth_high": 6, "elevation_low": 12, "elevation_high": 13}
BELOW = {"azimuth": {"home_deg": -2.0}, "elevation": {"home_deg": -2.0}}
"""A low limit switch of an axis that counts is below its range."""
NO_DISPLAY = {"kind": "none"}


def turning(box: Box) -> None:
    """Azimuth and elevation on their way up, for long enough to be at full speed."""
    box.order(Aim(100.0, 40.0))
    box.until_it_stands()
    box.order(Jog(AZ, PLUS), Jog(EL, PLUS))
    box.run(0.8)


def stands_still(box: Box, seconds: float = 3.0) -> bool:
    """Without the control thread nothing moves now."""
    before_deg = box.world.shafts()
    box.left_alone(seconds)
    return box.world.shafts() == pytest.approx(before_deg, abs=max(0.01, box.kind.trembles_deg))


def once(box: Box, axis: Axis) -> Command:
    """A command that leads far away, and asks to live for ever."""
    if box.config.rotor.switched:
        return Run(PLUS, box.clock() + 3600.0)
    return Steer(box.config.axis(axis).max_deg - 1.0, 0.0, box.clock() + 3600.0)


# --- commands expire


@EACH_AXIS
def test_a_command_that_nobody_renews_expires(box: Box, axis: Axis) -> None:
    box.order(Aim(100.0, 40.0))
    box.until_it_stands()
    from_deg, speed_dps = box.shaft_deg(axis), box.config.axis(axis).speed_dps
    box.rotor.obey(axis, once(box, axis))
    box.left_alone(3.0)
    moved_deg = box.shaft_deg(axis) - from_deg
    assert 0.5 < moved_deg <= LONGEST_LEASE_S * speed_dps * 1.1 + box.kind.run_on_deg
    assert stands_still(box)


def test_a_control_thread_that_is_gone_leaves_nothing_turning(box: Box) -> None:
    turning(box)
    assert not stands_still(box, 1.0)
    box.left_alone(2.0)
    assert stands_still(box)


# --- off


def test_off_in_mid_move_is_the_end_of_it(box: Box) -> None:
    turning(box)
    box.rotor.off()
    box.rotor.off()
    from_deg = box.world.shafts()
    box.left_alone(3.0)
    for was_deg, is_deg in zip(from_deg, box.world.shafts(), strict=True):
        assert is_deg - was_deg <= box.kind.run_on_deg
    assert stands_still(box)


def test_off_at_any_moment_keeps_nobody_from_going_on(box: Box) -> None:
    box.order(Aim(120.0, 60.0))
    every_s = 0.5 if box.kind.profile == "slew-drive" else 0.13  # it gathers speed slowly: in less it goes nowhere
    for _ in range(25):
        box.run(every_s)
        box.rotor.off()
        for axis in Axis:
            box.rotor.obey(axis, HOLD if not box.config.rotor.switched else Run(OFF, 0.0))
    box.until_it_stands()
    assert box.boom_deg(AZ) == pytest.approx(120.0, abs=box.kind.within_deg)
    assert box.boom_deg(EL) == pytest.approx(60.0, abs=box.kind.within_deg)
    assert box.status.faults == ()


# --- a fault


def without_a_turn(box: Box) -> None:
    """The control thread has been away for a second while both axes were turning."""
    turning(box)
    box.left_alone(1.0)
    box.run(0.3)
    assert [fault.name for fault in box.status.faults] == ["control thread late"] * 2


@pytest.mark.parametrize(
    "order", [Aim(60.0, 20.0), Jog(AZ, MINUS), Jog(EL, PLUS)], ids=lambda order: type(order).__name__
)
def test_with_a_fault_nothing_moves(box: Box, order: Order) -> None:
    for _ in range(6):  # each within ten minutes takes a second longer to pass by itself
        box.order(Release(), by=PERSON)
        box.run(0.5)
        without_a_turn(box)
    box.until_it_stands()
    before_deg = box.world.shafts()
    box.order(order)
    box.run(2.0)
    assert box.world.shafts() == pytest.approx(before_deg, abs=max(0.01, box.kind.trembles_deg))
    assert len(box.status.faults) == 2


# --- limit switches


@EACH_AXIS
def test_a_limit_switch_stops_that_way_and_not_the_other(kind: Kind, new_box: NewBox, axis: Axis) -> None:
    if kind.profile == "tv-rotator":
        pytest.skip("its own end switches are all that it has")
    box = new_box(kind, limits=LIMITS, pulses=BELOW, lcd=NO_DISPLAY)
    box.run(1.0)
    box.order(Aim(100.0, 40.0))
    box.until_it_stands()
    box.order(Jog(axis, PLUS))
    box.run(0.8)
    box.world.inject(f"{axis.value}-high-switch-open")
    box.run(2 * box.period_s)
    assert [(fault.name, fault.axis) for fault in box.status.faults] == [("limit switch reached", axis)]
    opened_deg = box.shaft_deg(axis)
    box.until_it_stands()
    assert box.shaft_deg(axis) - opened_deg <= kind.run_on_deg
    stood_deg = box.shaft_deg(axis)
    box.order(Stop(), Jog(axis, PLUS))
    box.run(3.0)
    assert box.shaft_deg(axis) == pytest.approx(stood_deg, abs=max(0.01, kind.trembles_deg))
    assert box.axis(axis).fault is not None, "the switch is still open"
    box.order(Stop(), Jog(axis, MINUS, 4.0))
    box.run(5.0)
    assert box.shaft_deg(axis) < stood_deg - 1.0
    box.world.clear(f"{axis.value}-high-switch-open")
    box.order(Stop(), Aim(100.0, 60.0))
    box.until_it_stands()
    assert box.boom_deg(EL) == pytest.approx(60.0, abs=kind.within_deg)


def test_closed_limit_switches_are_in_nobody_s_way(kind: Kind, new_box: NewBox) -> None:
    if kind.profile == "tv-rotator":
        pytest.skip("its own end switches are all that it has")
    box = new_box(kind, limits=LIMITS, pulses=BELOW, lcd=NO_DISPLAY)
    box.run(1.0)
    for azimuth_deg, elevation_deg in ((kind.short_deg, kind.short_deg), (30.0, 20.0)):
        box.order(Aim(azimuth_deg, elevation_deg))
        box.until_it_stands()
        assert box.boom_deg(AZ) == pytest.approx(azimuth_deg, abs=kind.within_deg)
        assert box.status.faults == ()
