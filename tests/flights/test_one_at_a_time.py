"""A U-100 as shipped, whose two motors never run together, points at what passes overhead."""

from __future__ import annotations

import pytest

from benchmarks.kinds import KINDS, away_s
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import Pass
from tests.control.sky.test_turn_timing import overhead

FASTER = 1.5
"""0.67°/s at the zenith, as a satellite 650 km up."""
U100 = next(kind for kind in KINDS if kind.profile == "u100")


@pytest.mark.parametrize("beside_deg", [0.5, 2.0])
def test_no_second_is_lost_on_a_known_pass_through_the_zenith(beside_deg: float) -> None:
    """Its azimuth turns half round, for 30 s: elevation goes up before that."""
    trace, _ = fly(Pass("overhead", overhead(beside_deg, FASTER).rows), plant_maker(U100.config(), via="track"))
    assert away_s(trace) == 0.0
