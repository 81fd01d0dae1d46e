"""A satellite is recognised in a program's orders by place, motion and direction; nothing else is taken for one."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

import pytest

from rotator.exchange.flight_order import Fly, Stream
from rotator.exchange.orders import Aim, Leave, Order, Speed, Stop
from rotator.exchange.program_clock import DEPARTS_DEG
from rotator.exchange.sources import Source
from rotator.orbits.passes import Pass, passes
from rotator.orbits.recognition import Departed, Recognised, StreamWatch
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import Sight
from rotator.orbits.stream_fit import CLOCKS_S, ORDERS
from rotator.tracking.next_flight import rest_of_pass
from tests.orbits.streams import PROGRAM, News, Path, great_circle, heard, orders, path_of, whole
from tests.orbits.test_satellite import FLYING, PARIS
from tests.search import examples

SATELLITES = {name: Satellite(elements, PARIS) for name, elements in FLYING.items()}


@cache
def first_day(name: str) -> list[Pass]:
    satellite = SATELLITES[name]
    from_s = satellite.elements.epoch_utc_s
    return list(passes(satellite, from_s, from_s + 86_400.0, 8.0))


def pass_of(name: str, number: int = 0) -> Pass:
    return first_day(name)[number]


def rise_s(name: str, number: int = 0) -> float:
    aos_s = pass_of(name, number).aos_s
    assert aos_s is not None
    return aos_s


@pytest.fixture
def watch() -> StreamWatch:
    return StreamWatch(SATELLITES.values())


def names(news: list[News]) -> list[tuple[type, str]]:
    return [(type(each.what), each.what.satellite.name) for each in news]


# --- what is recognised


@pytest.mark.long
@pytest.mark.parametrize("name", SATELLITES)
@pytest.mark.parametrize("number", [0, 1, 2])
@pytest.mark.parametrize("ahead_s", [-5.0, 0.0, 5.0])
def test_eight_orders_after_its_rise_it_is_recognised_and_stays_so_to_its_set(
    watch: StreamWatch, name: str, number: int, ahead_s: float
) -> None:
    flown = pass_of(name, number)
    assert flown.aos_s is not None
    assert flown.los_s is not None
    path, lasts_s = path_of(SATELLITES[name]), int(flown.los_s - flown.aos_s)
    news = heard(watch, path, flown.aos_s, lasts_s, ahead_s=ahead_s)
    assert names(news) == [(Recognised, name)]
    assert news[0].orders == ORDERS, "also RS-44, of which a whole degree changes 15 s after its rise"
    recognised = news[0].what
    assert isinstance(recognised, Recognised)
    least_s, most_s = recognised.stream.ahead_s
    assert least_s - 0.25 <= ahead_s <= most_s + 0.25


@pytest.mark.parametrize("name", SATELLITES)
@pytest.mark.parametrize("rounds", [math.floor, lambda deg: whole(deg * 10) / 10, lambda deg: whole(deg * 100) / 100])
def test_in_mid_pass_ten_orders_or_four_degrees_of_its_way_are_enough_however_the_program_rounds(
    watch: StreamWatch, name: str, rounds: Callable[[float], float]
) -> None:
    from_s = pass_of(name, 1).tca_s - 60.0
    found = [
        count + 1
        for count, aim in enumerate(orders(path_of(SATELLITES[name]), from_s, 30, rounds))
        if isinstance(watch.hear(PROGRAM, aim, from_s - 2.0 + count), Recognised)
    ]
    [count] = found
    moved_deg = SATELLITES[name].sight(from_s).apart_deg(SATELLITES[name].sight(from_s + count))
    assert count <= 10 or moved_deg < 4.0


def test_a_program_that_sends_each_whole_degree_once(watch: StreamWatch) -> None:
    flown = pass_of("ISS", 1)
    before, news = None, []
    for count, aim in enumerate(orders(path_of(SATELLITES["ISS"]), flown.tca_s - 240.0, 300)):
        if aim != before and (what := watch.hear(PROGRAM, aim, flown.tca_s - 240.0 + count)) is not None:
            news.append(what)
        before = aim
    assert [type(what) for what in news] == [Recognised]


def test_orders_faster_than_once_a_second_count_no_more(watch: StreamWatch) -> None:
    from_s, path = rise_s("ISS"), path_of(SATELLITES["ISS"])
    when_s = next(
        tenth / 10
        for tenth in range(300)
        if watch.hear(PROGRAM, next(orders(path, from_s + tenth / 10, 1)), from_s + tenth / 10) is not None
    )
    assert ORDERS - 2.0 <= when_s <= ORDERS + 2.0


def test_two_programs_are_heard_apart(watch: StreamWatch) -> None:
    other, path = Source("rotctld", 3), path_of(SATELLITES["ISS"])
    for count, aim in enumerate(orders(path, rise_s("ISS"), 12)):
        watch.hear(other, Aim(180.0, 30.0), rise_s("ISS") + count)
        watch.hear(PROGRAM, aim, rise_s("ISS") + count)
    assert watch.followed(other) is None
    followed = watch.followed(PROGRAM)
    assert followed is not None
    assert followed.satellite.name == "ISS"


# --- what is not


def standing(here: tuple[float, float]) -> Path:
    return lambda _utc_s: here


def shifted(path: Path, late_s: float) -> Path:
    return lambda utc_s: path(utc_s - late_s)


def mirrored(path: Path, about_deg: float) -> Path:
    return lambda utc_s: ((2 * about_deg - path(utc_s)[0]) % 360.0, path(utc_s)[1])


def at_pace(path: Path, pace: float, from_s: float) -> Path:
    return lambda utc_s: path(from_s + pace * (utc_s - from_s))


def above(path: Path, by_deg: float) -> Path:
    return lambda utc_s: (path(utc_s)[0], path(utc_s)[1] + by_deg)


TOP_S = pass_of("ISS", 2).tca_s
"""A pass that is 50° high."""
ISS = path_of(SATELLITES["ISS"])


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(standing(ISS(TOP_S)), id="stands where the satellite comes by"),
        pytest.param(shifted(ISS, 9.0), id="the same way, 9 s behind"),
        pytest.param(shifted(ISS, -9.0), id="the same way, 9 s before"),
        pytest.param(mirrored(ISS, ISS(TOP_S)[0]), id="mirrored at the highest point"),
        pytest.param(at_pace(ISS, 0.7, TOP_S), id="slower"),
        pytest.param(at_pace(ISS, 1.3, TOP_S), id="faster"),
        pytest.param(at_pace(ISS, -1.0, TOP_S), id="backwards"),
        pytest.param(above(ISS, 3.0), id="three degrees above"),
        pytest.param(lambda utc_s: (ISS(TOP_S)[0] + utc_s - TOP_S, ISS(TOP_S)[1]), id="a sweep through it"),
    ],
)
def test_what_nearly_is_the_satellite_is_not_taken_for_it(watch: StreamWatch, path: Path) -> None:
    assert heard(watch, path, TOP_S - 20.0, 60) == []


@pytest.mark.parametrize("name", SATELLITES)
def test_an_antenna_that_stood_before_where_a_satellite_rises_is_not_taken_for_it(
    watch: StreamWatch, name: str
) -> None:
    stands = standing(path_of(SATELLITES[name])(rise_s(name)))
    assert heard(watch, stands, rise_s(name) - 20.0, 80) == []


@pytest.mark.parametrize("name", SATELLITES)
def test_an_antenna_sent_at_its_rise_to_where_it_rises_is_let_go_when_it_has_moved(
    watch: StreamWatch, name: str
) -> None:
    satellite, from_s = SATELLITES[name], rise_s(name)
    azimuth_deg, _ = path_of(satellite)(from_s + 4.0)  # it has this azimuth, rounded, for eight seconds
    recognised, departed = heard(watch, standing((azimuth_deg, 0.0)), from_s, 80)
    assert names([recognised, departed]) == [(Recognised, name), (Departed, name)]
    slowest_s = from_s + departed.orders + CLOCKS_S[0]
    assert satellite.sight(slowest_s).apart_deg(satellite.sight(from_s)) < 1.0 + DEPARTS_DEG + 0.6


def test_an_antenna_in_a_whole_degree_that_the_satellite_leaves_at_once_is_not_taken_for_it(
    watch: StreamWatch,
) -> None:
    azimuth_deg, _ = ISS(rise_s("ISS"))
    assert 208.5 < azimuth_deg < 208.6  # and falls
    assert heard(watch, standing((azimuth_deg, 0.0)), rise_s("ISS"), 80) == []


def test_where_many_are_known_one_that_stands_is_none_of_them() -> None:
    elements = FLYING["ISS"]
    others = [Satellite(replace(elements, mean_anomaly_deg=7.2 * step), PARIS) for step in range(1, 50)]
    watch = StreamWatch([SATELLITES["ISS"], *others])
    assert heard(watch, standing(ISS(rise_s("ISS"))), rise_s("ISS"), 60) == []


@pytest.mark.long
@pytest.mark.parametrize("behind_s", [0.0, 1.0, 4.0])
def test_of_two_satellites_on_one_path_none_is_named(behind_s: float) -> None:
    elements = FLYING["ISS"]
    behind_deg = behind_s * elements.mean_motion_rev_per_day / 86_400.0 * 360.0
    twin = replace(
        elements,
        name="TWIN",
        catalogue_number=999_999_999,
        mean_anomaly_deg=(elements.mean_anomaly_deg - behind_deg) % 360.0,
    )
    watch = StreamWatch([SATELLITES["ISS"], Satellite(twin, PARIS)])
    assert heard(watch, ISS, rise_s("ISS"), 500) == []


@pytest.mark.search
def test_lines_that_begin_at_a_satellite_are_not_taken_for_it() -> None:
    """As fast as satellites are, but on another course or at another pace: near misses."""
    dice = random.Random(15)
    for _ in range(examples(200)):
        name = dice.choice(sorted(SATELLITES))
        satellite, utc_s = SATELLITES[name], pass_of(name, dice.randrange(3)).tca_s + dice.uniform(-200.0, 200.0)
        begin, soon = satellite.sight(utc_s), satellite.sight(utc_s + 1.0)
        if begin.elevation_deg < 5:
            continue
        path = great_circle(begin, *other_motion(dice, begin, soon), utc_s)
        assert heard(StreamWatch([satellite]), path, utc_s, 40) == []


def other_motion(dice: random.Random, begin: Sight, soon: Sight) -> tuple[float, float]:
    """Course and speed, neither of them the satellite's."""
    turned = math.radians((soon.azimuth_deg - begin.azimuth_deg + 180) % 360 - 180)
    course_deg = math.degrees(
        math.atan2(
            turned * math.cos(math.radians(begin.elevation_deg)),
            math.radians(soon.elevation_deg - begin.elevation_deg),
        )
    )
    speed_dps = begin.apart_deg(soon)
    if dice.random() < 0.5:
        return course_deg, speed_dps * dice.choice((dice.uniform(0.1, 0.6), dice.uniform(1.4, 2.0)))
    return course_deg + dice.uniform(40.0, 320.0), speed_dps


