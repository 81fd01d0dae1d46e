"""The drills' random worlds, with a brake on their axes: orders, stops, expiries, stalls, welds, ends and deaths.

What the brakes have felt is judged in the simulated world.
"""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from benchmarks.drills.accusations import BRAKED
from benchmarks.drills.draw import draw
from benchmarks.drills.mounts import with_brakes
from benchmarks.drills.play import FAILS, play
from benchmarks.drills.script import Drill
from tests.search import some

SEEDS = [f"brake-{number}" for number in range(40)]


def braked(seed: str, kind: str) -> Drill:
    drill = draw(seed, kind)
    return replace(drill, tables=with_brakes(random.Random(f"{seed} brake"), kind, drill.tables))


@pytest.mark.search
@pytest.mark.parametrize("kind", ["relay-pot", "relay-pulse"])
@pytest.mark.parametrize("seed", some(SEEDS))
def test_no_world_harms_a_brake(seed: str, kind: str) -> None:
    drill = braked(seed, kind)
    found = [find for find in play(drill).violations if find.judge in (BRAKED, FAILS)]
    assert found == [], f"{list(map(str, found))}\n{drill.to_json()}"
