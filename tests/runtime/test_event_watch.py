"""The event loop stands still: no link can stop the antenna, so what links ordered ends, and no sign of life is given.

Judged by the simulated rotor's motors and by its true angles.
"""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis, Direction
from rotator.box.app import App
from rotator.config.load import parse
from rotator.exchange.orders import Aim, Home, Jog, LoadTimed, Mode, Order, Park, RunTimed, SetMode, Stop, Take
from rotator.exchange.sources import PAGE, TRACKER, Source
from rotator.runtime.event_watch import LONGEST_S, TICK_S, EventWatch
from tests.runtime import loop_rig
from tests.runtime.loop_rig import LINK, PATIENCE_S, PERIOD_S
from tests.tables import every_row

PANEL, CONSOLE = Source("panel"), Source("console", 1)
BROWSER = Source(PAGE, 2)
TRACK = Source(TRACKER)
COAST_S = 1.5
"""The motor's coast, its relay's delay, and a cycle."""


class Rig(loop_rig.Rig):
    """Its event loops tick until a test lets one stand still."""

    def __init__(self, text: str = "") -> None:
        self.signs = 0
        self.ticking = self.page_ticking = True
        clock = SimClock()
        self.events, self.page_events = EventWatch(clock), EventWatch(clock)
        super().__init__(text, clock, after_good_step=self._sign, events=self.events, page_events=self.page_events)
        self._ticked_s = self._page_ticked_s = self.clock()

    def _sign(self) -> None:
        self.signs += 1

    def before_cycle(self) -> None:
        if self.ticking and self.clock() >= self._ticked_s + TICK_S:
            self._ticked_s = self.clock()
            self.events.tick()
        if self.page_ticking and self.clock() >= self._page_ticked_s + TICK_S:
            self._page_ticked_s = self.clock()
            self.page_events.tick()

    def order(self, source: Source, *orders: Order) -> None:
        for order in orders:
            self.loop.post(source, order)
        self.run(1.0)

    def turned_deg(self, seconds: float) -> float:
        """How far the antenna turns in so many seconds."""
        before = self.world.antenna()
        self.run(seconds)
        return float(sum(abs(now - then) for now, then in zip(self.world.antenna(), before, strict=True)))


@pytest.mark.long
@every_row(
    "orders",
    [
        (Aim(300.0, 20.0),),
        (Aim(100.0, 150.0),),
        (Jog(Axis.AZIMUTH, Direction.PLUS),),
        (Jog(Axis.ELEVATION, Direction.PLUS),),
        (Park(),),
        (LoadTimed(1.0, ((200.0, 90.0), (300.0, 20.0), (10.0, 90.0))), RunTimed()),
    ],
)
def test_what_a_link_ordered_ends_and_begins_again_with_the_next_order(orders: tuple[Order, ...]) -> None:
    rig = Rig()
    rig.order(LINK, *orders)
    assert rig.turned_deg(1.0) > 1.0
    rig.ticking = False
    rig.run(LONGEST_S + COAST_S)
    signs = rig.signs
    assert rig.turned_deg(60.0) < 0.01
    assert rig.signs == signs, "a sign of life while no stop arrives"
    rig.ticking = True
    assert rig.turned_deg(10.0) < 0.01, "the old order is not taken up again"
    assert rig.signs > signs
    rig.order(LINK, Aim(300.0, 150.0))
    assert rig.turned_deg(1.0) > 1.0


def test_a_search_for_the_end_stop_ends() -> None:
    rig = Rig('[rotor]\ntype = "relay-pulse"\n')
    rig.run(PATIENCE_S)  # before its first relay the axis is seen to stand
    rig.order(CONSOLE, Home(Axis.AZIMUTH))
    assert rig.turned_deg(1.0) > 1.0
    rig.ticking = False
    rig.run(LONGEST_S + COAST_S)
    assert rig.turned_deg(60.0) < 0.01


def test_the_panel_and_a_storm_park_go_on() -> None:
    """The panel has a thread of its own. A storm park is wanted by a person, and its end is the safe place."""
    rig = Rig()
    rig.order(PANEL, SetMode(Mode.JOG), Jog(Axis.AZIMUTH, Direction.PLUS))
    rig.ticking = False
    rig.run(LONGEST_S + COAST_S)
    assert rig.turned_deg(1.0) > 1.0
    storm = Rig()
    storm.order(CONSOLE, Park(storm=True))
    storm.ticking = False
    storm.run(LONGEST_S + COAST_S)
    assert storm.turned_deg(1.0) > 1.0


