"""Which connections send streams, which orders point the same way, and what a connection that ends leaves behind."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.senders import FIGHT_TAKES, Senders, aims_of
from rotator.control.sky.angles import Coordinates
from rotator.exchange.orders import Aim, Jog, Order, Stop
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


@pytest.mark.parametrize(
    ("order", "aims"),
    [
        (Aim(180.0, 45.0), (180.0, 45.0)),
        (Aim(180.0, None), (180.0, None)),
        (Aim(180.0, 45.0, engaged=False), None),
        (Jog(Axis.AZIMUTH, Direction.PLUS), None),
        (Stop(), None),
    ],
)
def test_where_an_order_points(order: Order, aims: Coordinates | None) -> None:
    assert aims_of(order) == aims


@pytest.mark.parametrize(("orders", "streams"), [(1, False), (3, False), (4, True), (50, True)])
def test_from_the_fourth_order_on_it_is_a_stream(senders: Senders, orders: int, streams: bool) -> None:
    stream(senders, ONE, orders=orders)
    assert senders.streams(ONE) is streams
    assert not senders.streams(OTHER)


@pytest.mark.parametrize(("pause_s", "streams"), [(9.9, True), (10.0, False)])
def test_orders_ten_seconds_apart_do_not_belong_together(senders: Senders, pause_s: float, streams: bool) -> None:
    stream(senders, ONE, orders=3)
    senders.note(ONE, 2.0 + pause_s, HERE)
    assert senders.streams(ONE) is streams


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


def test_single_orders_lose_nothing(senders: Senders) -> None:
    now_s = stream(senders, ONE, orders=3)
    senders.note(OTHER, now_s, THERE)
    senders.take(OTHER, now_s)
    assert senders.silence(ONE) == ""


def test_what_silences_it_and_what_ends_that_is_said(senders: Senders) -> None:
    now_s = stream(senders, ONE)
    senders.note(OTHER, now_s, THERE)
    senders.take(OTHER, now_s)
    assert senders.silence(ONE) == (
        "rotctld#1 moves the antenna now; orders count again after a pause of 10 s, or on a new connection"
    )
    now_s = stream(senders, OTHER, THERE, from_s=now_s + 1.0)
    senders.note(ONE, now_s, HERE)
    assert senders.silence(ONE) == (
        "rotctld#1 moves the antenna, and both send directions: end one of the two programs "
        "(orders count again after a pause of 10 s)"
    )
    senders.stop(THIRD, now_s)
    assert senders.silence(ONE) == (
        "easycomm2#1 has stopped the antenna; orders count again after a pause of 10 s, or on a new connection"
    )


def test_a_single_order_before_a_stop_waits_three_seconds(senders: Senders) -> None:
    senders.note(ONE, 0.0, HERE)
    senders.stop(OTHER, 0.5)
    assert "after a pause of 3 s" in senders.silence(ONE)
    senders.note(ONE, 2.9, HERE)
    assert senders.silence(ONE) != ""
    senders.note(ONE, 5.9, HERE)
    assert senders.silence(ONE) == ""


def test_a_pause_gives_it_the_antenna_back_and_less_than_that_does_not(senders: Senders) -> None:
    now_s = stream(senders, ONE)
    senders.stop(OTHER, now_s)
    senders.note(ONE, now_s + 9.9, HERE)
    assert senders.silence(ONE) != ""
    senders.note(ONE, now_s + 20.0, HERE)
    assert senders.silence(ONE) == ""


def test_a_release_frees_all(senders: Senders) -> None:
    now_s = stream(senders, ONE)
    stream(senders, THIRD)
    senders.stop(OTHER, now_s)
    senders.free_all()
    assert (senders.silence(ONE), senders.silence(THIRD)) == ("", "")


# --- a connection that ends


def reconnects(senders: Senders, link: str, number: int, now_s: float) -> Source:
    """The connection of that number ends, and the next one sends."""
    senders.left(Source(link, number), now_s)
    anew = Source(link, number + 1)
    senders.note(anew, now_s + 0.1, HERE)
    return anew


def test_after_a_stream_of_its_own_a_new_connection_is_heard(senders: Senders) -> None:
    now_s = stream(senders, OTHER)
    senders.stop(ONE, now_s)
    assert senders.silence(reconnects(senders, "rotctld", 1, now_s)) == ""


def test_a_program_that_connects_for_each_order_stays_silenced_on_the_next_one(senders: Senders) -> None:
    for number in range(1, 5):
        senders.note(Source("rotctld", number), float(number), HERE)
        senders.left(Source("rotctld", number), float(number))
    senders.stop(ONE, 4.5)
    senders.note(Source("rotctld", 5), 5.0, HERE)
    assert senders.silence(Source("rotctld", 5)) == (
        "gs232b#1 has stopped the antenna; orders count again after a pause of 10 s"
    ), "and not on a new connection, for each of its orders comes on one"
    assert not senders.streams(Source("rotctld", 5)), "on this connection it has sent one"
    senders.note(Source("easycomm2", 5), 5.0, HERE)
    assert senders.silence(Source("easycomm2", 5)) == "", "another link's program"


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


def test_a_connection_that_never_sent_leaves_nothing(senders: Senders) -> None:
    senders.left(ONE, 1.0)
    assert senders.silence(ONE) == ""
    assert not senders.streams(ONE)


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
