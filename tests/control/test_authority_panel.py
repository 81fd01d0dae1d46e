"""Whose orders move the antenna in each position of the panel's switch, and after a storm park."""

from __future__ import annotations

import pytest

from rotator.control.authority import Authority
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source

CONSOLE = Source("console")
PST, GPREDICT, GPREDICT_AGAIN = Source("gs232b", 1), Source("rotctld", 1), Source("rotctld", 2)


@pytest.fixture
def authority() -> Authority:
    return Authority()


PANEL = Source("panel")


@pytest.mark.parametrize("let_go_s", [0.4, 0.6])
def test_a_jog_switch_held_through_a_stop_counts_again_when_it_was_let_go(let_go_s: float) -> None:
    """A held switch sends an order in each cycle."""
    authority = Authority()
    authority.switch(PANEL, Mode.JOG)
    now_s = 10.0
    authority.stopped(CONSOLE, now_s, latch=False)
    for _ in range(40):
        now_s += 0.05
        assert not authority.may_move(PANEL, now_s)
    assert authority.ignored(now_s) == (
        "orders from panel are ignored: a stop came while the jog switch was held: release the switch first",
    )
    assert authority.may_move(PANEL, now_s + let_go_s) is (let_go_s > 0.5)


@pytest.mark.parametrize(("rests_s", "counts"), [(0.8, False), (1.1, True)])
def test_a_knob_that_was_turned_before_a_stop_moves_nothing_after_it(rests_s: float, counts: bool) -> None:
    """Its order comes when it has stood for a second, on a busy computer later still."""
    authority = Authority()
    authority.switch(PANEL, Mode.MANUAL)
    authority.stopped(Source("gs232b", 1), 10.0, latch=False)
    assert authority.may_move(PANEL, 10.0 + rests_s) is counts
    if not counts:
        (why,) = authority.ignored(10.0 + rests_s)
        assert why == "orders from panel are ignored: a stop came while the knob was turned: turn it again"


def test_the_panel_s_own_stop_does_not_silence_its_switch() -> None:
    authority = Authority()
    authority.switch(PANEL, Mode.JOG)
    authority.stopped_axis(PANEL, 10.0)
    assert authority.may_move(PANEL, 10.05)


def test_a_turn_of_the_panel_s_switch_ends_a_storm_park_and_no_sender_moves_the_antenna_then() -> None:
    authority = Authority()
    authority.may_move(PST, 0.0)
    authority.begin_storm(CONSOLE)
    assert authority.controlled_by == CONSOLE
    authority.switch(PANEL, Mode.AUTO)
    assert (authority.latched, authority.storm) == ("panel, in a storm park", False)
    assert authority.controlled_by is None


def test_a_stop_ends_a_storm_park_and_what_it_latched_stays(authority: Authority) -> None:
    authority.begin_storm(CONSOLE)
    assert (authority.latched, authority.storm) == ("console", True)
    authority.stopped(PST, 1.0, latch=False)
    assert (authority.latched, authority.storm) == ("gs232b#1, in a storm park", False)
    authority.stopped_axis(GPREDICT, 1.0)
    assert authority.latched == "gs232b#1, in a storm park", "there is no storm park any more"
    assert not authority.may_move(PST, 2.0)
