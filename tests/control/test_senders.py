"""Which connections send streams, which orders point the same way, and what a connection that ends leaves behind."""

from __future__ import annotations

import pytest

from rotator.control.senders import FIGHT_TAKES, Senders
from rotator.control.sky.angles import Coordinates
from rotator.exchange.sources import Source

ONE, OTHER, THIRD = Source("gs232b", 1), Source("rotctld", 1), Source("easycomm2", 1)
HERE, THERE = (180.0, 45.0), (20.0, 10.0)


@pytest.fixture
def senders() -> Senders:
    return Senders(agree_deg=4.0)


def stream(
    senders: Senders, source: Source, aims: Coordinates | None = HERE, *, from_s: float = 0.0, orders: int = 4
) -> float:
    """One order a second. Returns the moment of the last."""
    for count in range(orders):
        senders.note(source, from_s + count, aims)
    return from_s + orders - 1


# --- taking the antenna


@pytest.mark.parametrize(
    ("aims", "agrees"),
    [
        (HERE, True),
        ((183.9, 45.0), True),
        ((187.0, 45.0), False),
        ((185.5, 45.0), True),  # 3.9° on the sky at that elevation
        ((180.0, 48.9), True),
        ((180.0, 49.1), False),
        ((540.0, 45.0), True),
        ((176.5, None), True),
        ((175.5, None), False),
        ((None, 48.5), True),
        ((None, 49.5), False),
        (None, False),
    ],
)
def test_a_stream_loses_the_antenna_to_an_order_for_another_direction(
    senders: Senders, aims: Coordinates | None, agrees: bool
) -> None:
    now_s = stream(senders, ONE)
    senders.note(OTHER, now_s + 0.5, aims)
    senders.take(OTHER, now_s + 0.5)
    assert (senders.silence(ONE) == "") is agrees
    assert senders.silence(OTHER) == ""


def test_orders_for_one_axis_each_agree(senders: Senders) -> None:
    now_s = stream(senders, ONE, (180.0, None))
    senders.note(OTHER, now_s, (None, 10.0))
    senders.take(OTHER, now_s)
    assert senders.silence(ONE) == ""


# --- a connection that ends


def reconnects(senders: Senders, link: str, number: int, now_s: float) -> Source:
    """The connection of that number ends, and the next one sends."""
    senders.left(Source(link, number), now_s)
    anew = Source(link, number + 1)
    senders.note(anew, now_s + 0.1, HERE)
    return anew


def test_in_a_fight_a_new_connection_does_not_take_the_antenna_back(senders: Senders) -> None:
    """Both programs connect anew as soon as they are silenced."""
    heard, now_s = [], 0.0
    for number in range(1, 2 * FIGHT_TAKES):
        mine, yours = Source("gs232b", number), Source("rotctld", number)
        now_s = stream(senders, mine, HERE, from_s=now_s + 0.2)
        senders.note(yours, now_s, THERE)
        senders.take(yours, now_s)
        anew = reconnects(senders, "gs232b", number, now_s)
        heard.append(senders.silence(anew) == "")
        senders.left(yours, now_s + 0.1)
    assert heard[0]
    assert not heard[FIGHT_TAKES - 1]


@pytest.mark.parametrize(("gone_s", "silenced"), [(5.0, True), (11.0, False)])
def test_ten_seconds_after_it_left_nothing_is_remembered_of_it(senders: Senders, gone_s: float, silenced: bool) -> None:
    for number in range(1, 5):
        senders.note(Source("rotctld", number), float(number), HERE)
        senders.left(Source("rotctld", number), float(number))
    senders.stop(ONE, 4.0)
    senders.note(Source("rotctld", 9), 4.0 + gone_s, HERE)
    assert (senders.silence(Source("rotctld", 9)) != "") is silenced


@pytest.mark.parametrize("given_back", [False, True])
def test_given_back_a_program_that_connects_for_each_order_is_heard_again(senders: Senders, given_back: bool) -> None:
    for number in range(1, 5):
        senders.note(Source("rotctld", number), float(number), HERE)
        senders.left(Source("rotctld", number), float(number))
    senders.note(ONE, 4.5, THERE)
    senders.take(ONE, 4.5)
    if given_back:
        senders.free_taken()
    senders.note(Source("rotctld", 5), 5.0, HERE)
    assert (senders.silence(Source("rotctld", 5)) == "") is given_back
