"""The demo pass: who may ask for it and when, that it takes the antenna from nobody, that it is a pass of the ISS."""

from __future__ import annotations

import pytest

from rotator.assembly.settings import build_mount
from rotator.config.load import parse
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.orders import Aim, Order, Stop, Take
from rotator.exchange.sources import CONSOLE, PAGE, Source
from rotator.orbits.demo_pass import FAST, PASSES, demo_pass
from rotator.protocols.methods import Demo
from rotator.protocols.operating import Operating
from rotator.runtime.client import Client
from tests.protocols.fed import Notebook
from tests.tables import every_row
from tests.tracking.tracked_box import FEBRUARY_S, Box

STRANGER, PAIRED, OTHER = Source(PAGE), Source(PAGE, 1), Source(PAGE, 2)
PROGRAM, TERMINAL = Source("rotctld", 1), Source(CONSOLE, 1)
MOUNT = build_mount(parse("", "box"))
PAUSE_S = 11.0
"""After this silence a program has the antenna no more."""


def client(box: Box, source: Source) -> Client:
    return Client(box.loop, MOUNT, source, clock=box.clock)


def ask(box: Box, source: Source, zone: str = "Europe/Prague", times: int = FAST) -> str:
    whose = None if source == TERMINAL else source
    return Operating(client(box, source), box.tracker, whose).do(Demo(zone, times))


def order(box: Box, source: Source, *orders: Order) -> None:
    for each in orders:
        client(box, source).order(each)
        box.wait(0.5)


@every_row(
    ("zone", "over"),
    [
        ("Europe/Prague", "Europe"),
        ("europe/prague", "Europe"),
        ("America/New_York", "North America"),
        ("America/Argentina/Buenos_Aires", "South America"),
        ("America/Sao_Paulo", "South America"),
        ("Africa/Nairobi", "Africa"),
        ("Asia/Tokyo", "Asia"),
        ("Pacific/Auckland", "Australia"),
        ("UTC", "Europe"),
        ("", "Europe"),
    ],
)
def test_a_time_zone_belongs_to_a_continent(zone: str, over: str) -> None:
    assert demo_pass(zone) is PASSES[over]
    assert len(demo_pass(zone).named(FAST)) <= 40, "as long as a list of passes shows it"


@every_row("over", list(PASSES))
def test_each_pass_rises_culminates_where_a_rotor_can_follow_and_sets(over: str) -> None:
    rows = PASSES[over].rows(1)
    elevations_deg = [elevation_deg for _, _, elevation_deg in rows]
    assert (elevations_deg[0], elevations_deg[-1]) == pytest.approx((0.0, 0.0), abs=0.1)
    assert 20.0 < max(elevations_deg) < 32.0
    assert 590.0 < rows[-1][0] < 640.0, "ten minutes, as the ISS takes"
    assert [at_s for at_s, _, _ in PASSES[over].rows(FAST)] == [at_s / FAST for at_s, _, _ in rows]


@every_row(("over", "zone"), [("Europe", "Europe/Prague"), ("Australia", "Australia/Perth")])
def test_a_stranger_flies_it_from_its_rise_to_its_end_and_holds_nothing(over: str, zone: str) -> None:
    box = Box(FEBRUARY_S)
    box.clock_trusted = False
    assert ask(box, STRANGER, zone) == ""
    assert box.wait(120.0, lambda: box.loop.status.flown is not None and box.loop.status.flown.begin_s <= box.clock())
    rises_s, path = box.clock(), KnownPath(PASSES[over].rows(FAST))
    while box.loop.status.flown is not None:
        box.wait(0.5)
        sky_deg = path.direction(box.clock() - rises_s)
        assert great_circle_deg(*box.world.antenna(), *sky_deg) < 9.0
    assert box.clock() - rises_s == pytest.approx(PASSES[over].lasts_s / FAST, abs=2.0)
    box.wait(2.0)
    assert box.tracker.state.endswith("is over")
    assert box.loop.status.held_by == ""
    order(box, PROGRAM, Aim(100.0, 10.0))
    assert box.loop.status.controlled_by == str(PROGRAM)


@every_row("source", [STRANGER, PAIRED, TERMINAL])
def test_it_takes_the_antenna_from_nobody(source: Source) -> None:
    box = Box(FEBRUARY_S)
    order(box, PROGRAM, Aim(12.0, 0.0))
    box.wait(5.0)
    assert not box.loop.status.moving
    assert ask(box, source).startswith("rotctld#1 moves the antenna: the demo pass waits")
    box.wait(PAUSE_S)
    order(box, OTHER, Take())
    assert ask(box, source).startswith("page#2 holds the antenna")
    order(box, TERMINAL, Stop(latch=True))
    assert ask(box, source), "stopped, and held"
    assert box.loop.status.flown is None
    assert box.loop.status.held_by == str(OTHER)


def test_what_is_tracked_goes_on_also_the_demo_pass_itself() -> None:
    box = Box(FEBRUARY_S)
    assert ask(box, PAIRED) == ""
    assert "is tracked already" in ask(box, STRANGER, "Asia/Tokyo")
    box.wait(5.0)
    assert ask(box, STRANGER, "Asia/Tokyo").startswith("ISS over Europe, demo 10× is tracked already")


def test_a_stop_holds_it_back_as_all_else() -> None:
    box = Box(FEBRUARY_S)
    order(box, STRANGER, Stop(latch=True))
    assert "page" in ask(box, STRANGER)
    box.wait(3.0)
    assert box.loop.status.flown is None


def test_a_real_antenna_is_never_demonstrated() -> None:
    box = Box(FEBRUARY_S)
    real = Notebook()
    assert not real.shown.simulated
    assert "this one turns a real antenna" in Operating(real, box.tracker, PAIRED).do(Demo("", FAST))
    assert real.orders == []
    assert box.tracker.state == "off"


def test_a_rotor_that_cannot_reach_the_pass_says_so() -> None:
    box = Box(FEBRUARY_S, follow="[azimuth]\nmax_deg = 90\n")
    assert "azimuth" in ask(box, STRANGER)
    assert box.tracker.state == "off"
