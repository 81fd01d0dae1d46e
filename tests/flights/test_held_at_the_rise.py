"""A program that holds the antenna where the satellite will rise, with decimals, as Gpredict does over rotctld."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import pytest

from rotator.config.load import parse
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, Pass, read_pass

HELD_S = 30.0


def held(name: str) -> Pass:
    """The shipped pass, and before it the place where it begins."""
    rows = read_pass(SHIPPED / f"{name}.csv").rows
    _, azimuth_deg, elevation_deg = rows[0]
    return Pass(name, ((0.0, azimuth_deg, elevation_deg), *((t_s + HELD_S, az, el) for t_s, az, el in rows)))


def flown(name: str) -> Summary:
    return fly(held(name), plant_maker(parse("", "shipped"), via="rotctld"))[1]


@pytest.fixture(scope="session")
def summaries() -> dict[str, Summary]:
    names = ("mid-3-rs-44", "north-1-iss", "high-2-so-50")
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        return dict(zip(names, pool.map(flown, names), strict=True))


def test_it_is_followed_from_its_first_degree(summaries: dict[str, Summary]) -> None:
    """A path that was drawn through where the target stood and where it went led 72.9° and 18.3° astray in two."""
    assert {name: summary.max_deg for name, summary in summaries.items() if summary.max_deg > 6.5} == {}
    assert {name: summary.rms_deg for name, summary in summaries.items() if summary.rms_deg > 2.3} == {}
