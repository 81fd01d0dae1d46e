"""What the box itself slept through is no evidence: a busy computer stands still for a moment, again and again.

Meanwhile the motor turns on. After that the sensor may still show an angle from before, and then the present one.
"""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.positioned import PositionedAxis
from rotator.control.axis.readings import ANYTHING, Condition, Reading
from rotator.control.axis.settings import PositionedSettings
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.exchange.faults import LATE, FaultKind
from tests.search import SEED

SPEED_DPS = 30.0
SCALE = Calibration(((0.0, 0.0), (450.0, 450.0)))


class Busy:
    """An axis at its full speed, to and fro, on a computer that stands still now and then; looked at 50 times a second.

    Its controller is asked by another thread: `answers_old` more readings after each pause show the angle before it.
    """

    def __init__(self, chance: random.Random, answers_old: int) -> None:
        settings = PositionedSettings(
            axis=Axis.AZIMUTH,
            limits=Range(0.0, 450.0),
            tolerance_deg=0.5,
            speed_dps=SPEED_DPS,
            window=ANYTHING,
            calibration=SCALE,
            accel_dps2=None,
        )
        self.axis = PositionedAxis(settings, lease_s=0.25)
        self.chance, self.answers_old = chance, answers_old
        self.now_s, self.angle_deg, self.target_deg = 0.0, 200.0, 400.0
        self.missed = 0
        self.said: set[FaultKind] = set()

    def passes(self, seconds: float) -> None:
        ahead_deg = self.target_deg - self.angle_deg
        self.angle_deg += max(-SPEED_DPS * seconds, min(SPEED_DPS * seconds, ahead_deg))
        self.now_s += seconds

    def look(self, angle_deg: float, since_s: float) -> None:
        condition = Condition(missed=self.missed)
        self.axis.see(Reading(self.now_s, angle_deg, condition=condition, since_s=since_s), self.now_s)
        if self.axis.fault is not None:
            self.said.add(self.axis.fault.kind)
        if self.angle_deg == self.target_deg:
            self.target_deg = 600.0 - self.target_deg
        if self.axis.aiming is None or self.axis.aiming.target_deg != self.target_deg:
            self.axis.aim(AimGoal(self.target_deg, 0.5))
        self.axis.decide(self.now_s)

    def run(self, seconds: float, stall_s: float) -> None:
        end_s, stalls_s = self.now_s + seconds, 0.0
        while self.now_s < end_s:
            self.look(self.angle_deg, self.now_s)
            if self.now_s < stalls_s:
                self.passes(0.02)
                continue
            stalls_s = self.now_s + self.chance.uniform(0.5, 5.0)
            before_s, before_deg = self.now_s, self.angle_deg
            self.passes(stall_s)
            self.missed += 1
            for _ in range(self.answers_old):
                self.look(before_deg, before_s)
                self.passes(0.02)


@pytest.mark.parametrize("answers_old", [0, 1, 2])
@pytest.mark.parametrize("stall_s", [0.15, 0.2, 0.25, 0.4, 0.6])
def test_a_computer_that_stands_still_now_and_then_finds_nothing_wrong_with_the_sensor(
    stall_s: float, answers_old: int
) -> None:
    busy = Busy(random.Random(SEED), answers_old)
    busy.run(60.0, stall_s)
    assert busy.said <= LATE, SEED
    assert busy.axis.fault is None or busy.axis.fault.kind in LATE, SEED


def test_a_loose_wire_is_still_found_on_a_busy_computer() -> None:
    busy = Busy(random.Random(1), 1)
    busy.run(20.0, 0.2)
    for _ in range(4):
        for deg in (0.0, 0.0, 0.0, 0.0, 40.0, 40.0, 40.0, 40.0):
            busy.look(busy.angle_deg + deg, busy.now_s)
            busy.passes(0.02)
    assert busy.said - LATE == {FaultKind.POT_JUMPS}
