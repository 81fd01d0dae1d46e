"""The speed of an axis that turns without being driven: seen within a second or two, and never out of noise."""

from __future__ import annotations

import random

import pytest

from rotator.control.axis.trend import SeenTurning
from tests.tables import every_row


def seen(speed_dps: float, noise_deg: float = 0.0, seconds: float = 2.0, seed: int = 1) -> list[float]:
    chance, turning = random.Random(seed), SeenTurning()
    speeds = []
    for cycle in range(round(seconds * 20)):
        now_s = cycle / 20
        turning.note(now_s, 100.0 + speed_dps * now_s + chance.gauss(0.0, noise_deg))
        speeds.append(turning.speed_dps(noise_deg))
    return speeds


@pytest.mark.parametrize("speed_dps", [-6.0, -1.0, 0.6, 6.0])
def test_the_speed_is_shown_after_a_second(speed_dps: float) -> None:
    speeds = seen(speed_dps)
    assert set(speeds[:18]) == {0.0}
    assert speeds[-1] == pytest.approx(speed_dps)


@every_row("noise_deg", [0.05, 0.2, 1.0])
@every_row("seed", range(5))
def test_noise_turns_nothing(noise_deg: float, seed: int) -> None:
    assert set(seen(0.0, noise_deg, 60.0, seed)) == {0.0}


def test_what_was_driven_and_what_was_not_seen_begin_anew() -> None:
    for forget in (SeenTurning.driven, lambda turning: turning.note(1.0, None)):
        turning = SeenTurning()
        for cycle in range(20):
            turning.note(cycle / 20, cycle * 0.3)
        assert turning.speed_dps(0.0)
        forget(turning)
        assert turning.speed_dps(0.0) == 0.0
