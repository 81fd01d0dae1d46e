"""One axis in a world drawn at random from a seed: its motor, its relays, a person's orders, welds and restarts.

Knows the simulated motor and the relays' dead time, lease and master, as the real ones have them. Judges nothing.
"""

from __future__ import annotations

import random
from collections import deque
from dataclasses import dataclass, field

from firmware_sim.parts.motor import MotorSpec, SimMotor
from hw.ports import Axis, Direction
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.readings import Condition, Reading, Window
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.switched import SwitchedAxis
from rotator.control.commands import Feed, Run, Unfed
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Missing
from rotator.exchange.motor import ALL_OPEN, Motor, Trusts
from rotator.store.relays import after

MINUS, OFF, PLUS = Direction
CYCLE_S, LEASE_S, LINGER_S = 0.05, 0.25, 10.0
TAPS_S = (0.05, 0.1, 0.12, 0.2, 0.3, 0.5, 1.0, 2.0)
PAUSES_S = (0.05, 0.1, 0.3, 0.6, 1.0, 2.0, 4.0, 8.0)


@dataclass
class Relays:
    """The relay board of one motor, its lease and its master."""

    motor: SimMotor
    master: bool
    dead_s: float
    on: Direction = OFF
    last: Direction = OFF
    until_s: float = 0.0
    stopped_s: float = field(default=-9.0)
    supplied_until_s: float | None = None

    def expire(self, before_s: float, now_s: float) -> None:
        """What ends by itself before that moment."""
        if self.on and self.until_s < before_s:
            self.open(max(self.until_s, now_s))
        if self.supplied_until_s is not None and not self.on and self.supplied_until_s < before_s:
            self.supply(on=False, now_s=max(self.supplied_until_s, now_s))

    def open(self, now_s: float) -> None:
        if self.on:
            self.motor.coils(plus=False, minus=False, now_s=now_s)
            self.on, self.stopped_s, self.supplied_until_s = OFF, now_s, now_s + LINGER_S

    def close(self, way: Direction, until_s: float, now_s: float) -> None:
        if self.on not in (OFF, way):
            self.open(now_s)
        if self.on is OFF and (self.last in (OFF, way) or now_s >= self.stopped_s + self.dead_s):
            self.supply(on=True, now_s=now_s, until_s=now_s + LINGER_S)
            self.motor.coils(plus=way is PLUS, minus=way is MINUS, now_s=now_s)
            self.on = self.last = way
        self.until_s = until_s

    def supply(self, *, on: bool, now_s: float, until_s: float | None = None) -> None:
        self.supplied_until_s = until_s if on else None
        if self.master and self.motor.supply is not on:
            self.motor.advance(now_s)
            self.motor.supply = on


@dataclass
class Lens:
    """A sensor that shows its axis late: the mean of its latest readings, a low pass before them, a delay after."""

    averaged: int = 1
    low_pass_s: float = 0.0
    delayed: int = 0
    """By so many cycles."""
    _passed_deg: float | None = None
    _means_deg: deque[float] = field(default_factory=deque)
    _latest_deg: deque[float] = field(default_factory=deque)

    def behind_s(self, cycle_s: float) -> float:
        """What it shows is at most so old. A low pass keeps less than a hundredth after five of its time constants."""
        return (self.averaged - 1 + self.delayed) * cycle_s + 5.0 * self.low_pass_s

    def see(self, angle_deg: float, cycle_s: float) -> float:
        before_deg = angle_deg if self._passed_deg is None else self._passed_deg
        self._passed_deg = before_deg + (angle_deg - before_deg) * cycle_s / (cycle_s + self.low_pass_s)
        self._latest_deg.append(self._passed_deg)
        while len(self._latest_deg) > self.averaged:
            self._latest_deg.popleft()
        self._means_deg.append(sum(self._latest_deg) / len(self._latest_deg))
        while len(self._means_deg) > self.delayed + 1:
            self._means_deg.popleft()
        return self._means_deg[0]


