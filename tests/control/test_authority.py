"""Whose orders move the antenna: latches that a person releases, streams that a stop has silenced."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.control.authority import Authority
from rotator.control.senders import PAUSE_S, SINGLE_PAUSE_S
from rotator.exchange.orders import Mode
from rotator.exchange.sources import Source

CONSOLE = Source("console")
PST, GPREDICT, GPREDICT_AGAIN = Source("gs232b", 1), Source("rotctld", 1), Source("rotctld", 2)
HERE, THERE = (180.0, 45.0), (20.0, 10.0)


def stream(authority: Authority, source: Source, *, from_s: float = 0.0, until_s: float) -> list[bool]:
    """An order for HERE every second; returns which had an effect."""
    return [authority.may_move(source, float(at_s), HERE) for at_s in range(int(from_s), int(until_s) + 1)]


@pytest.fixture
def authority() -> Authority:
    return Authority()


def test_at_first_anybody_may_move(authority: Authority) -> None:
    assert authority.may_move(PST, 0.0)
    assert authority.may_move(GPREDICT, 0.0)
    assert authority.controlled_by == GPREDICT


# --- S on a link


def test_the_link_that_stopped_moves_again_with_its_next_order(authority: Authority) -> None:
    authority.may_move(PST, 0.0)
    authority.stopped(PST, 0.1, latch=False)
    assert authority.controlled_by is None
    assert authority.may_move(PST, 0.2)
    assert authority.controlled_by == PST


def test_a_stream_on_another_link_stays_without_effect_while_it_goes_on(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    assert not any(authority.may_move(GPREDICT, float(second)) for second in range(1, 3600))
    assert authority.controlled_by is None


def test_a_pause_of_ten_seconds_ends_it(authority: Authority) -> None:
    assert PAUSE_S == 10.0
    stream(authority, GPREDICT, until_s=4.0)
    authority.stopped(PST, 4.5, latch=False)
    assert not authority.may_move(GPREDICT, 13.9)
    assert not authority.may_move(GPREDICT, 23.8)
    assert authority.may_move(GPREDICT, 33.9)


def test_a_single_order_counts_again_after_three_seconds(authority: Authority) -> None:
    assert SINGLE_PAUSE_S == 3.0
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    assert not authority.may_move(GPREDICT, 2.9), "no pause yet"
    assert authority.may_move(GPREDICT, 5.9)
    assert authority.may_move(GPREDICT, 6.0)


def test_orders_that_go_on_while_they_are_ignored_become_a_stream(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    for moment_s in (2.0, 4.0, 6.0, 8.0):
        assert not authority.may_move(GPREDICT, moment_s)
    assert not authority.may_move(GPREDICT, 12.0), "four in a row are a stream"
    assert authority.may_move(GPREDICT, 22.0)


def test_a_reconnect_ends_it_at_once(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    assert authority.may_move(GPREDICT_AGAIN, 0.6)
    assert not authority.may_move(GPREDICT, 0.7)


def test_a_link_that_was_not_streaming_is_not_silenced(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 10.0, latch=False)
    assert authority.may_move(GPREDICT, 10.5)
    authority.stopped(PST, 11.0, latch=False)
    assert authority.may_move(Source("easycomm2", 1), 11.1)


def test_the_silenced_one_gets_back_by_stopping_itself(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    authority.stopped(GPREDICT, 1.0, latch=False)
    assert authority.may_move(GPREDICT, 1.1)


def test_stopping_twice_silences_as_long_as_once(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    authority.stopped(PST, 0.6, latch=False)
    assert not authority.may_move(GPREDICT, 1.0)
    assert authority.may_move(GPREDICT, 11.0)


# --- STOP from the console, the panel, the page


def test_a_latch_holds_everybody_until_a_person_releases_it(authority: Authority) -> None:
    authority.may_move(PST, 0.0)
    authority.stopped(CONSOLE, 0.5, latch=True)
    assert authority.latched == "console"
    for moment_s in (1.0, 60.0, 86_400.0):
        assert not any(authority.may_move(source, moment_s) for source in (PST, GPREDICT, GPREDICT_AGAIN, CONSOLE))
    authority.released()
    assert authority.latched == ""
    assert authority.may_move(PST, 86_401.0)


def test_s_on_a_link_does_not_open_a_latch(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    authority.stopped(PST, 1.0, latch=False)
    assert authority.latched == "console"
    assert not authority.may_move(PST, 2.0)


def test_a_release_leaves_no_sender_silenced(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    authority.released()
    assert authority.may_move(GPREDICT, 1.0)


def test_links_that_came_and_went_are_forgotten() -> None:
    # memory stays bounded with any number of connections
    authority = Authority()
    for number in range(300):
        authority.may_move(Source("rotctld", number), float(number))
        authority.stopped(PST, float(number), latch=False)
    heard = [number for number in range(300) if not authority.may_move(Source("rotctld", number), 299.5)]
    assert heard == list(range(297, 300)), "each was silent for three seconds, or is forgotten"
    assert sum(authority.may_move(Source("rotctld", number), 400.0) for number in range(300)) == 300


# --- a connection ends


def test_a_program_that_connects_for_each_order_is_one_stream(authority: Authority) -> None:
    """`rotctl -m 2 P 180 45` in a loop: each order has a connection of its own, and a stop still holds it."""
    moved = []
    for second in range(40):
        if second == 10:
            authority.stopped(PST, 10.0, latch=False)
        source = Source("rotctld", second)
        moved.append(authority.may_move(source, second + 0.5, HERE))
        authority.left(source, second + 0.6)
    assert moved == [True] * 10 + [False] * 30
    (ignored,) = authority.ignored(40.0)
    assert ignored.startswith("orders from rotctld are ignored: gs232b#1 has stopped the antenna; ")


def test_a_program_started_after_a_stop_is_heard(authority: Authority) -> None:
    stream(authority, GPREDICT, until_s=20)
    authority.stopped(PST, 20.1, latch=False)
    authority.left(GPREDICT, 20.2)
    assert authority.may_move(GPREDICT_AGAIN, 20.3, HERE)


def test_a_single_order_of_an_earlier_connection_silences_no_new_one(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0, HERE)
    authority.left(GPREDICT, 0.1)
    authority.stopped(PST, 0.2, latch=False)
    assert authority.may_move(GPREDICT_AGAIN, 0.3, HERE)


def test_it_says_whether_a_stream_ended_with_its_connection(authority: Authority) -> None:
    stream(authority, GPREDICT, until_s=2)
    assert not authority.left(GPREDICT, 2.5), "three orders are no stream"
    stream(authority, PST, until_s=8)
    stream(authority, GPREDICT_AGAIN, from_s=8, until_s=12)
    assert not authority.left(PST, 12.5), "another source moves the antenna"
    assert authority.left(GPREDICT_AGAIN, 12.6)
    assert not authority.left(GPREDICT_AGAIN, 12.7)


# --- two that disagree


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


def test_polling_is_no_order(authority: Authority) -> None:
    """A link that only asks is not heard of here at all; nothing is said, and nothing changes hands."""
    stream(authority, GPREDICT, until_s=100)
    assert authority.ignored(100.0) == ()


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


# --- who may move in which position of the panel's switch, and after a storm park


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


@pytest.mark.parametrize(
    ("mode", "panel_may", "link_may"),
    [(Mode.AUTO, True, True), (Mode.MANUAL, True, False), (Mode.JOG, True, False), (Mode.PARK, False, False)],
)
def test_at_manual_and_jog_the_panel_alone_moves_the_antenna(mode: Mode, panel_may: bool, link_may: bool) -> None:
    authority = Authority()
    authority.switch(PANEL, mode)
    assert authority.may_move(PANEL, 0.0) is panel_may
    for other in (PST, CONSOLE):
        assert authority.may_move(other, 0.0) is link_may


def test_a_stop_ends_a_storm_park_and_what_it_latched_stays(authority: Authority) -> None:
    authority.begin_storm(CONSOLE)
    assert (authority.latched, authority.storm) == ("console", True)
    authority.stopped(PST, 1.0, latch=False)
    assert (authority.latched, authority.storm) == ("gs232b#1, in a storm park", False)
    authority.stopped_axis(GPREDICT, 1.0)
    assert authority.latched == "gs232b#1, in a storm park", "there is no storm park any more"
    assert not authority.may_move(PST, 2.0)


def test_after_a_release_no_ignored_source_is_named(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    authority.may_move(PST, 1.0)
    assert authority.ignored(1.0) == (
        "orders from gs232b#1 are ignored: stopped by console: nothing moves until resume",
    )
    authority.released()
    assert authority.ignored(1.0) == ()


def test_ignored_sources_are_named_for_a_while_the_latest_first(authority: Authority) -> None:
    authority.stopped(CONSOLE, 0.0, latch=True)
    authority.may_move(PST, 1.0)
    authority.may_move(GPREDICT, 2.0)
    assert [line.split()[2] for line in authority.ignored(1.0 + PAUSE_S - 0.1)] == ["rotctld#1", "gs232b#1"]
    assert [line.split()[2] for line in authority.ignored(1.0 + PAUSE_S)] == ["rotctld#1"]
    assert authority.ignored(2.0 + PAUSE_S) == ()
