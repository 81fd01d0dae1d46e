"""A motor with a wedge brake, in the order of a Ham IV's box: release, wait, run; stop, rest, wait, engage."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction, HardwareError
from hw.safety.off_at_once import BRAKE_AFTER_S
from tests.hw.drives.brake_bench import AZ, TIMES, BrakeBench

MINUS, OFF, PLUS = Direction
LEVELS = pytest.mark.parametrize("active_low", [False, True], ids=["active-high", "active-low"])


@LEVELS
def test_the_brake_is_off_before_the_motor_and_holds_after_the_antenna_rests(active_low: bool) -> None:
    bench = BrakeBench(active_low=active_low)
    assert not bench.released
    assert bench.drive(PLUS) is OFF, "the motor waits for its brake"
    assert bench.released
    bench.clock.sleep(TIMES.release_s - 0.001)
    assert bench.drive(PLUS) is OFF
    bench.clock.sleep(0.001)
    assert bench.drive(PLUS) is PLUS
    bench.run(PLUS, 3.0)
    bench.drive(OFF)
    bench.clock.sleep(TIMES.held_off_s - 0.001)
    assert bench.released
    bench.clock.sleep(0.002)
    assert not bench.released
    bench.clock.sleep(1.0)
    assert bench.motor.shaft_deg > 190.0
    assert bench.harm == (0.0, 0)


def test_a_new_run_in_that_time_keeps_the_brake_off_and_starts_at_once() -> None:
    bench = BrakeBench()
    bench.run(PLUS, 2.0)
    bench.drive(OFF)
    bench.clock.sleep(TIMES.held_off_s - 0.5)
    assert bench.drive(PLUS) is PLUS
    bench.clock.sleep(1.0)
    assert bench.released


def test_an_order_that_is_taken_back_lets_the_brake_engage_again() -> None:
    bench = BrakeBench()
    bench.drive(PLUS)
    bench.drive(OFF)
    bench.clock.sleep(TIMES.engage_s + 0.001)
    assert not bench.released


def test_while_the_antenna_is_seen_to_turn_the_brake_waits() -> None:
    bench = BrakeBench()
    bench.run(PLUS, 2.0)
    bench.drive(OFF)
    for _ in range(40):  # the wind turns it
        bench.clock.sleep(0.5)
        bench.bank.seen_turning(AZ)
        assert bench.released
    bench.clock.sleep(TIMES.engage_s + 0.001)
    assert not bench.released


def test_the_other_axis_has_no_brake_and_does_not_wait() -> None:
    bench = BrakeBench()
    assert bench.bank.drive(Axis.ELEVATION, PLUS, bench.clock() + 0.2) is PLUS
    assert not bench.released


def test_a_program_that_ends_leaves_its_brake_engaged_within_the_time_it_gives() -> None:
    bench = BrakeBench()
    bench.run(PLUS, 2.0)
    bench.bank.leave(BRAKE_AFTER_S)
    assert bench.bank.driven()[AZ] is OFF
    assert bench.bank.released
    bench.clock.sleep(BRAKE_AFTER_S + 0.001)
    assert not bench.bank.released
    assert not bench.released


@pytest.mark.parametrize(
    ("active_low", "strict"),
    [(False, False), (True, False), (False, True)],
    ids=["kept, active-high", "kept, active-low", "given back to a pull-down"],
)
def test_after_the_programs_death_the_relays_open_and_then_the_brake_engages(active_low: bool, strict: bool) -> None:
    bench = BrakeBench(active_low=active_low)
    bench.gpio.strict = strict
    bench.run(PLUS, 3.0)
    seen: list[tuple[float, int, bool]] = []
    died_s = bench.clock()
    bench.gpio.on_edges.append(lambda at_s, changes: seen.extend((at_s, pin, on) for pin, on in changes.items()))
    bench.dies()
    off = [(at_s, pin) for at_s, pin, level in seen if level is active_low]
    assert {pin for at_s, pin in off if at_s < died_s + 0.1} >= {22}, "the motor's relay"
    assert off[-1] == (pytest.approx(died_s + 0.04 + BRAKE_AFTER_S), 27), "and the brake last"
    bench.clock.sleep(1.0)
    assert bench.harm == (0.0, 0)


def test_a_brake_that_holds_when_the_program_dies_is_left_alone() -> None:
    bench = BrakeBench()
    died_s = bench.clock()
    bench.dies()
    assert not bench.released
    assert bench.clock() < died_s + 0.1


def test_a_brakes_line_that_fails_starts_no_motor_and_is_switched_off_again() -> None:
    bench = BrakeBench()
    bench.outputs.fails = True
    with pytest.raises(HardwareError, match="gone"):
        bench.drive(PLUS)
    bench.outputs.fails = False
    bench.clock.sleep(0.01)
    assert not bench.bank.released
    assert bench.drive(PLUS) is OFF, "it begins anew"
