"""A satellite is recognised within ten seconds of its rise: each of 20 that are known; of a hundred, those in use.

Stations, orbits, moments and clocks are drawn at random. Another of a hundred, which stands in whole degrees, takes
longer: place and moment alone tell too little among so many.
"""

from __future__ import annotations

import math
import random

import pytest

from benchmarks.recognition import catalogue
from benchmarks.recognition_delay import ROUNDINGS, recognised_after_s, rises, used
from rotator.orbits.chance import Known
from rotator.orbits.stream_fit import ORDERS
from rotator.orbits.recognition import StreamWatch
from rotator.orbits.satellite import Satellite
from tests.search import examples

LATE_S = 10.0


@pytest.mark.search
@pytest.mark.parametrize("rounding", ROUNDINGS)
@pytest.mark.parametrize(("known", "in_use", "period_s"), [(100, True, 1.0), (100, True, 2.0), (20, False, 1.0)])
def test_a_satellite_is_recognised_within_ten_seconds(rounding: str, known: int, in_use: bool, period_s: float) -> None:
    dice = random.Random(f"{rounding} {known} {period_s}")
    elements, late = catalogue(dice, known), []
    count = examples(120)
    for rise in rises(dice, elements, count):
        likely = used(rise, elements, dice) if in_use else ()
        watch = StreamWatch([Satellite(each, rise.site) for each in elements], likely)
        name, after_s = recognised_after_s(rise, watch, ROUNDINGS[rounding], period_s, dice)
        assert name == rise.elements.name
        # Its first order comes up to a period after the rise.
        if after_s > LATE_S + period_s - 1.0:
            late.append(after_s)
    assert len(late) <= count / 30, "some rise beside another satellite that fits as well"


@pytest.mark.search
@pytest.mark.parametrize("rounding", ROUNDINGS)
def test_any_other_is_recognised_when_its_whole_degrees_have_changed(rounding: str) -> None:
    dice = random.Random(f"any {rounding}")
    elements = catalogue(dice, 100)
    after_s = []
    for rise in rises(dice, elements, examples(120)):
        watch = StreamWatch([Satellite(each, rise.site) for each in elements])
        name, late_s = recognised_after_s(rise, watch, ROUNDINGS[rounding], 1.0, dice)
        assert name == rise.elements.name
        after_s.append(late_s)
    after_s.sort()
    assert after_s[len(after_s) // 2] < LATE_S + 2.0
    assert after_s[len(after_s) * 9 // 10] < 22.0


@pytest.mark.parametrize("known", [1, 3, 14, 100, 1000])
@pytest.mark.parametrize("likely", [0, 1, 8, 12])
def test_the_shares_of_all_satellites_add_up(known: int, likely: int) -> None:
    if likely > known:
        return
    counted = Known(known, likely, up=1)
    total = likely * counted.share(likely=True) + (known - likely) * counted.share(likely=False)
    if 0 < likely < known:
        assert total == pytest.approx(1.0)
    assert total <= 1 + 1e-9


def test_what_was_recognised_once_is_in_use() -> None:
    dice = random.Random(3)
    elements = catalogue(dice, 100)
    [rise] = rises(dice, elements, 1)
    known = [Satellite(each, rise.site) for each in elements]
    seconds = {}
    for earlier in ((), (rise.elements.name,)):
        watch = StreamWatch(known)
        for name in earlier:
            watch.used(name)
        seconds[earlier] = recognised_after_s(rise, watch, math.floor, 1.0, random.Random(1))[1]
    assert seconds[rise.elements.name,] < ORDERS + 1.0
    assert seconds[rise.elements.name,] < seconds[()]
