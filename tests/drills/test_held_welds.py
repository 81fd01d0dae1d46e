"""Drills about welded relays whose axis is held: the same seed draws the same one, and no weld is met."""

from __future__ import annotations

import pytest

from benchmarks.drills.held_welds import SUSPECTED, HeldWeld
from benchmarks.drills.play import play
from benchmarks.drills.script import Drill


def test_a_seed_draws_the_same_drill_and_it_goes_through_json() -> None:
    drill = HeldWeld("7.3", "relay-pot", healthy=False).drill
    assert drill == HeldWeld("7.3", "relay-pot", healthy=False).drill
    assert Drill.from_json(drill.to_json()).to_json() == drill.to_json()
    assert {"weld"} <= {event.what for event in drill.events}


@pytest.mark.parametrize("seed", ["1.7", "1.50"])
def test_a_slow_motor_that_runs_on_into_a_branch_is_not_met_by_the_opposite_relay(seed: str) -> None:
    outcome = play(HeldWeld(seed, "relay-pot", healthy=False).drill)
    assert outcome.violations == []


def test_where_nothing_welds_nothing_is_suspected() -> None:
    outcome = play(HeldWeld("1.4", "relay-pot", healthy=True).drill)
    assert not [line for line in outcome.said if SUSPECTED in line]
