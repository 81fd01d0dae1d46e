"""A simulated motor with its stops, and the watch over it: relays by hand, twenty readings a second, welds and pushes.

Knows the motor and the watch. Judges nothing.
"""

from __future__ import annotations

import random

from firmware_sim.parts.motor import MotorSpec, SimMotor
from hw.ports import Axis, Direction
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.axis.readings import Condition
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault
from rotator.exchange.motor import ALL_OPEN, Motor, Trusts
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
STEP_S = 0.05


class WatchedMotor:
    """An azimuth axis from 0 to 450°, its stops 2° beyond. It turns at 6°/s; the watch may believe something else."""

    def __init__(
        self,
        at_deg: float = 200.0,
        *,
        speed_dps: float = 6.0,
        believed_dps: float = 6.0,
        lag_s: float = 0.15,
        noise_deg: float = 0.1,
        master: bool = False,
        trusts: Trusts = ALL_OPEN,
        placed: bool = True,
        look: bool = False,
        seed: int = 5,
    ) -> None:
        self.motor = SimMotor(MotorSpec(speed_dps, lag_s, 0.015, 0.5, -2.0, 452.0), at_deg, 1000.0)
        believed = Motor(believed_dps, believed_dps * 0.15)
        self.watch = MotionWatch(
            Axis.AZIMUTH,
            Range(0.0, 450.0),
            {PLUS: believed, MINUS: believed},
            master=master,
            trusts=trusts,
            placed=placed,
            look=look,
        )
        self._switch = Switch(self.watch.note_relays)
        self.now_s = 1000.0
        self.fault: Fault | None = None
        """The latest fault that the watch has told."""
        self.off_deg = self.drift_dps = 0.0
        """How far the sensor is off, and how fast that grows."""
        self._noise_deg = noise_deg
        self._chance = random.Random(seed)

    @property
    def at_deg(self) -> float:
        return self.motor.shaft_deg

    def look(self, seconds: float) -> Fault | None:
        """Let time pass. Returns the first fault."""
        told = None
        for _ in range(round(seconds / STEP_S)):
            self.now_s += STEP_S
            self.motor.advance(self.now_s)
            self.off_deg += self.drift_dps * STEP_S
            read_deg = self.at_deg + self.off_deg + self._chance.gauss(0.0, self._noise_deg)
            found = self.watch.see(self.now_s, read_deg, Condition(supplied=self.motor.supply))
            told, self.fault = told or found, found or self.fault
        return told

    def hang(self, seconds: float) -> None:
        """Time passes without a reading: the bus of the sensor hangs."""
        self.now_s += seconds
        self.motor.advance(self.now_s)

    def relays(self, way: Direction) -> None:
        self.motor.coils(plus=way is PLUS, minus=way is MINUS, now_s=self.now_s)
        self._switch.to(self.now_s, way)

    def run(self, way: Direction, seconds: float) -> Fault | None:
        """Closed for so long, and then open. Returns the first fault meanwhile."""
        self.relays(way)
        told = self.look(seconds)
        self.relays(OFF)
        return told

    def push(self, share: float, seconds: float) -> Fault | None:
        """Wind or a hand turns it, at this share of its speed."""
        self.motor.pushed = share
        told = self.look(seconds)
        self.motor.pushed = 0.0
        return told

    def waits_s(self, way: Direction, most_s: float = 10.0) -> float:
        """For how long that relay is kept open from now on."""
        began_s = self.now_s
        while self.watch.forbids(way) and self.now_s - began_s < most_s:
            self.look(STEP_S)
        return self.now_s - began_s
