"""The table of standing streams, measured again on other orbits; which streams fit a rise, and which do not."""

from __future__ import annotations

import math
import random
from itertools import pairwise

import pytest

from benchmarks.recognition import catalogue
from rotator.orbits.chance import STANDING, lift_off_chance, rise_chance, standing_chance
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Sight
from rotator.orbits.stream_fit import CLOCKS_S, Heard, SampledPath
from tests.search import examples
from tests.tables import every_row

HALF_DAY_S = 43_200.0
ROUND_RISE_S, ROUND_RISE_DEG = 16.0, 3.0
"""Streams begin up to so long and so far from the rise. None further away fits."""
AZIMUTH_DPS, ELEVATION_DPS = 0.04, 0.05
"""As a satellite near the earth moves at its rise."""


class Rises:
    """Rises at second 0 in azimuth 90, and moves evenly."""

    name = "rises"

    def sight(self, utc_s: float) -> Sight:
        return Sight(90.0 + AZIMUTH_DPS * utc_s, ELEVATION_DPS * utc_s, math.inf)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


def stands(azimuth_deg: float, from_s: float, lasts_s: float, elevation_deg: float = 0.0) -> list[Heard]:
    return [Heard(from_s + second, azimuth_deg, elevation_deg) for second in (0.0, lasts_s)]


def chance(orders: list[Heard]) -> float:
    return standing_chance(SampledPath(Rises()), orders, CLOCKS_S, 1.0)


def rises_at_random(dice: random.Random, count: int) -> tuple[list[tuple[SampledPath, float]], float]:
    """Paths with the moment of a rise; and the mean seconds between two rises of one satellite."""
    elements = catalogue(dice, 100)
    found: list[tuple[SampledPath, float]] = []
    watched_s = 0.0
    while len(found) < count:
        site = Site(math.degrees(math.asin(dice.uniform(-0.95, 0.95))), dice.uniform(-180, 180))
        each = dice.choice(elements)
        from_s = each.epoch_utc_s + dice.uniform(0, 8 * 86_400.0)
        satellite = Satellite(each, site)
        try:
            seen = [one.aos_s for one in passes(satellite, from_s, from_s + HALF_DAY_S, 0.3)]
        except NotThere:
            continue
        watched_s += HALF_DAY_S
        found += [(SampledPath(satellite), aos_s) for aos_s in seen if aos_s is not None and aos_s > from_s]
    return found, watched_s / len(found)


@pytest.mark.search
def test_the_table_is_what_orbits_at_random_give() -> None:
    dice = random.Random("standing")
    rises, every_s = rises_at_random(dice, examples(400))
    tried = 0
    fits = {(lasts_s, column): 0 for lasts_s, *_ in STANDING[:6] for column in (1, 2)}
    for path, aos_s in rises:
        azimuth_deg = path.at(aos_s).azimuth_deg
        for _ in range(20):
            tried += 1
            from_s = aos_s + dice.uniform(-ROUND_RISE_S, ROUND_RISE_S)
            at_deg = (azimuth_deg + dice.uniform(-ROUND_RISE_DEG, ROUND_RISE_DEG)) % 360.0
            for lasts_s, rounded, either in STANDING[:6]:
                found = standing_chance(path, stands(at_deg, from_s, lasts_s), CLOCKS_S, 1.0)
                fits[lasts_s, 1] += found == rounded
                fits[lasts_s, 2] += found <= either
    one = 2 * ROUND_RISE_S / every_s * 2 * ROUND_RISE_DEG / 360.0 / tried
    for lasts_s, rounded, either in STANDING[:6]:
        assert fits[lasts_s, 1] * one == pytest.approx(rounded, rel=0.3, abs=3e-7)
        assert fits[lasts_s, 2] * one == pytest.approx(either, rel=0.3, abs=3e-7)


def test_the_longer_it_stands_the_fewer_satellites_fit() -> None:
    for before, after in pairwise(STANDING):
        assert before[0] < after[0]
        assert before[1] >= after[1]
        assert before[2] >= after[2]
    assert all(rounded <= either for _, rounded, either in STANDING)


@every_row(
    ("azimuth_deg", "from_s", "lasts_s", "expected"),
    [
        (90.0, 0.0, 8.0, 2.8e-6),
        (90.0, 0.0, 8.5, 2.6e-6),
        (90.0, 0.0, 2.0, 2.8e-6),  # no less than eight seconds are ever enough
        (90.0, 5.0, 8.0, 2.8e-6),  # by a clock that is behind
        (90.0, -5.0, 8.0, 2.8e-6),
        (90.0, 0.0, 14.0, 1.5e-6),  # 0.7 degrees high by then: cut off
        (89.2, 0.0, 8.0, 4.3e-6),  # almost a degree behind: cut off
        (90.6, 0.0, 8.0, 2.8e-6),
        (91.3, 0.0, 8.0, 1.0),  # it never gets so far
        (88.5, 0.0, 8.0, 1.0),
        (90.0, 12.0, 8.0, 1.0),  # has risen too long ago for any clock
        (90.0, -12.0, 8.0, 1.0),
        (90.0, 0.0, 40.0, 1.0),  # two degrees high by then
    ],
)
def test_which_standing_streams_fit_a_rise(azimuth_deg: float, from_s: float, lasts_s: float, expected: float) -> None:
    assert chance(stands(azimuth_deg, from_s, lasts_s)) == pytest.approx(expected)


def test_a_stream_above_the_horizon_begins_with_no_rise() -> None:
    orders = stands(90.0, 0.0, 8.0, 1.0)
    assert chance(orders) == 1.0
    assert rise_chance(SampledPath(Rises()), orders, CLOCKS_S, 1.0) == 1.0


def leaves(azimuth_deg: float, at_s: float, rounding: float = 1.0) -> list[Heard]:
    """The elevation leaves zero at this second."""
    return [Heard(at_s - 1.0, azimuth_deg, 0.0), Heard(at_s, azimuth_deg, rounding)]


@every_row(
    ("azimuth_deg", "at_s", "fits"),
    [
        (90.0, 10.0, True),  # rounded: half a degree high
        (90.0, 20.0, True),  # cut off: a degree high
        (90.0, 4.0, True),  # rounded, by a clock that is ahead
        (90.0, 26.0, True),  # cut off, by a clock that is behind
        (90.0, 0.0, False),  # as it rises: no rounding gives a degree so early
        (90.0, 35.0, False),
        (89.4, 10.0, True),
        (91.2, 10.0, False),  # it has not come so far
        (87.0, 10.0, False),
    ],
)
def test_which_streams_leave_the_horizon_with_a_satellite(azimuth_deg: float, at_s: float, *, fits: bool) -> None:
    assert (lift_off_chance(SampledPath(Rises()), leaves(azimuth_deg, at_s), CLOCKS_S, 1.0) < 1.0) == fits
