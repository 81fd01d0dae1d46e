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


@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG])
def test_only_the_panel_whose_switch_was_turned_may_move_it(mode: Mode) -> None:
    authority = Authority()
    authority.switch(PANEL, mode)
    assert not authority.may_move(OTHER_PANEL, 1.0)


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


def test_released_in_park_it_still_obeys_no_sender(desk: Any) -> None:
    desk.step(SetMode(Mode.PARK), by=PANEL)
    desk.step(Release(), by=PANEL)
    assert desk.step(Aim(235.0, 60.0), by=PANEL) == RESTING
    assert desk.step(Aim(235.0, 60.0), by=LINK) == RESTING
