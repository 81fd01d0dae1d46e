"""A relay board: coils follow their lines, the master feeds both motors, and starts are counted."""

from __future__ import annotations

import threading

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.relays import RelayPins, SimRelays

MOTOR = MotorSpec(
    speed_dps=6.0, lag_s=0.0, relay_delay_s=0.015, backlash_deg=0.0, stop_low_deg=0.0, stop_high_deg=360.0
)
CW, CCW, UP, DOWN, MASTER = 22, 23, 24, 25, 26


class Bench:
    def __init__(self, *, active_low: bool = False, master: int | None = None) -> None:
        self.clock = SimClock()
        self.gpio = SimGpio(self.clock)
        self._on = not active_low
        for pin in (CW, CCW, UP, DOWN, MASTER):
            self.gpio.drive_input(pin, not self._on)
        self.azimuth, self.elevation = SimMotor(MOTOR, 180.0, 0.0), SimMotor(MOTOR, 45.0, 0.0)
        self.relays = SimRelays(
            RelayPins(CW, CCW, UP, DOWN, master),
            self.gpio,
            (self.azimuth, self.elevation),
            self.clock(),
            threading.RLock(),
            active_low=active_low,
        )

    def switch(self, pin: int, on: bool, seconds: float = 0.0) -> None:
        self.gpio.drive_input(pin, on is self._on)
        self.clock.sleep(seconds)
        for motor in (self.azimuth, self.elevation):
            motor.advance(self.clock())


@pytest.mark.parametrize("active_low", [False, True])
def test_a_motor_follows_its_relays_after_their_delay(active_low: bool) -> None:
    bench = Bench(active_low=active_low)
    bench.switch(CW, True, 1.015)
    assert (bench.relays.drives(), bench.relays.starts) == ((1, 0), 1)
    assert (bench.azimuth.shaft_deg, bench.elevation.shaft_deg) == pytest.approx((186.0, 45.0))
    bench.switch(CW, False)
    bench.switch(DOWN, True)
    assert (bench.relays.drives(), bench.relays.starts) == ((0, -1), 2)


def test_without_the_master_no_motor_is_fed() -> None:
    bench = Bench(master=MASTER)
    bench.switch(CW, True, 1.0)
    assert (bench.relays.drives(), bench.azimuth.shaft_deg) == ((1, 0), 180.0), "the coil is fed, the motor is not"
    bench.switch(MASTER, True, 1.0)
    assert bench.azimuth.shaft_deg == pytest.approx(186.0)


def test_the_master_ends_what_a_welded_contact_keeps_on() -> None:
    bench = Bench(master=MASTER)
    bench.switch(MASTER, True)
    bench.azimuth.welded = 1
    bench.switch(CW, False, 1.0)
    assert bench.azimuth.shaft_deg == pytest.approx(186.0)
    bench.switch(MASTER, False, 1.0)
    assert bench.azimuth.shaft_deg == pytest.approx(186.0)
