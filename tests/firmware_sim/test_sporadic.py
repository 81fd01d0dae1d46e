"""Faults of single readings, as a simulated rotor shows them to whoever reads it: how many are bad, and which."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from firmware_sim.sporadic import Sporadic
from rotator.assembly.simulation import simulated_rotor
from tests.rotors.rig import configured

ADC = 0x48


def struck(sporadic: Sporadic, times: int) -> list[int]:
    return [count for count in range(1, times + 1) if sporadic.strikes()]


def test_each_seventh_time() -> None:
    sporadic = Sporadic()
    sporadic.every = 7
    assert struck(sporadic, 30) == [7, 14, 21, 28]


# --- on a rotor


@pytest.fixture
def g5500() -> SimRotor:
    return simulated_rotor(configured("g5500"), SimClock(10.0), None, (90.0, 30.0))


def wiper(rotor: SimRotor, count: int) -> list[float]:
    return [rotor.wipers["azimuth"]() for _ in range(count)]


def test_a_crackling_wiper_reads_as_a_broken_wire_each_fifth_time(g5500: SimRotor) -> None:
    g5500.inject("azimuth-pot-crackles:5")
    volts = wiper(g5500, 20)
    assert [place for place, each in enumerate(volts, 1) if each == 0.0] == [5, 10, 15, 20]
    g5500.clear("azimuth-pot-crackles:5")
    assert min(wiper(g5500, 50)) > 0.1


def test_a_spike_is_plausible_and_far_off(g5500: SimRotor) -> None:
    usual = wiper(g5500, 1)[0]
    g5500.inject("azimuth-pot-spikes:4")
    volts = wiper(g5500, 40)
    far = [place for place, each in enumerate(volts, 1) if abs(each - usual) > 0.2]
    assert far == list(range(4, 41, 4))
    assert all(0.1 < each < 3.2 for each in volts)


def test_a_drift_grows_and_its_repair_ends_it(g5500: SimRotor) -> None:
    usual = wiper(g5500, 1)[0]
    g5500.inject("azimuth-pot-drifts")
    wiper(g5500, 1000)
    assert wiper(g5500, 1)[0] - usual > 0.05
    g5500.clear("azimuth-pot-drifts")
    assert wiper(g5500, 1)[0] == pytest.approx(usual, abs=0.02)


def test_a_chip_in_noise_answers_all_but_one_transfer_in_twenty(g5500: SimRotor) -> None:
    g5500.inject("adc-noisy:20")
    assert silent(g5500, 4000) == pytest.approx(200, rel=0.3)
    g5500.clear("adc-noisy")
    assert silent(g5500, 500) == 0


def silent(rotor: SimRotor, transfers: int) -> int:
    count = 0
    for _ in range(transfers):
        try:
            rotor.bus.read_byte(ADC)
        except OSError:
            count += 1
    return count
