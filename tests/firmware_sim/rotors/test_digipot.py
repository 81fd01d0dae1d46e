"""A control box of the ORBIT-360 kind: it follows its wiper, and stays still within its dead band."""

from __future__ import annotations

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.digipot import DigipotAxisSpec, SimDigipotRotor
from tests.tables import every_row


class Bench:
    def __init__(self, start_deg: float = 180.0) -> None:
        self.clock = SimClock()
        self.rotor = SimDigipotRotor(DigipotAxisSpec(8, start_deg), DigipotAxisSpec(7, 180.0), self.clock)
        self.device = self.rotor.spidev.SpiDev()
        self.device.open(0, 0)

    def write(self, step: int, seconds: float) -> float:
        self.device.xfer2([0x11, step])
        self.clock.sleep(seconds)
        return self.rotor.antenna()[0]


@every_row(("step", "starts"), [(128, 0), (129, 0), (127, 0), (130, 1), (126, 1)])
def test_the_dead_band_is_two_degrees(step: int, starts: int) -> None:
    bench = Bench()
    bench.write(step, 2.0)
    assert bench.rotor.azimuth.starts == starts


def test_at_power_on_it_turns_to_the_middle() -> None:
    bench = Bench(start_deg=0.0)
    bench.clock.sleep(40.0)
    assert bench.rotor.antenna()[0] == pytest.approx(178.0, abs=1.2)


def test_a_shut_down_chip_means_the_low_end() -> None:
    bench = Bench()
    bench.device.xfer2([0x21, 0])
    bench.clock.sleep(40.0)
    assert bench.rotor.antenna()[0] == pytest.approx(2.0, abs=1.2)