class WeldWorld:
    cycle_s = CYCLE_S

    def __init__(self, seed: int, *, healthy: bool, calibrated: bool) -> None:
        self.chance = chance = random.Random(f"{seed} {healthy} {calibrated}")
        self.healthy, self._calibrated = healthy, calibrated
        self._believed_dps, self.high_deg = chance.choice(((6.0, 450.0), (2.7, 180.0)))
        speed_dps = self._believed_dps * chance.uniform(0.3, 1.5)
        lag_s = chance.choice((0.05, 0.1, 0.15, 0.3, 0.5))
        self._noise_deg = chance.choice((0.02, 0.1, 0.1, 0.2))
        self.now_s = 1000.0
        high_deg = self.high_deg
        near_deg = chance.uniform(0.0, 5.0)
        start_deg = chance.choice((0.0, high_deg, chance.uniform(0.0, high_deg), high_deg - near_deg))
        if not calibrated:
            start_deg = high_deg / 2.0  # where its stops are is not known to the box: the world ends before them
        delay_s = chance.choice((0.005, 0.015, 0.03))
        # One that coasts past its limits by more than half a degree is not healthy: it is set up wrongly.
        lag_s = min(lag_s, (0.17 * self._believed_dps + 0.4) / speed_dps - delay_s - CYCLE_S)
        self.motor = SimMotor(MotorSpec(speed_dps, lag_s, delay_s, 0.5, -2.0, high_deg + 2.0), start_deg, self.now_s)
        self._relays = Relays(self.motor, chance.random() < 0.4, chance.choice((0.05, 0.5)))
        self._relays.supply(on=False, now_s=self.now_s)
        self._weld: tuple[int, float] | None = None
        self.faults: set[str] = set()
        self.untold_s = self.longest_untold_s = 0.0
        """For how long a welded relay has turned its motor, with none ordered on, until a fault first told of it."""
        self._told = False
        self.lens = Lens()
        self.axis = self._program(ALL_OPEN)

    def play(self, seconds: float) -> None:
        end_s = self.now_s + seconds
        while self.now_s < end_s and self.motor.shorted_s == 0.0 and not self._at_unknown_stop:
            self._order()
            if not self.healthy:
                self._strike()
            pause_s = self.now_s + self.chance.choice(PAUSES_S)
            while self.now_s < pause_s:
                self.cycle()

    @property
    def _at_unknown_stop(self) -> bool:
        spec = self.motor.spec
        return not self._calibrated and not spec.stop_low_deg + 1.0 < self.motor.shaft_deg < spec.stop_high_deg - 1.0

    def _program(self, trusts: Trusts) -> SwitchedAxis:
        line = Calibration(((0.05, 0.0), (0.95, self.high_deg))) if self._calibrated else None
        settings = SwitchedSettings(
            Axis.AZIMUTH,
            Range(0.0, self.high_deg),
            4.0,
            Motor(self._believed_dps, self._believed_dps * 0.17),
            Window(0.02, 0.98),
            line,
            () if self._calibrated else (Missing.CALIBRATION,),
            master=self._relays.master,
            trusts=trusts,
            look=True,
            behind_s=self.lens.behind_s(self.cycle_s),
        )
        return SwitchedAxis(settings, lease_s=LEASE_S, period_s=self.cycle_s)

    def _order(self) -> None:
        chance, way = self.chance, self.chance.choice((PLUS, MINUS))
        draw = chance.random()
        if draw < 0.4:
            self.axis.jog(way, chance.choice(TAPS_S), self.now_s)
        elif draw < 0.7 and self._calibrated:
            near_deg = self.motor.shaft_deg + chance.uniform(-20.0, 20.0)
            target_deg = chance.choice((near_deg, near_deg, 0.0, self.high_deg, chance.uniform(0.0, self.high_deg)))
            self.axis.aim(AimGoal(min(max(target_deg, 0.0), self.high_deg), chance.choice((1.0, 4.0)), None))
        elif draw < 0.78:
            self.axis.jog(way, None, self.now_s)
        elif draw < 0.95:
            self.axis.halt()
            self.axis.acknowledge(self.now_s, by_person=True)
        else:
            # A program that is killed while it stands beyond a limit leaves a doubt, and rightly so.
            self._restart(proper=self.healthy or chance.random() < 0.5)

    def _restart(self, *, proper: bool) -> None:
        self._relays.open(self.now_s)
        self._relays.supply(on=False, now_s=self.now_s)
        trusts = after(self.axis.status(self.now_s).trusts, proper=proper)
        self.now_s += self.chance.uniform(0.2, 4.0)
        self.motor.advance(self.now_s)
        self._relays.last = OFF
        self.axis = self._program(trusts)

    def _strike(self) -> None:
        if self._weld is None and not self.motor.welded and self.chance.random() < 0.3:
            self._weld = self.chance.choice((1, -1)), self.now_s + self.chance.choice((0.0, self.chance.uniform(0, 2)))
        elif self.chance.random() < 0.04:
            self.motor.advance(self.now_s)
            self.motor.welded, self._weld = 0, None

    def cycle(self) -> None:
        self._relays.expire(self.now_s + self.cycle_s, self.now_s)
        self.now_s += self.cycle_s
        self.motor.advance(self.now_s)
        if self._weld and self.motor.drive == self._weld[0] and self.now_s >= self._weld[1]:
            self.motor.welded, self._weld = self._weld[0], None
        read_deg = self.lens.see(self.motor.shaft_deg + self.chance.gauss(0.0, self._noise_deg), self.cycle_s)
        condition = Condition(supplied=self.motor.supply)
        self.axis.see(Reading(self.now_s, 0.05 + 0.9 * read_deg / self.high_deg, condition=condition), self.now_s)
        self._obey(self.axis.decide(self.now_s).command)
        self.axis.note_driven(self.now_s, self._relays.on)
        if (fault := self.axis.fault) is not None:
            self.faults.add(fault.name)
            if fault.cut and self._relays.master:
                self._relays.open(self.now_s)
                self._relays.supply(on=False, now_s=self.now_s)
        self._note_untold()

    def _note_untold(self) -> None:
        if not self.motor.welded:
            self._told, self.untold_s = False, 0.0
        elif self.axis.fault is not None:
            self._told = True
        elif self.motor.drive and self.motor.speed_dps and not self._relays.on and not self._told:
            self.untold_s += self.cycle_s
            self.longest_untold_s = max(self.longest_untold_s, self.untold_s)

    def _obey(self, command: object) -> None:
        match command:
            case Run(direction, until_s) if direction and until_s > self.now_s:
                self._relays.close(direction, until_s, self.now_s)
            case Feed(until_s):
                self._relays.open(self.now_s)
                kept_s = max(self._relays.supplied_until_s or 0.0, until_s)
                self._relays.supply(on=True, now_s=self.now_s, until_s=kept_s)
            case Unfed():
                self._relays.open(self.now_s)
                self._relays.supply(on=False, now_s=self.now_s)
            case _:
                self._relays.open(self.now_s)
