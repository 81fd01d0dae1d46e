"""Of a train of satellites one is unknown here: its stream is not taken for its neighbour's.

Unless the gap is as small as the error that the clock of a program may have: then nothing tells the two apart.
"""

from __future__ import annotations

import random

import pytest

from benchmarks.recognition import catalogue
from benchmarks.trains import outcome, trains
from rotator.orbits.stream_fit import CLOCKS_S
from tests.search import examples

CLEARLY_S = 12.0
"""Seconds, with the error of the clock: early in a pass some that seem less off are taken for the neighbour."""


@pytest.mark.search
def test_a_satellite_is_not_taken_for_its_neighbour_in_a_train() -> None:
    dice = random.Random(15)
    elements = catalogue(dice, 20)
    found = [outcome(dice, each, elements) for each in trains(dice, elements, examples(64), 8.0, 60.0)]
    clearly = [each.wrong for each in found if each.seems_off_s > CLEARLY_S]
    assert sum(clearly) <= len(clearly) / 40, "orders at the horizon, before or after the rise, tell little"
    nearer = [each.wrong for each in found if CLOCKS_S[-1] + 1.0 < each.seems_off_s <= CLEARLY_S]
    assert sum(nearer) <= len(nearer) / 4