# --- how it ends


@pytest.fixture
def followed(watch: StreamWatch) -> StreamWatch:
    heard(watch, ISS, TOP_S - 60.0, 60)
    assert watch.followed(PROGRAM) is not None
    return watch


@pytest.mark.parametrize(("off_deg", "departs"), [(1.4, False), (3.2, True)])
def test_it_departs_by_more_than_its_rounding_and_a_degree_and_a_half(
    followed: StreamWatch, off_deg: float, departs: bool
) -> None:
    # Across the path: no clock explains that.
    here, soon = SATELLITES["ISS"].sight(TOP_S), SATELLITES["ISS"].sight(TOP_S + 1.0)
    assert abs(soon.elevation_deg - here.elevation_deg) < 0.1, "it flies level at its highest"
    news = followed.hear(PROGRAM, Aim(whole(here.azimuth_deg), whole(here.elevation_deg + off_deg)), TOP_S)
    assert news == (Departed(PROGRAM, SATELLITES["ISS"]) if departs else None)
    assert (followed.followed(PROGRAM) is None) is departs


def test_a_program_that_stays_behind_departs(followed: StreamWatch) -> None:
    [news] = heard(followed, standing(ISS(TOP_S - 1.0)), TOP_S, 10)
    assert isinstance(news.what, Departed)


