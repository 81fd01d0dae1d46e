"""A relay welds while its axis is pressed, or pressed again and again: whatever sensor, filter, rate, speed and pause.

Each case is drawn from its number and a fresh seed. Judged by the simulated motor alone: for how long both of its
directions had current, and for how long it ran until a fault stopped its axis.
"""

from __future__ import annotations

import random

import pytest

from benchmarks.weld_world import Lens, Relays, WeldWorld
from firmware_sim.parts.motor import MotorSpec, SimMotor
from hw.ports import Direction
from rotator.control.sky.goal import AimGoal
from rotator.exchange.motor import ALL_OPEN
from tests.search import SEED, some

MINUS, OFF, PLUS = Direction
TOLD_S = 4.0
"""A weld is told after two seconds of its motor, and two more."""
LONGEST_AVERAGE_S = 0.3
FOUND = ("660242 pressed 576", "1 pressed 50", "1 pressed 84", "481544 pressed 222")
"""Cases that once failed: readings averaged by the sensor scatter less from one to the next than they are off; and the
line through a run's last quarter of a second was tilted by noise."""


def draw_lens(chance: random.Random, cycle_s: float) -> Lens:
    """None, a tilt sensor's average, a filter as slow as a chip has one, or readings that come late."""
    match chance.randrange(5):
        case 0:
            return Lens()
        case 1 | 2:
            most = int(LONGEST_AVERAGE_S / cycle_s)
            return Lens(averaged=min(chance.choice((2, 4, 4, 8, 16)), most), low_pass_s=0.003)
        case 3:
            return Lens(low_pass_s=chance.choice((0.02, 0.05, 0.1)))
        case _:
            return Lens(averaged=chance.choice((1, 4)), delayed=chance.choice((1, 2, 4)))


class PressedWorld(WeldWorld):
    """An axis on its way to a stop, and a relay that welds as soon as it is closed once `welds` is set."""

    def __init__(self, seed: str, *, amid: bool = False) -> None:
        """`amid`: it starts in the middle of its range, where no stop ends its motion soon."""
        super().__init__(0, healthy=False, calibrated=True)
        self.chance = chance = random.Random(seed)
        self.way = chance.choice((PLUS, MINUS))
        self.cycle_s = chance.choice((0.05, 0.05, 0.02, 0.01))
        self._believed_dps, self.high_deg = chance.choice(((6.0, 450.0), (2.7, 180.0)))
        speed_dps = chance.choice((2.7, 6.0, 9.0))
        self._noise_deg = chance.choice((0.02, 0.05, 0.1))
        self.lens = draw_lens(chance, self.cycle_s)
        lag_s, delay_s = chance.choice((0.05, 0.15, 0.3)), chance.choice((0.005, 0.015, 0.03))
        self.stop_deg = self.high_deg + 2.0 if self.way is PLUS else -2.0
        near_deg = self.stop_deg - self.way * chance.choice((3.0, 8.0, 20.0, 60.0))
        start_deg = self.high_deg / 2.0 if amid else near_deg
        spec = MotorSpec(speed_dps, lag_s, delay_s, 0.5, -2.0, self.high_deg + 2.0)
        self.motor = SimMotor(spec, start_deg, self.now_s)
        self._relays = Relays(self.motor, chance.random() < 0.5, chance.choice((0.05, 0.5)))
        self._relays.supply(on=False, now_s=self.now_s)
        self.axis = self._program(ALL_OPEN)
        self.welds = False
        self.ran_s = 0.0
        """For how long the motor has had current since the weld, until a fault told of it."""
        self.wait(2.0)

    def wait(self, seconds: float, near_deg: float = -1.0) -> None:
        """Time passes, at most until the axis is so near to its stop."""
        end_s = self.now_s + seconds
        while self.now_s < end_s and abs(self.stop_deg - self.motor.shaft_deg) > near_deg:
            self.cycle()

    def cycle(self) -> None:
        super().cycle()
        if self.welds and self.motor.drive == self.way:
            self.motor.welded = int(self.way)
        if self.motor.welded and self.motor.drive and self.axis.fault is None:
            self.ran_s += self.cycle_s

    def stop(self) -> None:
        self.axis.halt()
        self.axis.acknowledge(self.now_s, by_person=True)


@pytest.mark.search
@pytest.mark.parametrize("case", [*FOUND, *some(range(600))])
def test_both_directions_never_have_current(case: int | str) -> None:
    seed = f"{SEED} pressed {case}" if isinstance(case, int) else case
    world = PressedWorld(seed)
    chance, way = world.chance, world.way
    if chance.random() < 0.5:
        world.axis.jog(way, None, world.now_s)
    else:
        world.axis.aim(AimGoal(world.high_deg if way is PLUS else 0.0, 1.0, None))
    world.wait(chance.choice((1.0, 4.0, 30.0)), near_deg=chance.uniform(0.0, 9.0))
    world.welds = True
    world.wait(chance.choice((0.0, 0.2, 0.5, 1.0, 2.0, 5.0)))
    for _ in range(6):
        world.stop()
        world.wait(chance.choice((0.0, 0.1, 0.3, 0.6, 1.0, 2.0, 4.0)))
        towards = chance.choice((way, Direction(-way), Direction(-way)))
        world.axis.jog(towards, chance.choice((0.1, 0.5, 2.0, None)), world.now_s)
        world.wait(chance.choice((0.3, 0.6, 1.0, 2.0, 5.0)))
    assert world.motor.shorted_s == 0.0, seed


@pytest.mark.search
@pytest.mark.parametrize("case", ["1 again 23", *some(range(160))])
def test_a_weld_is_told_though_its_relay_closes_again_and_again(case: int | str) -> None:
    seed = f"{SEED} again {case}" if isinstance(case, int) else case
    world = PressedWorld(seed, amid=True)
    chance, way = world.chance, world.way
    press_s, pause_s = chance.choice(((0.5, 1.3), (0.5, 0.8), (0.2, 0.6), (0.3, 0.3), (0.6, 0.6), (1.0, 1.0)))
    alternates = chance.random() < 0.5
    world.welds = True
    world.axis.jog(way, None, world.now_s)
    while not world.motor.welded:
        world.cycle()
    for _ in range(20):
        world.wait(press_s)
        world.axis.jog(Direction(-way), None, world.now_s) if alternates else world.axis.halt()
        world.wait(pause_s)
        if world.axis.fault is not None:
            break
        world.axis.jog(way, None, world.now_s)
    assert world.axis.fault is not None, seed
    assert world.ran_s <= TOLD_S, seed
    assert world.motor.shorted_s == 0.0, seed
