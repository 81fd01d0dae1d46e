"""What `rehearse --target` flies: a pass of the sky, from its rise."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from rotator.rehearsal.passes import LONGEST_S, next_pass
from tests.orbits import skyfield_oracle

CONFIG = parse(f'[station]\nlocator = "JO62qm"\n[sky]\nelements = ["{skyfield_oracle.TLE}"]\n', "station.toml")
NOON_S = 1_739_016_000.0
"""2025-02-08, 12:00 UTC."""


@pytest.mark.parametrize("name", ["Sun", "Moon"])
def test_of_what_is_up_for_half_a_day_the_first_two_hours_are_flown(name: str) -> None:
    flown, _ = next_pass(CONFIG, name.lower(), NOON_S)
    assert flown.name == f"{name} (its first 2 hours)"
    assert flown.end_s == pytest.approx(LONGEST_S)
    assert flown.rows[0][2] == pytest.approx(0.0, abs=0.1), "it rises"
