"""How much the readings of an axis scatter, as its status tells it."""

from __future__ import annotations

import random
from typing import Any

import pytest

from hw.ports import Axis


@pytest.mark.parametrize("noise_deg", [0.03, 0.1, 0.4])
def test_an_axis_learns_its_own_noise(new_desk: Any, noise_deg: float) -> None:
    desk = new_desk(at=(0.0, 0.0))
    scatter = random.Random(2)
    span = 0.9 / 180.0
    seen = []
    for _ in range(1200):
        desk.instead = {Axis.ELEVATION: desk.raw(Axis.ELEVATION) + scatter.gauss(0.0, noise_deg) * span}
        desk.step()
        seen.append(desk.status.elevation.shown_deg)
    assert desk.status.elevation.noise_deg == pytest.approx(noise_deg, rel=0.5)
    assert min(seen[200:]) >= (0.0 if noise_deg < 0.2 else -1.8)
    assert desk.status.azimuth.noise_deg < 0.05