PAGE_ORDERS: list[Order] = [
    Aim(300.0, 20.0),
    Jog(Axis.AZIMUTH, Direction.PLUS),
    Park(),
]


@pytest.mark.long
@pytest.mark.parametrize("order", PAGE_ORDERS, ids=lambda order: type(order).__name__)
def test_what_was_ordered_on_a_page_that_stands_still_ends(order: Order) -> None:
    """Its STOP would not arrive either."""
    rig = Rig()
    rig.order(BROWSER, order)
    assert rig.turned_deg(1.0) > 1.0
    rig.page_ticking = False
    rig.run(LONGEST_S + COAST_S)
    signs = rig.signs
    assert rig.turned_deg(60.0) < 0.01
    assert rig.signs > signs, "the box itself is well: nothing restarts it"
    rig.page_ticking = True
    assert rig.turned_deg(10.0) < 0.01, "the old order is not taken up again"
    rig.order(BROWSER, Aim(300.0, 150.0))
    assert rig.turned_deg(1.0) > 1.0


def test_what_a_person_tracks_on_a_page_that_stands_still_ends_also_where_its_plan_is_not_ready() -> None:
    rig, heard = Rig(), list[tuple[Source, Order]]()
    rig.order(BROWSER, Take(stops=False))
    rig.order(TRACK, Aim(300.0, 20.0))
    assert rig.turned_deg(1.0) > 1.0
    rig.loop.overhear(lambda source, order: heard.append((source, order)))
    rig.page_ticking = False
    rig.run(LONGEST_S + COAST_S)
    assert rig.turned_deg(60.0) < 0.01
    assert [order for _, order in heard] == [Stop()], "the tracker hears of it, once"


@pytest.mark.parametrize("holder", [None, CONSOLE], ids=str)
def test_what_a_person_at_the_console_tracks_goes_on_without_the_page(holder: Source | None) -> None:
    rig, heard = Rig(), list[tuple[Source, Order]]()
    if holder:
        rig.order(holder, Take(stops=False))
    rig.order(TRACK, Aim(300.0, 20.0))
    rig.loop.overhear(lambda source, order: heard.append((source, order)))
    rig.page_ticking = False
    rig.run(LONGEST_S + COAST_S)
    assert rig.turned_deg(1.0) > 1.0
    assert heard == []


@pytest.mark.parametrize(
    ("source", "order"),
    [(LINK, Aim(300.0, 20.0)), (CONSOLE, Jog(Axis.AZIMUTH, Direction.PLUS)), (BROWSER, Park(storm=True))],
    ids=["a link", "the console", "a storm park of the page"],
)
def test_a_page_that_stands_still_ends_nothing_else(source: Source, order: Order) -> None:
    rig = Rig()
    rig.order(source, order)
    rig.page_ticking = False
    rig.run(LONGEST_S + COAST_S)
    assert rig.turned_deg(1.0) > 1.0


def test_a_box_without_links_is_not_watched() -> None:
    """A rehearsal has no event loop."""
    rig = Rig()
    rig.ticking = False
    rig.order(LINK, Aim(300.0, 20.0))
    assert rig.turned_deg(10.0) > 30.0


def test_a_pause_shorter_than_the_limit_ends_nothing() -> None:
    rig = Rig()
    rig.order(LINK, Aim(300.0, 20.0))
    for _ in range(10):
        rig.ticking = False
        assert rig.turned_deg(LONGEST_S - TICK_S - 2 * PERIOD_S) > 1.0
        rig.ticking = True
        rig.run(2 * TICK_S)


async def test_the_real_threads(tmp_path: Path) -> None:
    """The whole box: an event loop that is stuck in a callback. The motors stop before the callback ends."""
    config = parse(f'[state]\npath = "{tmp_path / "state.json"}"\n', "test")
    stood = threading.Event()
    app, stop = App(config), asyncio.Event()
    box = asyncio.create_task(app.run(stop))
    world = app.station.world
    assert world is not None
    while not app.loop.status.azimuth.moving:
        app.loop.post(LINK, Aim(300.0, 20.0))
        await asyncio.sleep(0.05)
    pause = threading.Event()
    for _ in range(int(PATIENCE_S / 0.1)):
        pause.wait(0.1)  # the event loop is stuck here
        if world.drives() == (0, 0):
            stood.set()
            break
    stop.set()
    await box
    assert stood.is_set()
