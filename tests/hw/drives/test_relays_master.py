"""The master relay of the relay bank feeds all motors: it closes with the first and lingers after the last."""

from __future__ import annotations

import pytest

from hw.drives.motor_supply import MASTER_LINGER_S
from tests.hw.drives.relay_bench import AZ, EL, PLUS, Bench


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


def test_a_look_at_the_supply_ends_like_a_run() -> None:
    bench = Bench(master=True)
    for asked_s, lasts_s in ((0.25, 0.25), (60.0, 0.5)):
        bench.bank.feed(AZ, bench.clock() + asked_s)
        assert bench.on() == {"master"}
        assert bench.bank.supplied
        assert bench.bank.due_s() == pytest.approx(bench.clock() + lasts_s)
        bench.clock.sleep(lasts_s - 0.01)
        assert bench.on() == {"master"}
        bench.clock.sleep(0.01)
        assert bench.on() == set()
        assert not bench.bank.supplied
        assert bench.bank.due_s() is None
    bench.bank.feed(AZ, bench.clock())
    assert bench.on() == set(), "its time is over already"
    bench.bank.cut()
    bench.bank.feed(AZ, bench.clock() + 0.25)
    assert bench.on() == set(), "the supply was cut"
