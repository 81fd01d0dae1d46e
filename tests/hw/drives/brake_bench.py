"""A relay bank with a brake for azimuth on a simulated motor with its wedge, step by step in simulated time.

Knows what harms a brake: the world counts it. An alarm stands in for the guard's thread as long as the program lives.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from firmware_sim.parts.brake import SimBrake
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.relays import RelayPins, SimRelays
from hw.buses.gpio import GpioOutputs
from hw.drives.brake import BrakeTimes
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction, HardwareError
from hw.safety.lines_off import RelayLines, switch_off

CHIP = "/dev/gpiochip0"
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25, "azimuth_brake": 27}
BRAKE_PIN = PINS["azimuth_brake"]
TIMES = BrakeTimes(release_s=0.5, rest_s=1.5, engage_s=4.0)
HAM_IV = MotorSpec(
    speed_dps=6.0, lag_s=0.3, relay_delay_s=0.015, backlash_deg=1.0, stop_low_deg=-2.0, stop_high_deg=362.0
)
AZ = Axis.AZIMUTH


class Ears:
    """A sentinel that only listens: which brakes are off."""

    def __init__(self) -> None:
        self.off: Collection[str] = ()

    def renew(self) -> None:
        pass

    def rest(self) -> None:
        pass

    def unbraked(self, lines: Collection[str]) -> None:
        self.off = lines


class Outputs(GpioOutputs):
    """Lines that may fail."""

    fails = False

    def set(self, levels: dict[str, bool]) -> None:
        if self.fails:
            raise HardwareError("the expander is gone")
        super().set(levels)


class BrakeBench:
    """`motor` and `brake` are the truth; `bank` is what is tried."""

    def __init__(self, times: BrakeTimes = TIMES, *, active_low: bool = False, dead_time_s: float = 0.5) -> None:
        self.clock = SimClock(100.0)
        self.gpio = SimGpio(self.clock)
        self.active_low, self.alive = active_low, True
        self.ears = Ears()
        self.lines = RelayLines(CHIP, PINS, active_low=active_low)
        self.outputs = Outputs(self.gpio, CHIP, PINS, consumer="test", active_low=active_low)
        self.motor, elevation = SimMotor(HAM_IV, 180.0, 100.0), SimMotor(HAM_IV, 10.0, 100.0)
        pins = RelayPins(22, 23, 24, 25, azimuth_brake=BRAKE_PIN)
        SimRelays(pins, self.gpio, (self.motor, elevation), 100.0, threading.RLock(), active_low=active_low)
        self.bank = RelayBank(self.outputs, self.clock, dead_time_s=dead_time_s, watch=self.ears, brakes={AZ: times})
        self.clock.add_alarm(self._while_alive(self.bank.due_s), self.bank.enforce)

    def _while_alive(self, due_s: Callable[[], float | None]) -> Callable[[], float | None]:
        return lambda: due_s() if self.alive else None

    def dies(self) -> None:
        """The program; its sentinel takes the lines a moment later."""
        self.alive = False
        self.gpio.bury_process()
        self.clock.sleep(0.04)
        switch_off(self.gpio, self.lines, self.clock, self.clock.sleep, 0.0, unbraked=self.ears.off)

    # --- orders and looks

    def drive(self, way: Direction, seconds: float = 0.25) -> Direction:
        return self.bank.drive(AZ, way, self.clock() + seconds)

    def run(self, way: Direction, seconds: float) -> list[Direction]:
        """Ask for a run every 50 ms as the control loop does. What was on each time."""
        on = []
        for _ in range(round(seconds / 0.05)):
            on.append(self.drive(way))
            self.clock.sleep(0.05)
        return on

    @property
    def released(self) -> bool:
        """Whether the brake's line is on."""
        return self.gpio.level(BRAKE_PIN) != self.active_low

    @property
    def brake(self) -> SimBrake:
        self.motor.advance(self.clock())
        assert self.motor.brake is not None
        return self.motor.brake

    @property
    def harm(self) -> tuple[float, int]:
        return self.brake.fed_s, self.brake.jolts
