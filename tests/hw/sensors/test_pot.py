"""A pot as an angle sensor: the wiper's share of the supply, with and without a reference."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115 as SimAds1115
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.ads1115 import Ads1115
from hw.ports import HardwareError
from hw.sensors.pot import LEAST_REFERENCE_V, REFERENCE_EVERY_S, PotSensor, Reference

WIPER, SUPPLY = 0, 3
STEP = 125e-6 / 3.0


class Bench:
    """A pot on input 0, its supply on input 3."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.supply_v = 3.3
        self.share = 0.25
        self.supply_looks = 0
        self.bad_v: dict[int, float] = {}
        """By the number of the look at the supply: a bad sample."""
        self.wire = SimI2CBus(self.clock.sleep)
        chip = SimAds1115(self.clock)
        chip.inputs[WIPER] = lambda: self.share * self.supply_v
        chip.inputs[SUPPLY] = self._look
        self.wire.attach(0x48, chip)
        self.adc = Ads1115(SmbusI2C(self.wire, "bus 1"), 0x48, self.clock.sleep)

    def _look(self) -> float:
        self.supply_looks += 1
        return self.bad_v.get(self.supply_looks, self.supply_v)

    def ratiometric(self) -> PotSensor:
        return PotSensor(self.adc, WIPER, Reference(self.adc, SUPPLY, self.clock))


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_with_a_reference_it_does_not(bench: Bench) -> None:
    pot = bench.ratiometric()
    pot.read()
    bench.supply_v = 3.0
    bench.clock.sleep(REFERENCE_EVERY_S)
    assert pot.read() == pytest.approx(0.25, abs=STEP)


def test_two_pots_on_one_supply_read_it_about_once_a_second(bench: Bench) -> None:
    reference = Reference(bench.adc, SUPPLY, bench.clock)
    pots = [PotSensor(bench.adc, WIPER, reference), PotSensor(bench.adc, 1, reference)]
    for _ in range(100):  # five seconds at 20 Hz
        for pot in pots:
            pot.read()
        bench.clock.sleep(0.05)
    assert 4 <= bench.supply_looks <= 9, "the first time three times"


def test_a_supply_that_is_missing_is_said_and_not_divided_by(bench: Bench) -> None:
    pot = bench.ratiometric()
    bench.supply_v = LEAST_REFERENCE_V / 10
    with pytest.raises(HardwareError, match=r"the pots' supply reads 0\.05 V on input 3: is it wired\?"):
        pot.read()


def test_a_supply_that_comes_back_is_seen_at_the_next_reading(bench: Bench) -> None:
    pot = bench.ratiometric()
    bench.supply_v = 0.0
    for _ in range(2):
        with pytest.raises(HardwareError):
            pot.read()
    bench.supply_v = 3.3
    assert pot.read() == pytest.approx(0.25, abs=STEP)


@pytest.mark.parametrize("look", range(1, 9))
@pytest.mark.parametrize("bad_v", [0.0, 0.6, 1.5, 3.0, 3.6, 4.0])
def test_one_bad_sample_of_the_supply_shifts_no_pot(bench: Bench, look: int, bad_v: float) -> None:
    bench.bad_v = {look: bad_v}
    pot = bench.ratiometric()
    for _ in range(120):
        assert pot.read() == pytest.approx(0.25, abs=STEP)
        bench.clock.sleep(0.05)
    assert bench.supply_looks >= look
