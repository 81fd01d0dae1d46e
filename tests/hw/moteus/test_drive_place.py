"""The moteus drive: when the place of an axis is known, and how a person confirms it."""

from __future__ import annotations

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from hw.moteus.axis import STALE_S
from hw.moteus.errands import ERRAND_S
from hw.ports import HardwareError
from tests.hw.moteus.drive_bench import AZ, Bench


def test_a_confirmation_that_cannot_be_delivered_is_forgotten_before_the_antenna_has_turned() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    bench.world.inject("azimuth-silent")
    bench.drive.confirm(AZ, 33.0, exactly=True)
    bench.clock.sleep(ERRAND_S + 0.1)
    bench.world.clear("azimuth-silent")
    bench.clock.sleep(1.0)
    assert bench.drive.sensor(AZ).read() == pytest.approx(123.0, abs=0.01)
    bench.world.inject("azimuth-silent")
    bench.clock.sleep(STALE_S + 0.1)
    with pytest.raises(HardwareError, match="does not answer"):
        bench.drive.confirm(AZ, 33.0)


def test_a_controller_that_lost_its_supply_is_queried_before_it_gets_an_order_to_move() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    bench.follow(AZ, 150.0, 1.0)
    bench.world.inject("azimuth-silent")
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(0.1)
    at_deg = bench.antenna(AZ)
    bench.world.clear("azimuth-silent")
    sent_rev = set()
    for _ in range(100):
        bench.clock.sleep(0.001)
        sent_rev.add(bench.world.controller("azimuth").motor.command[0x020])
    assert round(150.0 / 360, 6) not in {round(position_rev, 6) for position_rev in sent_rev}
    assert bench.antenna(AZ) == at_deg
