"""The moteus drive: faults of its controllers, silence and the watchdog, and how a person ends them."""

from __future__ import annotations

from itertools import cycle

import pytest

from tests.tables import every_row

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.moteus.motor import Mode
from firmware_sim.rotors.moteus import FAULT_CODES
from hw.moteus.faults import FAULTS
from hw.moteus.orders import WATCHDOG_S
from hw.ports import Axis, HardwareError
from tests.hw.moteus.drive_bench import AZ, EL, Bench


@pytest.mark.long
@every_row(("name", "axis"), zip(sorted(FAULT_CODES), cycle(Axis)))
def test_each_fault_stops_its_axis_and_says_what_to_do(axis: Axis, name: str) -> None:
    bench = Bench()
    other = EL if axis is AZ else AZ
    bench.follow(axis, 60.0, 1.0)
    bench.world.inject(f"{axis.value}-{name}")
    at_deg = bench.antenna(axis)
    bench.clock.sleep(0.2)
    told = bench.drive.faults()
    fault = FAULTS[FAULT_CODES[name]]
    assert list(told) == [axis]
    assert told[axis].startswith("moteus ")
    assert fault.name in told[axis]
    assert fault.remedy in told[axis]
    with pytest.raises(HardwareError, match=r"then acknowledge it"):
        bench.follow(axis, 60.0, 0.2)
    bench.follow(other, 20.0, 3.0)
    assert bench.antenna(axis) == at_deg
    assert bench.antenna(other) == pytest.approx(20.0, abs=1e-3)


def test_a_fault_that_is_still_there_comes_back() -> None:
    bench = Bench(start_deg=(90.0, 0.0))
    bench.world.inject("azimuth-factory-bounds")
    bench.drive.aim(AZ, 95.0, 0.0, bench.clock() + 0.25)
    for _ in range(2):
        bench.clock.sleep(0.2)
        assert "started outside its position bounds (39)" in bench.drive.faults()[AZ]
        bench.drive.acknowledge(AZ)
        assert bench.drive.faults() == {}


def test_the_watchdog_stops_it_when_the_program_dies_and_a_person_wakes_it() -> None:
    bench = Bench()
    bench.follow(AZ, 300.0, 3.0)
    bench.alive = False
    bench.clock.sleep(WATCHDOG_S + 2.0)
    at_deg = bench.antenna(AZ)
    assert bench.mode(AZ) is Mode.TIMEOUT
    bench.alive = True
    bench.clock.sleep(0.5)
    assert "heard nothing for 0.5 s and stopped by itself" in bench.drive.faults()[AZ]
    with pytest.raises(HardwareError, match="acknowledge"):
        bench.follow(AZ, 300.0, 0.2)
    assert bench.antenna(AZ) == at_deg
    bench.drive.acknowledge(AZ)
    bench.clock.sleep(0.1)
    bench.follow(AZ, at_deg + 5.0, 3.0)
    assert bench.antenna(AZ) == pytest.approx(at_deg + 5.0, abs=1e-3)
