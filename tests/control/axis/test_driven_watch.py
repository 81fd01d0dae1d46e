"""An axis that is driven: how slow is standing, how much is the wrong way, and where standing is an end stop."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.exchange.faults import FaultKind
from tests.control.axis.watched_motor import WatchedMotor

MINUS, OFF, PLUS = Direction
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
STANDS, WRONG, END = "motor runs and pot stands still", "pot moves the wrong way", "end stop reached"


def known(at_deg: float = 200.0, **rotor: float) -> WatchedMotor:
    """An axis at rest at about that place, which has shown that it turns at 6°/s."""
    found = WatchedMotor(at_deg, **rotor)  # type: ignore[arg-type]
    found.look(2.0)
    for way in (PLUS, MINUS):
        found.run(way, 3.0)
        found.look(2.0)
    assert found.fault is None
    return found


def driven(rotor: WatchedMotor, way: Direction, seconds: float = 4.0) -> str:
    """The name of the fault that a run of so many seconds ends with; empty: none."""
    rotor.relays(way)
    fault = rotor.look(seconds)
    rotor.relays(OFF)
    return fault.name if fault else ""


@BOTH_WAYS
@pytest.mark.parametrize(("pace", "name"), [(0.0, STANDS), (0.15, STANDS), (0.35, ""), (1.0, "")])
def test_slower_than_a_quarter_of_its_speed_it_stands(way: Direction, pace: float, name: str) -> None:
    rotor = known(noise_deg=0.03)
    rotor.motor.pace = pace
    assert driven(rotor, way) == name


@BOTH_WAYS
@pytest.mark.parametrize(("pace", "name"), [(-0.3, STANDS), (-0.7, WRONG), (-1.0, WRONG)])
def test_half_of_its_speed_backwards_is_the_wrong_way(way: Direction, pace: float, name: str) -> None:
    rotor = known(noise_deg=0.03)
    rotor.motor.pace = pace
    assert driven(rotor, way) == name


@BOTH_WAYS
@pytest.mark.parametrize(("speed_dps", "name"), [(0.15, STANDS), (0.4, ""), (2.0, "")])
def test_in_its_first_runs_an_axis_may_be_very_slow(way: Direction, speed_dps: float, name: str) -> None:
    """A file that says 6°/s may be wrong: below 0.25°/s it stands."""
    rotor = WatchedMotor(speed_dps=speed_dps, noise_deg=0.02)
    rotor.look(2.0)
    assert driven(rotor, way, 8.0) == name


@BOTH_WAYS
@pytest.mark.parametrize(("inside_deg", "name"), [(6.0, STANDS), (4.0, END), (0.0, END)])
def test_within_five_degrees_of_the_limit_it_is_its_stop(way: Direction, inside_deg: float, name: str) -> None:
    rotor = WatchedMotor(450.0 - inside_deg if way > 0 else inside_deg, noise_deg=0.02)
    rotor.look(2.0)
    rotor.motor.stalled = True
    assert driven(rotor, way) == name


def test_the_fault_names_the_measured_value_and_the_limit() -> None:
    rotor = WatchedMotor(noise_deg=0.0)
    rotor.look(2.0)
    rotor.motor.stalled = True
    rotor.relays(PLUS)
    fault = rotor.look(4.0)
    assert fault is not None
    assert all(word in fault.measured for word in ("clockwise", "0.00°/s", "200.0°"))
    assert "0.25°/s" in fault.limit


def test_the_fault_of_the_wrong_way_names_its_speed() -> None:
    rotor = known(noise_deg=0.02)
    rotor.motor.reversed = True
    rotor.relays(MINUS)
    fault = rotor.look(2.0)
    assert fault is not None
    assert "counter-clockwise" in fault.measured
    assert fault.kind is FaultKind.WRONG_WAY


@BOTH_WAYS
def test_the_wrong_way_is_a_fault_within_a_second_so_that_it_does_not_go_far(way: Direction) -> None:
    rotor = known(noise_deg=0.1)
    rotor.motor.reversed = True
    rotor.relays(way)
    began_s = rotor.now_s
    while rotor.fault is None:
        rotor.look(0.05)
    assert rotor.now_s - began_s <= 1.0


@BOTH_WAYS
def test_a_slow_axis_that_stands_for_certain_is_a_fault_before_its_noise_is_averaged_out(way: Direction) -> None:
    """At 1°/s and 0.3° of noise the speed is known to a quarter of its limit only after 2.6 s."""
    rotor = WatchedMotor(speed_dps=1.0, believed_dps=1.0, noise_deg=0.3)
    rotor.look(2.0)
    for each in (PLUS, MINUS):
        assert rotor.run(each, 8.0) is None
        rotor.look(2.0)
    rotor.motor.stalled = True
    rotor.relays(way)
    began_s = rotor.now_s
    while rotor.fault is None and rotor.now_s < began_s + 10.0:
        rotor.look(0.05)
    assert rotor.now_s - began_s < 2.2
