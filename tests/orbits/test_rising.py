"""A stream that waits at the horizon for a rise names the satellite that rises there, and hardly anything else does."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import replace

import pytest

from benchmarks.recognition import catalogue
from rotator.exchange.orders import Aim
from rotator.orbits.earth import Site
from rotator.orbits.recognition import StreamWatch
from rotator.orbits.rising import LONGEST_WAIT_S, Rising
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import Sight
from tests.orbits.streams import PROGRAM, Path, great_circle, orders, path_of, whole
from tests.orbits.test_recognition import SATELLITES, rise_s
from tests.orbits.test_satellite import PARIS
from tests.search import examples
from tests.tables import every_row

NAME = "SO-50"


def waited_for(
    watch: StreamWatch,
    path: Path,
    from_s: float,
    seconds: int,
    rounds: Callable[[float], float] = whole,
    *,
    ahead_s: float = 0.0,
) -> Rising | None:
    """After a stream of so many orders; its program's clock is ahead."""
    for count, aim in enumerate(orders(path, from_s, seconds, rounds)):
        watch.hear(PROGRAM, aim, from_s - ahead_s + count)
    return watch.rising(PROGRAM)


def waiting(name: str) -> Path:
    """The place where it will rise, as a program sends it that waits there."""
    stands = path_of(SATELLITES[name])(rise_s(name))[0]
    return lambda _utc_s: (stands, 0.0)


@pytest.fixture
def watch() -> StreamWatch:
    return StreamWatch(SATELLITES.values())


@pytest.mark.long
@pytest.mark.parametrize("name", SATELLITES)
@pytest.mark.parametrize("rounds", [math.floor, whole, lambda deg: whole(deg * 100) / 100])
@pytest.mark.parametrize("ahead_s", [-5.0, 0.0, 5.0])
@pytest.mark.parametrize("waits", [False, True], ids=["below the horizon", "waits where it rises"])
def test_a_satellite_is_waited_for_before_its_rise_whatever_the_program_sends_until_then(
    watch: StreamWatch, name: str, rounds: Callable[[float], float], ahead_s: float, *, waits: bool
) -> None:
    path = waiting(name) if waits else path_of(SATELLITES[name])
    found = waited_for(watch, path, rise_s(name) - 90.0, 60, rounds, ahead_s=ahead_s)
    assert found is not None
    assert found.satellite.name == name
    assert found.rises_s == pytest.approx(rise_s(name), abs=2.0)
    assert watch.followed(PROGRAM) is None, "it is not recognised by this"


@every_row("name", SATELLITES)
@every_row("before_s", [30.0, 400.0, 1150.0])
@every_row("digits", [1, 2])
def test_one_order_finer_than_whole_degrees_names_a_satellite_in_use(name: str, before_s: float, digits: int) -> None:
    """A program that sends an order only when its target has moved sends one, and nothing until the rise."""
    path = waiting(name)

    def sent(angle_deg: float) -> float:
        return round(angle_deg, digits)

    assert waited_for(StreamWatch(SATELLITES.values()), path, rise_s(name) - 1150.0, 1, sent) is None
    found = waited_for(StreamWatch(SATELLITES.values(), [name]), path, rise_s(name) - before_s, 1, sent)
    assert found is not None
    assert found.satellite.name == name
    assert found.rises_s == pytest.approx(rise_s(name), abs=2.0)


def test_one_order_in_whole_degrees_names_nothing_and_three_are_enough(watch: StreamWatch) -> None:
    path, from_s = path_of(SATELLITES[NAME]), rise_s(NAME) - 30.0
    found = [waited_for(watch, path, from_s + count, 1) for count in range(4)]
    assert [each is not None for each in found] == [False, False, True, True]


@pytest.mark.parametrize("off_deg", [-4.0, 3.0, 90.0])
def test_another_azimuth_waits_for_nothing(watch: StreamWatch, off_deg: float) -> None:
    stands = waiting(NAME)
    assert waited_for(watch, lambda utc_s: (stands(utc_s)[0] + off_deg, 0.0), rise_s(NAME) - 30.0, 20) is None


def test_a_rise_long_after_now_is_not_waited_for(watch: StreamWatch) -> None:
    assert waited_for(watch, waiting(NAME), rise_s(NAME) - LONGEST_WAIT_S - 60.0, 20) is None


def test_an_antenna_above_the_horizon_waits_for_nothing(watch: StreamWatch) -> None:
    stands = waiting(NAME)
    assert waited_for(watch, lambda utc_s: (stands(utc_s)[0], 2.0), rise_s(NAME) - 30.0, 20) is None


def test_when_the_orders_turn_away_it_is_waited_for_no_more(watch: StreamWatch) -> None:
    stands, from_s = waiting(NAME), rise_s(NAME) - 60.0
    assert waited_for(watch, stands, from_s, 20) is not None
    watch.hear(PROGRAM, Aim(round(stands(0.0)[0] + 5.0) % 360.0, 0.0), from_s + 20.0)
    assert watch.rising(PROGRAM) is None


def test_of_two_that_fly_one_behind_the_other_none_is_waited_for() -> None:
    first = SATELLITES[NAME]
    later = replace(first.elements, name="later", catalogue_number=99_001)
    later = replace(later, mean_anomaly_deg=(later.mean_anomaly_deg - 0.2) % 360.0)
    watch = StreamWatch([first, Satellite(later, PARIS)])
    assert waited_for(watch, path_of(first), rise_s(NAME) - 60.0, 30) is None


@pytest.mark.search
def test_hardly_a_single_order_waits_for_one_of_a_dozen_in_use() -> None:
    dice = random.Random("one order at the horizon")
    elements, taken, count = catalogue(dice, 100), 0, examples(400)
    known = [Satellite(each, Site(48.85, 2.35)) for each in elements]
    for _ in range(count):
        watch = StreamWatch(known, [each.name for each in dice.sample(elements, 12)])
        utc_s = elements[0].epoch_utc_s + dice.uniform(0, 86_400.0)
        watch.hear(PROGRAM, Aim(dice.randrange(36_000) / 100, 0.0), utc_s)
        taken += watch.rising(PROGRAM) is not None
    assert taken <= max(2.0, 0.01 * count)


@pytest.mark.search
@pytest.mark.parametrize("moves", [False, True])
def test_hardly_a_stream_at_random_waits_for_one_of_a_hundred(*, moves: bool) -> None:
    dice = random.Random(f"at the horizon {moves}")
    elements, site, taken = catalogue(dice, 100), Site(48.85, 2.35), 0
    known = [Satellite(each, site) for each in elements]
    count = examples(200)
    for _ in range(count):
        from_s = elements[0].epoch_utc_s + dice.uniform(0, 86_400.0)
        stands = Sight(dice.uniform(0, 360), 0.0, math.inf)
        path = great_circle(stands, dice.choice((90.0, 270.0)), dice.uniform(0.0, 0.2) if moves else 0.0, from_s)
        watch = StreamWatch(known, [each.name for each in dice.sample(elements, 8)])
        level = waited_for(watch, lambda utc_s, path=path: (path(utc_s)[0], 0.0), from_s, 20)  # type: ignore[misc]
        taken += level is not None
    assert taken <= max(2.0, 0.01 * count)