@pytest.mark.parametrize(
    "order", [Stop(), Aim(200.0, None), Aim(400.0, 30.0), Aim(100.0, 120.0), Aim(1.0, 1.0, engaged=False), Leave()]
)
def test_another_order_ends_it(followed: StreamWatch, order: Order) -> None:
    assert followed.hear(PROGRAM, order, TOP_S) == Departed(PROGRAM, SATELLITES["ISS"])
    assert followed.followed(PROGRAM) is None


@pytest.mark.parametrize(("late_s", "goes_on"), [(0.005, True), (0.29, True), (0.5, False)])
def test_a_stop_right_before_its_next_order_does_not_end_it(
    followed: StreamWatch, late_s: float, goes_on: bool
) -> None:
    """As from a logger that sends `S` before each `P`."""
    followed.hear(PROGRAM, Stop(), TOP_S)
    assert followed.followed(PROGRAM) is None, "a stop is a stop until then"
    here = SATELLITES["ISS"].sight(TOP_S + late_s)
    followed.hear(PROGRAM, Aim(whole(here.azimuth_deg), whole(here.elevation_deg)), TOP_S + late_s)
    assert (followed.followed(PROGRAM) is not None) is goes_on


@pytest.mark.parametrize("order", [Speed(2), Stop()])
@pytest.mark.parametrize("sender", [Source("rotctld", 9)])
def test_what_others_order_does_not(followed: StreamWatch, sender: Source, order: Order) -> None:
    assert followed.hear(sender, order, TOP_S) is None
    assert followed.followed(PROGRAM) is not None


