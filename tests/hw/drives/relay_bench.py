"""A relay bank on simulated GPIO lines, step by step in simulated time."""

from __future__ import annotations

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction

CHIP = "/dev/gpiochip0"
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25}
MASTER_PIN = 26
DEAD_TIME_S = 0.5
MINUS, OFF, PLUS = Direction
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION


class Bench:
    """A bank with its four relays (and a master), and an alarm that stands in for the guard's thread."""

    def __init__(
        self, *, active_low: bool = False, master: bool = False, guarded: bool = True, one_at_a_time: bool = False
    ) -> None:
        self.clock = SimClock(100.0)
        self.gpio = SimGpio(self.clock)
        self.pins = PINS | ({"master": MASTER_PIN} if master else {})
        self.active_low = active_low
        lines = GpioOutputs(self.gpio, CHIP, self.pins, consumer="test", active_low=active_low)
        self.bank = RelayBank(lines, self.clock, dead_time_s=DEAD_TIME_S, master=master, one_at_a_time=one_at_a_time)
        if guarded:
            self.clock.add_alarm(self.bank.due_s, self.bank.enforce)

    def drive(self, axis: Axis, way: Direction, seconds: float = 0.25) -> Direction:
        return self.bank.drive(axis, way, self.clock() + seconds)

    def run(self, axis: Axis, way: Direction, seconds: float) -> None:
        """Keep a motor running, its command renewed every 50 ms as the control loop does."""
        for _ in range(round(seconds / 0.05)):
            self.drive(axis, way)
            self.clock.sleep(0.05)
        self.drive(axis, OFF)

    def on(self) -> set[str]:
        return {name for name, pin in self.pins.items() if self.gpio.level(pin) != self.active_low}
