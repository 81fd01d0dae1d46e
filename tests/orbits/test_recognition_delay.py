"""A satellite is recognised within ten seconds of its rise: each of 20 that are known; of a hundred, those in use.

Stations, orbits, moments and clocks are drawn at random. Another of a hundred, which stands in whole degrees, takes
longer: place and moment alone tell too little among so many.
"""

from __future__ import annotations

import math
import random
import statistics

import pytest

from benchmarks.recognition import catalogue
from benchmarks.recognition_delay import EARLY_S, ROUNDINGS, Program, recognised_after_s, rises, used
from rotator.orbits.chance import Known
from rotator.orbits.recognition import StreamWatch
from rotator.orbits.satellite import Satellite
from rotator.orbits.stream_fit import KEPT, ORDERS
from tests.search import examples
from tests.tables import every_row

LATE_S = 10.0


@pytest.mark.search
@pytest.mark.parametrize("rounding", ROUNDINGS)
@pytest.mark.parametrize(("known", "in_use", "period_s"), [(100, True, 1.0), (100, True, 2.0), (20, False, 1.0)])
def test_a_satellite_is_recognised_within_ten_seconds(rounding: str, known: int, in_use: bool, period_s: float) -> None:
    dice = random.Random(f"{rounding} {known} {period_s}")
    elements, late = catalogue(dice, known), []
    count = examples(64)
    for rise in rises(dice, elements, count):
        likely = used(rise, elements, dice) if in_use else ()
        watch = StreamWatch([Satellite(each, rise.site) for each in elements], likely)
        name, after_s = recognised_after_s(rise, watch, Program(ROUNDINGS[rounding], period_s), dice)
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
    for rise in rises(dice, elements, examples(64)):
        watch = StreamWatch([Satellite(each, rise.site) for each in elements])
        name, late_s = recognised_after_s(rise, watch, Program(ROUNDINGS[rounding]), dice)
        assert name == rise.elements.name
        after_s.append(late_s)
    after_s.sort()
    assert after_s[len(after_s) // 2] < LATE_S + 2.0
    assert after_s[len(after_s) * 9 // 10] < 22.0


@pytest.mark.search
@pytest.mark.parametrize(("waits", "rounded_s", "cut_off_s"), [(False, 10.0, 14.0), (True, 12.0, 18.0)])
def test_a_program_that_waits_at_the_horizon_is_recognised_when_its_elevation_leaves_zero(
    rounded_s: float, cut_off_s: float, *, waits: bool
) -> None:
    """Half of them as soon as this, among 20. In whole degrees elevation leaves zero when the satellite is at 0.5° or
    1°, and a slow one has its 30 orders by then."""
    for rounds, soon_s in ((ROUNDINGS["rounded"], rounded_s), (math.floor, cut_off_s)):
        dice = random.Random(f"early {waits}")
        elements, after_s = catalogue(dice, 20), []
        for rise in rises(dice, elements, examples(40)):
            watch = StreamWatch([Satellite(each, rise.site) for each in elements])
            name, late_s = recognised_after_s(rise, watch, Program(rounds, early_s=EARLY_S, waits=waits), dice)
            assert name == rise.elements.name
            after_s.append(late_s)
        assert statistics.median(after_s) <= soon_s
        assert max(after_s) < 32.0


@pytest.mark.search
@pytest.mark.parametrize("rounding", ROUNDINGS)
@pytest.mark.parametrize("joins", [0.2, 0.5, 0.8])
def test_a_program_that_joins_in_the_middle_of_a_pass_is_recognised(rounding: str, joins: float) -> None:
    """When the satellite has moved by three degrees; three of four before so many orders have come as are kept."""
    dice = random.Random(f"{rounding} {joins}")
    elements, after_s = catalogue(dice, 80), []
    for rise in rises(dice, elements, examples(40)):
        watch = StreamWatch([Satellite(each, rise.site) for each in elements])
        name, late_s = recognised_after_s(rise, watch, Program(ROUNDINGS[rounding], joins=joins), dice)
        assert name in ("", rise.elements.name)
        after_s.append(late_s)
    assert statistics.median(after_s) < 32.0
    assert sorted(after_s)[len(after_s) * 3 // 4] < KEPT


@every_row("known", [1, 3, 14, 100, 1000])
@every_row("likely", [0, 1, 8, 12])
def test_the_shares_of_all_satellites_add_up(known: int, likely: int) -> None:
    if likely > known:
        return
    counted = Known(known, likely)
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
        seconds[earlier] = recognised_after_s(rise, watch, Program(math.floor), random.Random(1))[1]
    assert seconds[rise.elements.name,] < ORDERS + 1.0
    assert seconds[rise.elements.name,] < seconds[()]
