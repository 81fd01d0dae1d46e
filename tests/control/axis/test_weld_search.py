"""Worlds at random: a welded relay is never met by the opposite one, and a healthy rotor is never suspected.

Judged by the simulated motor alone: for how long both of its directions had current.
"""

from __future__ import annotations

import pytest

from benchmarks.weld_world import WeldWorld
from hw.ports import Direction
from tests.search import some

SEEDS = some(range(12))
EITHER = pytest.mark.parametrize("calibrated", [True, False], ids=["calibrated", "not-calibrated"])


@pytest.mark.search
@EITHER
@pytest.mark.parametrize("seed", SEEDS)
def test_both_directions_never_have_current_at_once(seed: int, calibrated: bool) -> None:
    world = WeldWorld(seed, healthy=False, calibrated=calibrated)
    world.play(90.0)
    assert world.motor.shorted_s == 0.0


@pytest.mark.search
@EITHER
@pytest.mark.parametrize("seed", SEEDS)
def test_a_healthy_relay_is_never_suspected(seed: int, calibrated: bool) -> None:
    world = WeldWorld(seed, healthy=True, calibrated=calibrated)
    world.play(90.0)
    assert not {"relay welded", "relay not seen to open", "turning with no relay on"} & world.faults


@pytest.mark.parametrize("seed", range(4))
def test_a_jog_turns_for_its_whole_time_though_the_axis_is_looked_at_first(seed: int) -> None:
    world = WeldWorld(seed, healthy=True, calibrated=False)
    began_deg = world.motor.shaft_deg
    world.axis.jog(Direction.PLUS, 2.0, world.now_s)
    for _ in range(240):
        world.cycle()
    assert world.motor.shaft_deg - began_deg == pytest.approx(2.0 * world.motor.spec.speed_dps, rel=0.1)
