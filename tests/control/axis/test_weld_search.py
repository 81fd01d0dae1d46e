"""Worlds at random: a welded relay is never met by the opposite one, and a healthy rotor is never suspected.

Judged by the simulated motor alone: for how long both of its directions had current.
"""

from __future__ import annotations

import pytest

from tests.control.axis.weld_world import WeldWorld

SEEDS = range(12)
EITHER = pytest.mark.parametrize("calibrated", [True, False], ids=["calibrated", "not-calibrated"])


@EITHER
@pytest.mark.parametrize("seed", SEEDS)
def test_both_directions_never_have_current_at_once(seed: int, calibrated: bool) -> None:
    world = WeldWorld(seed, healthy=False, calibrated=calibrated)
    world.play(90.0)
    assert world.motor.shorted_s == 0.0


@EITHER
@pytest.mark.parametrize("seed", SEEDS)
def test_a_healthy_relay_is_never_suspected(seed: int, calibrated: bool) -> None:
    world = WeldWorld(seed, healthy=True, calibrated=calibrated)
    world.play(90.0)
    assert not {"relay welded", "relay not seen to open", "turning with no relay on"} & world.faults
