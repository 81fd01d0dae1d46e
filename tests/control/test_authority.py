"""Whose orders move the antenna: latches that a person releases, streams that a stop has silenced."""

from __future__ import annotations

import pytest

from rotator.control.authority import PAUSE_S, Authority
from rotator.orders import Source

CONSOLE = Source("console")
PST, GPREDICT, GPREDICT_AGAIN = Source("gs232b", 1), Source("rotctld", 1), Source("rotctld", 2)


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
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    assert not authority.may_move(GPREDICT, 9.9)
    assert not authority.may_move(GPREDICT, 19.8)
    assert authority.may_move(GPREDICT, 29.8)


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


def test_a_release_leaves_nobody_silenced(authority: Authority) -> None:
    authority.may_move(GPREDICT, 0.0)
    authority.stopped(PST, 0.5, latch=False)
    authority.released()
    assert authority.may_move(GPREDICT, 1.0)


def test_links_that_came_and_went_are_forgotten() -> None:
    # memory stays bounded whatever connects
    authority = Authority()
    for number in range(300):
        authority.may_move(Source("rotctld", number), float(number))
        authority.stopped(PST, float(number), latch=False)
    heard = [number for number in range(300) if not authority.may_move(Source("rotctld", number), 299.5)]
    assert heard == list(range(290, 300))
