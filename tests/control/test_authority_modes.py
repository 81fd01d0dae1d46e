"""Who moves the antenna in each position of a front panel's mode switch, and what turning it does."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.authority import Authority
from rotator.exchange.orders import Aim, Jog, Mode, Park, Release, SetMode, Stop
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
PANEL, LINK, OTHER_PANEL = Source("panel"), Source("gs232b", 1), Source("panel", 2)
RESTING = {AZ: OFF, EL: OFF}
MOVES = {Mode.AUTO: (True, True), Mode.MANUAL: (True, False), Mode.JOG: (True, False), Mode.PARK: (False, False)}
"""Whether orders of the panel, and of a link, move something."""
EACH_MODE = pytest.mark.parametrize("mode", list(Mode), ids=lambda mode: mode.value)


# --- authority


@EACH_MODE
def test_who_may_move(mode: Mode) -> None:
    authority = Authority()
    authority.switch(PANEL, mode)
    assert (authority.may_move(PANEL, 1.0), authority.may_move(LINK, 1.0)) == MOVES[mode]


@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG])
def test_only_the_panel_whose_switch_was_turned_may_move_it(mode: Mode) -> None:
    authority = Authority()
    authority.switch(PANEL, mode)
    assert not authority.may_move(OTHER_PANEL, 1.0)


def test_at_first_the_links_do() -> None:
    assert Authority().mode is Mode.AUTO


@EACH_MODE
def test_a_latch_is_stronger_than_any_mode(mode: Mode) -> None:
    authority = Authority()
    authority.stopped(Source("console"), 0.0, latch=True)
    authority.switch(PANEL, mode)
    assert not authority.may_move(PANEL, 1.0)
    assert not authority.may_move(LINK, 1.0)
    authority.released()
    assert authority.may_move(PANEL, 2.0) is MOVES[mode][0]


def test_turning_the_switch_takes_the_antenna_from_whoever_had_it() -> None:
    authority = Authority()
    assert authority.may_move(LINK, 0.0)
    authority.switch(PANEL, Mode.MANUAL)
    assert authority.controlled_by is None
    assert authority.may_move(PANEL, 1.0)
    assert authority.controlled_by == PANEL


def test_a_stream_that_went_on_meanwhile_moves_again_on_auto() -> None:
    authority = Authority()
    authority.switch(PANEL, Mode.PARK)
    assert not any(authority.may_move(LINK, float(second)) for second in range(20))
    authority.switch(PANEL, Mode.AUTO)
    assert authority.may_move(LINK, 20.5)


def held(authority: Authority, from_s: float, to_s: float) -> list[bool]:
    """The orders of a jog switch that is held: whether each has an effect."""
    return [authority.may_move(PANEL, tick / 20) for tick in range(round(20 * from_s), round(20 * to_s))]


@pytest.mark.parametrize("source", [LINK, Source("console")])
def test_a_stop_ends_the_jog_of_a_held_switch_until_it_was_let_go(source: Source) -> None:
    authority = Authority()
    authority.switch(PANEL, Mode.JOG)
    assert all(held(authority, 0.0, 2.0))
    authority.stopped(source, 2.0, latch=False)
    assert not any(held(authority, 2.0, 60.0))
    assert all(held(authority, 61.0, 62.0))


def test_a_switch_that_is_let_go_and_pressed_at_once_jogs_again() -> None:
    authority = Authority()
    authority.switch(PANEL, Mode.JOG)
    assert all(held(authority, 0.0, 2.0))
    authority.stopped(PANEL, 2.0, latch=False)
    assert all(held(authority, 2.1, 3.0))


# --- the whole controller


@EACH_MODE
@pytest.mark.parametrize("order", [Aim(235.0, 60.0), Jog(AZ, PLUS), Park()], ids=lambda order: type(order).__name__)
def test_orders_move_the_antenna_as_the_switch_says(desk: Any, mode: Mode, order: Aim | Jog | Park) -> None:
    desk.step(SetMode(mode), by=PANEL)
    for source, moves in zip((PANEL, LINK), MOVES[mode], strict=True):
        driven = desk.step(order, by=source)
        assert (driven != RESTING) is moves
        desk.step(Stop(), by=PANEL)
        desk.run(1.0)
    assert desk.status.mode is mode


@EACH_MODE
def test_turning_the_switch_stops_the_antenna(desk: Any, mode: Mode) -> None:
    desk.step(Aim(235.0, 60.0), by=LINK)
    desk.run(1.0)
    assert desk.step(SetMode(mode), by=PANEL) == RESTING
    assert desk.run(5.0) == set(), "no order has come since"
    assert desk.status.wanted_azimuth_deg is None


@EACH_MODE
def test_anybody_may_stop_in_any_mode(desk: Any, mode: Mode) -> None:
    desk.step(SetMode(mode), by=PANEL)
    mover = PANEL if MOVES[mode][0] else LINK
    desk.step(Jog(AZ, PLUS), by=mover)
    desk.run(0.5)
    assert desk.step(Stop(), by=Source("rotctld", 7)) == RESTING


def test_in_park_it_stays_where_it_is_and_is_not_sent_home(desk: Any) -> None:
    desk.step(SetMode(Mode.PARK), by=PANEL)
    assert desk.run(60.0) == set()
    assert desk.angle_deg[AZ] == pytest.approx(100.0, abs=0.01)


def test_released_in_park_it_still_obeys_no_sender(desk: Any) -> None:
    desk.step(SetMode(Mode.PARK), by=PANEL)
    desk.step(Release(), by=PANEL)
    assert desk.step(Aim(235.0, 60.0), by=PANEL) == RESTING
    assert desk.step(Aim(235.0, 60.0), by=LINK) == RESTING