def test_a_program_that_names_its_turn_is_not_planned_for_again(watch: StreamWatch) -> None:
    watch.hear(PROGRAM, Aim(365.0, 10.0), TOP_S - 100.0)
    assert heard(watch, ISS, TOP_S - 60.0, 60) == []
    watch.hear(PROGRAM, Leave(), TOP_S)
    assert names(heard(watch, ISS, TOP_S, 60)) == [(Recognised, "ISS")]


def test_the_next_satellite_of_the_same_program_is_recognised(followed: StreamWatch) -> None:
    news = heard(followed, path_of(SATELLITES["SO-50"]), rise_s("SO-50", 1), 60)
    assert names(news) == [(Departed, "ISS"), (Recognised, "SO-50")]


# --- what it costs, and what is flown


@dataclass
class Counted:
    satellite: Satellite
    name: str
    sights: int = 0

    def __hash__(self) -> int:
        return hash(self.name)

    def sight(self, utc_s: float) -> Sight:
        self.sights += 1
        return self.satellite.sight(utc_s)

    def late_s(self, utc_s: float) -> float:
        return self.satellite.late_s(utc_s)


def test_a_hundred_satellites_cost_little() -> None:
    elements = FLYING["SO-50"]
    many = [
        Counted(Satellite(replace(elements, ascending_node_deg=3.6 * step), PARIS), f"OF {step}") for step in range(100)
    ]
    from_s, seconds = rise_s("ISS"), 300
    heard(StreamWatch(many), ISS, from_s, seconds)
    assert sum(each.sights for each in many) / seconds < 25, "positions per order"


def test_the_path_to_be_flown_begins_before_the_orders_and_ends_after_the_set() -> None:
    flown = pass_of("ISS")
    assert flown.aos_s is not None
    assert flown.los_s is not None
    rows, sets_s = rest_of_pass(SATELLITES["ISS"], flown.aos_s + 10.0)
    assert rows[0][0] <= flown.aos_s + 10.0 - 6.0
    assert sets_s == pytest.approx(flown.los_s, abs=1.0)
    assert rows[-1][0] == pytest.approx(flown.los_s + 30.0, abs=1.5)
    assert rows[-1][2] < 0


def test_the_flight_in_its_place_is_no_order_of_the_program(followed: StreamWatch) -> None:
    plan: Order = Fly("ISS", ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), None, None, stream=Stream(1.0, (0.0, 0.0)))  # type: ignore[arg-type]
    assert followed.hear(PROGRAM, plan, TOP_S) is None
    assert followed.followed(PROGRAM) is not None
