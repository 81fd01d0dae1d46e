"""The master relay of the relay bank feeds all motors: it closes with the first and lingers after the last."""

from __future__ import annotations

import pytest

from hw.drives.relays import MASTER_LINGER_S
from tests.hw.drives.relay_bench import AZ, MASTER_PIN, PLUS, Bench


def test_the_master_closes_with_the_first_motor_and_lingers_after_the_last() -> None:
    bench = Bench(master=True)
    assert bench.on() == set()
    bench.drive(AZ, PLUS)
    assert bench.on() == {"azimuth_cw", "master"}
    bench.clock.sleep(0.3)
    assert bench.bank.due_s() == pytest.approx(100.25 + MASTER_LINGER_S)
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
