"""The master relay of the relay bank feeds all motors: it closes with the first and lingers after the last."""

from __future__ import annotations

import pytest

from hw.drives.relays import MASTER_LINGER_S
from tests.hw.drives.relay_bench import AZ, EL, MASTER_PIN, PLUS, Bench


def test_the_master_closes_with_the_first_motor_and_lingers_after_the_last() -> None:
    bench = Bench(master=True)
    assert bench.on() == set()
    bench.drive(AZ, PLUS)
    assert bench.on() == {"azimuth_cw", "master"}
    bench.clock.sleep(0.3)
    assert bench.bank.due_s() == pytest.approx(110.25), "ten seconds after the last motor, as docs/wiring.md says"
    bench.clock.sleep(MASTER_LINGER_S - 0.06)
    assert bench.on() == {"master"}
    bench.clock.sleep(0.02)
    assert bench.on() == set()


def test_the_master_stays_while_a_motor_runs_long() -> None:
    bench = Bench(master=True)
    bench.run(AZ, PLUS, 3 * MASTER_LINGER_S)
    assert [edge.level for edge in bench.gpio.edges if edge.offset == MASTER_PIN] == [True]


def test_a_correction_within_the_linger_does_not_click_the_master() -> None:
    bench = Bench(master=True)
    for _ in range(5):
        bench.run(AZ, PLUS, 0.2)
        bench.clock.sleep(MASTER_LINGER_S - 0.1)
    assert [edge.level for edge in bench.gpio.edges if edge.offset == MASTER_PIN] == [True]


def test_without_its_supply_a_relay_that_may_be_closed_turns_nothing() -> None:
    bench = Bench(master=True)
    bench.run(AZ, PLUS, 0.5)
    bench.bank.unfeed(AZ)
    assert bench.on() == set()
    assert bench.bank.due_s() is None
    assert bench.drive(AZ, PLUS) is PLUS
    assert bench.on() == {"azimuth_cw", "master"}
    bench.bank.unfeed(AZ)
    assert bench.on() == set()


def test_the_supply_stays_for_the_other_motor_while_it_runs_or_is_looked_at() -> None:
    bench = Bench(master=True)
    bench.drive(EL, PLUS)
    bench.bank.unfeed(AZ)
    assert bench.on() == {"elevation_up", "master"}
    bench.clock.sleep(0.3)
    bench.bank.feed(EL, bench.clock() + 0.25)
    bench.bank.unfeed(AZ)
    assert bench.on() == {"master"}
    bench.clock.sleep(0.26)
    assert bench.on() == {"master"}, "it lingers after the run"
    bench.bank.unfeed(AZ)
    assert bench.on() == set()


def test_without_a_master_there_is_none_to_switch_off() -> None:
    bench = Bench()
    bench.drive(AZ, PLUS)
    bench.bank.unfeed(AZ)
    assert bench.on() == set()
