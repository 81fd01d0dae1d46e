"""Whether a driven axis stands is judged by the noise of its own readings: in any unit, at any speed, at any rate."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest

from hw.ports import Axis
from rotator.calibrating.readings import DEGREES, SHARES, ReadingUnit, stands
from tests.tables import every_row

Start = Callable[..., Any]
SAYS = "The reading stands still"


def second(dice: random.Random, speed: float, noise: float, step: float = 0.0, count: int = 20) -> list[float]:
    """Readings of one second: `speed` a second, noise (rms), and the sensor's step; 0: it has none."""
    seen = [0.5 + speed * at / count + dice.gauss(0.0, noise) for at in range(count)]
    return [round(each / step) * step if step else each for each in seen]


@every_row(("unit", "scale"), [(SHARES, 0.9 / 450), (SHARES, 0.9 / 180), (SHARES, 1 / 360), (DEGREES, 1.0)])
@every_row(("speed_dps", "noise_deg"), [(0.3, 0.0), (0.5, 0.02), (1.0, 0.05), (2.7, 0.1), (30.0, 0.5)])
def test_what_moves_is_not_said_to_stand(unit: ReadingUnit, scale: float, speed_dps: float, noise_deg: float) -> None:
    seed = random.randrange(10**6)
    dice = random.Random(seed)
    wrong = sum(stands(second(dice, speed_dps * scale, noise_deg * scale), unit) for _ in range(500))
    assert wrong == 0, f"seed {seed}"


@every_row("noise", [0.0, 0.00002, 0.0002])
@every_row("step", [0.0, 1 / 4096, 1 / 1024])
def test_what_stands_is_said_to_stand_within_a_second_press(noise: float, step: float) -> None:
    """Looked at twenty times a second, it needs one window in a press of two seconds."""
    seed = random.randrange(10**6)
    dice = random.Random(seed)
    told = sum(stands(second(dice, 0.0, noise, step)) for _ in range(500))
    assert told >= 250, f"seed {seed}"


@every_row("late", range(2, 10))
def test_readings_that_come_late_are_no_standstill(late: int) -> None:
    """From 0.074 to 0.098 in a press of two seconds, on a computer that sleeps for a moment: 6°/s of 450."""
    true = [0.074 + 0.012 * at / 20 for at in range(20)]
    for begin in range(20 - late):
        seen = [true[begin] if begin <= at < begin + late else each for at, each in enumerate(true)]
        assert not stands(seen)


@pytest.mark.long
@pytest.mark.parametrize("axis", ["r", "u"])
@pytest.mark.parametrize("sim", ["", "speed_dps = 0.5\n"])
@pytest.mark.parametrize("noise_deg", [0.0, 0.02, 0.1])
def test_a_slow_rotor_is_accepted_and_a_stalled_one_is_told(
    calibration: Start, sim: str, axis: str, noise_deg: float
) -> None:
    name = Axis.AZIMUTH if axis == "r" else Axis.ELEVATION
    run = calibration(f"[sim.{name.value}]\n{sim}pot_noise_deg = {noise_deg}\n", name)
    said = run.say(axis, axis, axis)
    assert SAYS not in said
    assert "Not accepted" not in said
    run.world.inject(f"{name.value}-motor-stalled")
    assert SAYS in run.say("y", *[axis, axis, axis]) + run.text


@every_row("pause_s", [0.3, 0.7, 1.0, 1.5, 2.5])
@every_row(("axis", "there", "back"), [(Axis.AZIMUTH, "r", "l"), (Axis.ELEVATION, "u", "d")])
def test_a_motor_that_is_reversed_is_not_said_to_stand(
    calibration: Start, axis: Axis, there: str, back: str, pause_s: float
) -> None:
    """The readings of the way before, and of the pause between, say nothing of the way back."""
    run = calibration(axis=axis)
    for key in (there, back) * 3:
        run.now(key)
        run.wait(pause_s)
    assert SAYS not in run.text
