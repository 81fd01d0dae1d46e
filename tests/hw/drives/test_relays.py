"""The relay bank on simulated GPIO lines: the rules that no caller can bypass.

Off from the first instant; opposite relays never together; a reversal waits; everything goes off from any thread.
"""

from __future__ import annotations

import threading

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import RELAYS
from hw.ports import Axis, Direction
from tests.hw.drives.relay_bench import AZ, CHIP, DEAD_TIME_S, EL, MINUS, OFF, PINS, PLUS, Bench

BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
EACH_AXIS = pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)


# --- off from the very call that takes the lines


@pytest.mark.parametrize("active_low", [False, True], ids=["active-high", "active-low"])
@pytest.mark.parametrize("pins", [(4, 5, 6, 7), (22, 23, 24, 25)], ids=["pulled-up", "pulled-down"])
def test_off_in_the_very_call_that_takes_the_lines(active_low: bool, pins: tuple[int, ...]) -> None:
    gpio = SimGpio(SimClock())
    GpioOutputs(gpio, CHIP, dict(zip(PINS, pins, strict=True)), consumer="test", active_low=active_low)
    assert [gpio.level(pin) for pin in pins] == [active_low] * 4
    # Where the boot pull meant on this is the edge that ends it; where it meant off there is none at all.
    assert all(edge.level == active_low for edge in gpio.edges)
    assert len(gpio.edges) == (0 if active_low == (pins[0] < 9) else 4)


# --- a reversal waits out its dead time


@EACH_AXIS
@BOTH_WAYS
def test_a_reversal_opens_at_once_and_closes_after_the_dead_time(axis: Axis, way: Direction) -> None:
    bench = Bench()
    bench.drive(axis, way)
    assert bench.drive(axis, Direction(-way)) is OFF
    assert bench.on() == set()
    bench.clock.sleep(DEAD_TIME_S - 0.001)
    assert bench.drive(axis, Direction(-way)) is OFF
    bench.clock.sleep(0.001)
    assert bench.drive(axis, Direction(-way)) == -way
    assert bench.on() == {RELAYS[axis, Direction(-way)]}


def test_one_axis_does_not_wait_for_the_other() -> None:
    bench = Bench()
    bench.run(AZ, PLUS, 0.2)
    assert bench.drive(EL, MINUS) is MINUS
    assert bench.on() == {"elevation_down"}


# --- one motor at a time, for a small transformer


def test_while_one_motor_is_fed_the_other_is_not() -> None:
    bench = Bench(one_at_a_time=True)
    assert bench.drive(AZ, PLUS) is PLUS
    assert bench.drive(EL, MINUS) is OFF
    assert bench.on() == {"azimuth_cw"}
    assert bench.drive(AZ, PLUS) is PLUS, "the one that runs is not disturbed by the one that asks"
    bench.drive(AZ, OFF)
    assert bench.drive(EL, MINUS) is MINUS
    assert bench.drive(AZ, PLUS) is OFF, "the motor that runs first goes on, on either axis"
    assert bench.on() == {"elevation_down"}


def test_a_command_that_waits_is_not_remembered() -> None:
    bench = Bench(one_at_a_time=True)
    bench.drive(AZ, PLUS, 0.2)
    bench.drive(EL, MINUS, 0.5)
    bench.clock.sleep(0.3)
    assert bench.on() == set(), "nothing starts by itself"


def test_asked_for_in_turn_the_second_starts_when_the_first_has_expired() -> None:
    bench = Bench(one_at_a_time=True)
    bench.drive(AZ, PLUS, 0.2)
    for _ in range(10):
        bench.drive(EL, PLUS)
        bench.clock.sleep(0.05)
    assert bench.on() == {"elevation_up"}


def test_a_reversal_waits_for_the_dead_time_and_for_the_other_motor() -> None:
    bench = Bench(one_at_a_time=True)
    bench.run(AZ, PLUS, 1.0)
    bench.drive(EL, PLUS, 0.5)
    assert bench.drive(AZ, MINUS) is OFF
    bench.clock.sleep(DEAD_TIME_S)
    assert bench.on() == set()
    assert bench.drive(AZ, MINUS) is MINUS


# --- everything off


@pytest.mark.parametrize("master", [False, True])
def test_off_works_from_any_thread(master: bool) -> None:
    bench = Bench(master=master)
    bench.drive(AZ, PLUS)
    bench.drive(EL, MINUS)
    caller = threading.Thread(target=bench.bank.off)
    caller.start()
    caller.join(10.0)
    assert bench.on() == set()
    assert set(bench.bank.driven().values()) == {OFF}


def test_a_cut_takes_the_supply_and_keeps_it_until_restored() -> None:
    bench = Bench(master=True)
    bench.run(AZ, PLUS, 1.0)
    assert bench.bank.cut()
    assert bench.on() == set()
    assert bench.drive(EL, PLUS) is OFF
    assert bench.on() == set()
    bench.bank.restore()
    assert bench.on() == set(), "the supply comes with the next motor, not by itself"
    assert bench.drive(EL, PLUS) is PLUS
    assert bench.on() == {"elevation_up", "master"}


def test_without_a_master_a_cut_returns_false() -> None:
    bench = Bench()
    bench.drive(EL, PLUS)
    assert not bench.bank.cut()
    assert bench.drive(AZ, PLUS) is PLUS, "the other axis is not to suffer for nothing"
