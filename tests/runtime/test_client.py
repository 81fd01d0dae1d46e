"""One connection's client to the box: who may order, how fast, and what the log hears of it."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.orders import Aim, Calibrate, Jog, Order, Park, Speed, Stop
from rotator.exchange.sources import Source
from rotator.protocols.aiming import outside
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.runtime.client import Client, Rights
from rotator.runtime.log_limit import LogLimit
from rotator.runtime.loop import ControlLoop

CONFIG = parse("[azimuth]\nmax_deg = 310\n", "bench")


class Inbox(ControlLoop):
    """The control loop, and a note of how each order came to it: from which connection, and whether it can wait."""

    posted: list[tuple[int, Order, bool]]

    def post(self, source: Source, order: Order, *, can_wait: bool = False) -> None:
        self.posted.append((source.connection, order, can_wait))
        super().post(source, order, can_wait=can_wait)


class Bench:
    """A box with azimuth 0 to 310, at 235/25 in simulated time, which acts when told."""

    def __init__(self) -> None:
        self.clock = SimClock()
        self.station = Station(CONFIG, self.clock, self.clock.sleep, (235.0, 25.0))
        self.loop = Inbox(build_controller(CONFIG), self.station.rotor, self.clock, 0.05)
        self.loop.posted = []
        self.complaints = LogLimit(self.clock)
        for _ in range(60):  # it closes no relay before it has seen both axes stand
            self.loop.cycle()
            self.clock.sleep(0.05)

    def client(self, connection: int = 1, **rights: int) -> Client:
        return Client(
            self.loop,
            build_mount(CONFIG),
            Source("link", connection),
            rights=Rights(**rights),  # type: ignore[arg-type]
            complaints=self.complaints,
            clock=self.clock,
        )

    def drives(self) -> tuple[int, int]:
        assert self.station.world is not None
        self.loop.act()
        return self.station.world.drives()


@pytest.fixture
def bench() -> Iterator[Bench]:
    bench = Bench()
    yield bench
    bench.station.close()


# --- read_only


@pytest.mark.parametrize("order", [Aim(10, 10), Jog(Axis.AZIMUTH, Direction.PLUS), Stop(), Park(), Speed(1),
                                   Calibrate(Axis.AZIMUTH, high_end=True)])  # fmt: skip
def test_a_read_only_link_gives_no_orders_not_even_a_stop(bench: Bench, order: Order) -> None:
    owner, visitor = bench.client(1), bench.client(2, read_only=True)
    owner.order(Aim(300, 25))
    assert bench.drives() == (1, 0)
    refused = visitor.order(order)
    assert refused is not None
    assert refused.forbidden
    assert bench.drives() == (1, 0)
    assert visitor.status() is bench.loop.status


def test_each_protocol_refuses_in_its_own_words(bench: Bench) -> None:
    client = bench.client(read_only=True)
    assert Gs232Session(client, Dialect.B).receive(b"W100 020\rS\rC2\r") == [
        b"?>\r\n",
        b"?>\r\n",
        b"AZ=235  EL=025\r\n",
    ]
    rotctld = RotctldSession(client)
    assert rotctld.receive(b"P 100 20\nS\nK\nM CW 50\nR 1\n") == [b"RPRT -9\n"] * 5
    assert rotctld.receive(b"+S\n") == [b"stop:\nRPRT -9\n"]
    # What cannot be reached is the order's own fault, and has a number of its own.
    assert RotctldSession(bench.client()).receive(b"P 330 20\n") == [b"RPRT -1\n"]


def test_a_program_that_repeats_a_refused_order_does_not_fill_the_log(
    bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    client = bench.client()
    for _ in range(20 * 61):
        assert client.order(Aim(330, 10)) is not None
        bench.clock.sleep(0.05)
    first, second = (record.message for record in caplog.records)
    assert first.startswith("link#1: refused: ")
    assert re.fullmatch(re.escape(first) + r" \((1199|1200) similar lines before this one are not shown\)", second)


@pytest.mark.parametrize(
    ("orders", "range_named"),
    [
        ([Aim(325 + at / 10, 10) for at in range(300)], "outside the rotor's range of"),
        ([Aim(-500 + at, 10) for at in range(300)], "outside -180 to 540 degrees"),
        ([Aim(10, 200 + at) for at in range(300)], "outside -90 to 180 degrees"),
        ([Aim(None, 200 + at) for at in range(300)], "outside -90 to 180 degrees"),
        ([Aim(float("nan"), 10) for _ in range(300)], "azimuth nan is outside"),
    ],
)
def test_a_target_out_of_range_is_in_the_log_once_a_minute(
    bench: Bench, caplog: pytest.LogCaptureFixture, orders: list[Aim], range_named: str
) -> None:
    """A program that tracks sends other angles each second: five minutes of it are at most six lines."""
    client = bench.client()
    for order in orders:
        refused = client.order(order)
        assert refused is not None
        assert refused.out_of_range
        bench.clock.sleep(1)
    lines = [record.message for record in caplog.records]
    assert 5 <= len(lines) <= 6
    assert all(line.startswith("link#1: refused: ") and range_named in line for line in lines)


def test_what_a_protocol_refuses_itself_shares_that_line(bench: Bench, caplog: pytest.LogCaptureFixture) -> None:
    client = bench.client()
    client.note_refused(outside(470, 450))
    client.order(Aim(-500, 10))
    client.note_refused(b"P 1x0 \xff" + b"5" * 100)
    first, second = (record.message for record in caplog.records)
    assert first == "link#1: refused: azimuth 470 is outside 0 to 450 degrees"
    assert second == "link#1: refused: 'P 1x0 \\xff" + "5" * 53 + "' is no order"


# --- most_per_s


def test_what_exceeds_waits_for_the_cycle_and_the_newest_wins(bench: Bench) -> None:
    client = bench.client(most_per_s=10)
    for _ in range(10):
        assert client.order(Aim(300, 25)) is None
    for azimuth_deg in range(1000):
        assert client.order(Aim(azimuth_deg % 200, 25)) is None
    assert [can_wait for _, _, can_wait in bench.loop.posted] == [False] * 10 + [True] * 1000
    assert bench.drives() == (-1, 0)
    assert bench.loop.status.wanted_azimuth_deg == 199


def test_a_stop_is_never_too_much(bench: Bench) -> None:
    client = bench.client(most_per_s=1)
    for _ in range(50):
        client.order(Aim(300, 25))
    assert bench.drives() == (1, 0)
    for _ in range(50):
        client.order(Aim(300, 25))
    client.order(Stop())
    assert bench.loop.posted[-1] == (1, Stop(), False)
    assert bench.drives() == (0, 0)


def test_two_axes_are_two_kinds(bench: Bench) -> None:
    client = bench.client(most_per_s=1)
    client.order(Speed(1))
    for direction in (Direction.MINUS, Direction.PLUS):
        for axis in Axis:
            client.order(Jog(axis, direction))
    assert bench.drives() == (1, 1)


def test_the_orders_of_one_connection_do_not_count_against_another(bench: Bench) -> None:
    flood, other = bench.client(1, most_per_s=5), bench.client(2, most_per_s=5)
    for _ in range(100):
        flood.order(Aim(100, 25))
    other.order(Aim(300, 25))
    assert bench.loop.posted[-2:] == [(1, Aim(100, 25), True), (2, Aim(300, 25), False)]


def test_too_many_orders_are_logged_once(bench: Bench, caplog: pytest.LogCaptureFixture) -> None:
    client = bench.client(most_per_s=10)
    for _ in range(1000):
        client.order(Aim(300, 25))
    (record,) = caplog.records
    assert record.message == (
        "link#1: more than 10 orders a second: of those beyond, only the newest of each kind counts"
    )


def test_a_status_says_that_an_order_does_not_show_in_it_yet(bench: Bench) -> None:
    asking, ordering = bench.client(1), bench.client(2)
    assert not asking.status().orders_wait
    ordering.order(Stop(latch=True))
    assert asking.status().orders_wait
    assert not asking.status().latched
    bench.loop.cycle()
    assert not asking.status().orders_wait
    assert asking.status().latched == "link#2"
