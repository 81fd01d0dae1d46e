"""A star is followed until a stop, another's order, its setting, or a refusal; judged by what the box was ordered."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from hw.ports import Axis
from rotator.exchange.orders import Aim, Park, Stop
from rotator.exchange.sources import Source
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.orbits.earth import Site
from rotator.protocols.star_follower import LATE_BEATS, StarFollower

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

OTHER = Source("other", 1)
SITE = Site(52.5, 13.4)
START_S = 1.8e9


class Bench:
    """A follower on a box, and one clock for both."""

    def __init__(self, box: BenchBox) -> None:
        self.box = box
        self.began_s = box.now_s
        self.remarks: list[str] = []
        self.sky = Sky(SITE, lambda: START_S + self.box.now_s - self.began_s)
        self.follower = StarFollower(box, self.sky, self.remarks.append)
        box.follows = True

    def star(self, azimuth_deg: float, elevation_deg: float) -> Star:
        return self.sky.star(azimuth_deg, elevation_deg, Equinox.J2000)

    def beats(self, count: int, every_s: float = 1.0) -> None:
        for _ in range(count):
            self.box.wait(every_s)
            self.follower.beat()


@pytest.fixture
def bench(box: BenchBox) -> Bench:
    return Bench(box)


@pytest.mark.long
def test_it_goes_with_the_sky(bench: Bench) -> None:
    star = bench.star(180, 30)
    assert bench.follower.go(star) is None
    bench.beats(200, 3)
    last = bench.box.orders[-1]
    assert isinstance(last, Aim)
    assert (last.azimuth_deg, last.elevation_deg) == pytest.approx(bench.sky.direction(star), abs=0.01)
    # Ten minutes are 2.5° of the earth's turn; in the south azimuth goes faster than that.
    assert last.azimuth_deg == pytest.approx(182.7, abs=0.5)
    assert bench.remarks == []


@pytest.mark.long
@pytest.mark.parametrize("order", [Stop(), Stop((Axis.AZIMUTH,)), Stop(latch=True), Aim(100, 20), Park()])
def test_what_another_orders_ends_it(bench: Bench, order: Stop | Aim | Park) -> None:
    bench.follower.go(bench.star(180, 30))
    bench.beats(20)
    bench.box.order(order, OTHER)
    before = list(bench.box.orders)
    bench.beats(100)
    assert bench.box.orders == before, "not one more order comes from the follower"
    assert bench.follower.follows is None
    assert bench.remarks == ["no longer follows its star: a stop or another order has come"]


def test_an_order_that_is_only_late_does_not_end_it(new_box: type[BenchBox]) -> None:
    box = new_box(at_once=False)
    bench = Bench(box)
    bench.follower.go(bench.star(180, 30))
    bench.follower.beat()
    bench.beats(5)
    assert bench.follower.follows is not None
    assert LATE_BEATS > 1


def test_a_latched_stop_keeps_the_antenna_where_it_is(bench: Bench) -> None:
    bench.box.order(Stop(latch=True), OTHER)
    bench.follower.go(bench.star(180, 30))
    bench.beats(10)
    assert bench.follower.follows is None
    assert bench.box.turned == set()


def test_a_star_below_the_horizon_is_refused(bench: Bench) -> None:
    assert bench.follower.go(bench.star(180, -0.1)) is not None
    bench.beats(5)
    assert bench.box.orders == []


@pytest.mark.long
def test_its_setting_ends_it(bench: Bench) -> None:
    bench.follower.go(bench.star(270, 0.5))
    bench.beats(200, 3)
    assert bench.remarks == ["no longer follows its star: it has set"]
    assert all(isinstance(order, Aim) and (order.elevation_deg or 0) >= 0 for order in bench.box.orders)


@pytest.mark.long
def test_the_end_of_the_rotor_s_range_ends_it(new_box: type[BenchBox]) -> None:
    bench = Bench(new_box(azimuth=(0.0, 185.0)))
    bench.follower.go(bench.star(184.5, 30))
    bench.beats(200, 3)
    assert bench.follower.follows is None
    assert all(isinstance(order, Aim) and (order.azimuth_deg or 0) <= 185 for order in bench.box.orders)
