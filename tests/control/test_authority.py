"""Whose orders move the antenna: latches that a person releases, streams that a stop has silenced."""

from __future__ import annotations

import pytest

from rotator.control.authority import Authority
from rotator.control.senders import PAUSE_S, SINGLE_PAUSE_S
from rotator.exchange.sources import Source
from tests.control.order_streams import GPREDICT, GPREDICT_AGAIN, HERE, PST, stream


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
