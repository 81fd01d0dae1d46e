"""Presses of an axis without a calibration: which of them have moved it, by readings that scatter."""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.sky.mount import Range
from rotator.exchange.motor import ALL_OPEN, Motor
from tests.control.axis.switch import Switch

PLUS, OFF = Direction.PLUS, Direction.OFF
CYCLE_S = 0.05


class Pot:
    """Of a rotor that turns so fast while its relay is on; its readings scatter by so much, rms."""

    def __init__(self, speed_dps: float, noise_deg: float, *, before: bool = False) -> None:
        motors = dict.fromkeys((PLUS, Direction.MINUS), Motor(6.0, 1.0))
        self.watch = MotionWatch(
            Axis.AZIMUTH, Range(0.0, 450.0), motors, master=False, trusts=ALL_OPEN, placed=False, look=False
        )
        self.watch.runs.forget(pressed=before)
        self.switch = Switch(self.watch.note_relays)
        self.chance = random.Random(3)
        self.speed_dps, self.noise_deg = speed_dps, noise_deg
        self.now_s = self.place_deg = 100.0
        self.rest(2.0)

    def press(self, seconds: float) -> None:
        self.switch.to(self.now_s, PLUS)
        self._pass(seconds, self.speed_dps)
        self.switch.to(self.now_s, OFF)

    def rest(self, seconds: float) -> None:
        self._pass(seconds, 0.0)

    def _pass(self, seconds: float, speed_dps: float) -> None:
        for _ in range(round(seconds / CYCLE_S)):
            self.now_s += CYCLE_S
            self.place_deg += speed_dps * CYCLE_S
            self.watch.see(self.now_s, self.place_deg + self.chance.gauss(0.0, self.noise_deg))

    @property
    def enough(self) -> bool:
        return self.watch.runs.pressed


@pytest.mark.parametrize("noise_deg", [0.02, 0.1, 0.5])
@pytest.mark.parametrize(("press_s", "enough"), [(2.0, 3), (0.5, 3), (0.3, 4), (0.2, 6)])
def test_three_presses_that_move_nothing_are_enough_and_more_of_short_ones(
    noise_deg: float, press_s: float, enough: int
) -> None:
    pot = Pot(0.0, noise_deg)
    pressed = 0
    while not pot.enough:
        pot.press(press_s)
        pot.rest(1.0)
        pressed += 1
    assert enough <= pressed <= enough + 1


@pytest.mark.parametrize(("speed_dps", "noise_deg"), [(0.5, 0.1), (2.7, 0.5), (6.0, 1.0)])
def test_also_a_slow_motor_that_turns_is_never_pressed_in_vain(speed_dps: float, noise_deg: float) -> None:
    pot = Pot(speed_dps, noise_deg)
    for press_s in (2.0, 0.3, 0.3, 1.0, 0.1, 0.1, 0.1) * 20:
        pot.press(press_s)
        pot.rest(0.8)
        assert not pot.enough


def test_from_one_press_to_the_next_without_a_pause_they_count_too() -> None:
    pot = Pot(0.0, 0.1)
    for _ in range(3):
        assert not pot.enough
        pot.press(1.0)
        pot.rest(0.1)
    pot.rest(1.0)
    assert pot.enough


def test_presses_without_a_pause_are_noticed_within_five_seconds() -> None:
    """Each order comes while the relay is still on: the relay closes once."""
    pot = Pot(0.0, 0.1)
    pot.switch.to(pot.now_s, PLUS)
    pot.rest(4.0)
    assert not pot.enough
    pot.rest(1.0)
    assert pot.enough


def test_a_long_press_that_turns_it_is_not_in_vain() -> None:
    pot = Pot(0.5, 0.1)
    pot.press(60.0)
    pot.rest(1.0)
    assert not pot.enough


def test_presses_of_an_earlier_run_of_the_program_count_until_one_moves_it_or_a_person_has_looked() -> None:
    pot = Pot(6.0, 0.1, before=True)
    assert pot.enough
    pot.press(1.0)
    assert not pot.enough
    looked = Pot(6.0, 0.1, before=True)
    looked.watch.runs.forget()
    assert not looked.enough
