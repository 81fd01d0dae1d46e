"""The relay bank on simulated GPIO lines: the rules that no caller can bypass.

Off from the first instant; opposite relays never together; a reversal waits; everything goes off from any thread.
"""

from __future__ import annotations

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from tests.hw.drives.relay_bench import AZ, CHIP, EL, MINUS, OFF, PINS, PLUS, Bench

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


# --- everything off


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
