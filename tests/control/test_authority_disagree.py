"""Whose orders move the antenna when two senders disagree, and what is said of those that are ignored."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.authority import Authority
from rotator.control.senders import PAUSE_S
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source
from tests.control.order_streams import CONSOLE, GPREDICT, GPREDICT_AGAIN, HERE, PST, THERE, stream


@pytest.fixture
def authority() -> Authority:
    return Authority()


def test_a_single_order_wins_over_a_stream(authority: Authority) -> None:
    """A person in a terminal, while a program tracks."""
    assert all(stream(authority, GPREDICT, until_s=10))
    assert authority.may_move(PST, 10.5, THERE)
    assert not any(stream(authority, GPREDICT, from_s=11, until_s=200))
    assert authority.controlled_by == PST
    assert authority.ignored(200.0) == (
        "orders from rotctld#1 are ignored: gs232b#1 moves the antenna now; "
        "orders count again after a pause of 10 s, or on a new connection",
    )
    assert authority.may_move(PST, 200.5, HERE)
    assert authority.may_move(GPREDICT_AGAIN, 201.0, THERE), "connected anew, its user wants it back"


@pytest.mark.parametrize("order", [(182.0, 46.0), (180.0, None), (None, 44.0)])
def test_two_that_agree_do_not_fight(authority: Authority, order: tuple[float | None, float | None]) -> None:
    """Two programs that follow one satellite, and programs for one axis each."""
    for second in range(120):
        assert authority.may_move(GPREDICT, float(second), HERE)
        assert authority.may_move(PST, second + 0.5, order)
    assert authority.ignored(120.0) == ()


def test_north_from_both_sides_is_one_direction(authority: Authority) -> None:
    for second in range(20):
        assert authority.may_move(GPREDICT, float(second), (359.0, 10.0))
        assert authority.may_move(PST, second + 0.5, (361.0, 10.0))


def test_two_streams_that_disagree_change_hands_a_few_times_at_most(authority: Authority) -> None:
    moved = []
    for second in range(120):
        moved.append(authority.may_move(GPREDICT, float(second), HERE))
        moved.append(authority.may_move(PST, second + 0.5, THERE))
    hands = moved[::2]
    assert sum(one is not other for one, other in itertools.pairwise(hands)) <= 1
    assert moved[20:] in ([True, False] * 110, [False, True] * 110)
    (ignored,) = authority.ignored(120.0)
    assert ignored.endswith(": end one of the two programs (orders count again after a pause of 10 s)")
    assert {"gs232b#1", "rotctld#1"} <= set(ignored.replace(":", "").replace(",", "").split())


@given(
    periods_s=st.tuples(st.floats(0.1, 9.0), st.floats(0.1, 9.0)),
    per_connection=st.tuples(st.integers(1, 8) | st.none(), st.integers(1, 8) | st.none()),
    shift_s=st.floats(0.0, 5.0),
)
def test_a_fight_ends_with_any_orders_of_the_programs(
    periods_s: tuple[float, float], per_connection: tuple[int | None, int | None], shift_s: float
) -> None:
    """Two programs at any rate; each may connect anew after so many orders (None: never)."""
    authority = Authority()
    orders = sorted(
        (shift_s * which + count * period_s, which, count)
        for which, period_s in enumerate(periods_s)
        for count in range(int(120.0 / period_s))
    )
    links, aims = ("rotctld", "gs232b"), (HERE, THERE)
    took = []
    for at_s, which, count in orders:
        most = per_connection[which]
        source = Source(links[which], 1 + (count // most if most else 0))
        if authority.may_move(source, at_s, aims[which]):
            took.append(which)
        if most and count % most == most - 1:
            authority.left(source, at_s)
    reversals = sum(one != other for one, other in itertools.pairwise(took))
    assert reversals <= 20, "118 were seen"


# --- what is said


def test_each_reason_is_said_and_forgotten_ten_seconds_later(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    authority.may_move(PST, 1.0)
    assert authority.ignored(1.0) == (
        "orders from gs232b#1 are ignored: stopped by console: nothing moves until resume",
    )
    assert authority.ignored(11.0) == ()
    authority.released()
    authority.switch(Source("panel"), Mode.PARK)
    authority.may_move(PST, 12.0)
    assert authority.ignored(12.0) == ("orders from gs232b#1 are ignored: the panel's switch is at PARK",)
    authority.switch(Source("panel"), Mode.AUTO)
    authority.may_move(PST, 13.0, homing=True)
    assert authority.ignored(13.0) == ("orders from gs232b#1 are ignored: an axis is homing",)
    authority.may_move(PST, 14.0)
    assert authority.ignored(14.0) == ()


def test_many_connections_are_not_all_named(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    for number in range(100):
        authority.may_move(Source("rotctld", number), 1.0)
    assert len(authority.ignored(1.0)) == 4


def test_a_program_that_connects_anew_is_named_once_with_its_latest_connection(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    for number in range(1, 4):
        source = Source("rotctld", number)
        authority.may_move(source, float(number))
        if number < 3:
            authority.left(source, number + 0.5)
    assert [line.split()[2] for line in authority.ignored(4.0)] == ["rotctld#3"]


@pytest.mark.parametrize(("stops_on", "goes_on"), [("rotctld", True), ("gs232b", False)])
def test_a_script_that_connects_for_every_order_may_stop_and_go_on(stops_on: str, *, goes_on: bool) -> None:
    """A stop on another link holds it; its own must not, for it could never move the antenna again."""
    authority = Authority()
    for number in range(1, 8):
        script = Source("rotctld", number)
        assert authority.may_move(script, float(number), (90.0 + number, 30.0))
        authority.left(script, float(number))
    stopping = Source(stops_on, 100)
    authority.stopped(stopping, 8.0, latch=False)
    authority.left(stopping, 8.0)
    assert authority.may_move(Source("rotctld", 101), 9.0, (20.0, 30.0)) is goes_on


def test_ignored_sources_are_named_for_a_while_the_latest_first(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    authority.may_move(PST, 1.0)
    authority.may_move(GPREDICT, 2.0)
    assert [line.split()[2] for line in authority.ignored(1.0 + PAUSE_S - 0.1)] == ["rotctld#1", "gs232b#1"]
    assert [line.split()[2] for line in authority.ignored(1.0 + PAUSE_S)] == ["rotctld#1"]
    assert authority.ignored(2.0 + PAUSE_S) == ()
