"""The box as a client of another rotctld: which answers are orders, which are none, and which are no answers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Order, Park, Stop
from rotator.exchange.sources import Source
from rotator.protocols.rotctld_follow import RotctldFollower
from rotator.protocols.session import NotUnderstood

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox


def place(azimuth_deg: float, elevation_deg: float) -> Aim:
    """Every order is for a place, and no point of a path."""
    return Aim(azimuth_deg, elevation_deg, place=True)


@pytest.fixture
def follower(box: BenchBox) -> RotctldFollower:
    """It is asked once a second."""
    return RotctldFollower(box, 1.0)


def answer(follower: RotctldFollower, *answers: bytes) -> None:
    for each in answers:
        assert follower.ask() == b"p\n"
        assert follower.receive(each)


def test_the_first_answer_is_where_it_stands_and_no_order(box: BenchBox, follower: RotctldFollower) -> None:
    """A dummy rotor at 0/0 without a client, or one that has just been started, turns no antenna."""
    answer(follower, b"0.00\n0.00\n", b"0.00\n0.00\n", b"0.00\n0.00\n")
    box.wait(1)
    assert box.orders == []
    assert box.turned == set()


def test_from_then_on_every_change_is_an_order(box: BenchBox, follower: RotctldFollower) -> None:
    answer(follower, b"0.00\n0.00\n", b"2.11\n0.00\n", b"2.110000\n0.000000\n", b"4.21\n1.00\n", b"2.11\n0.00\n")
    assert box.orders == [place(2.11, 0), place(4.21, 1), place(2.11, 0)]


@pytest.mark.parametrize("by_another", [Stop(), Aim(80, 40), Park()])
def test_what_another_link_orders_is_not_undone(box: BenchBox, by_another: Order) -> None:
    follower = RotctldFollower(box, 0.1)
    answer(follower, b"0.00\n0.00\n", *[b"30.00\n20.00\n"] * 3)
    box.order(by_another, Source("another"))
    answer(follower, *[b"30.00\n20.00\n"] * 200)
    assert box.orders == [place(30, 20), by_another]


@pytest.mark.parametrize(
    ("said", "orders"),
    [
        (b"235.00\n25.00\n", [place(235, 25)]),
        (b"235.000000\r\n25.000000\r\n", [place(235, 25)]),
        (b"235,50\n25,25\n", [place(235.5, 25.25)]),
        (b"-90.00\n25.00\n", [place(270, 25)]),
        (b"400.00\n25.00\n", [place(400, 25)]),
        (b"10.00\n170.00\n", [place(10, 170)]),
        (b"RPRT 0\n235.00\n25.00\n", [place(235, 25)]),
        (b"235.00\n25.00\nRPRT 0\n", [place(235, 25)]),
    ],
)
def test_positions(box: BenchBox, follower: RotctldFollower, said: bytes, orders: list[Order]) -> None:
    answer(follower, b"1.00\n1.00\n", said)
    assert box.orders == orders
    assert follower.trouble == ""


def test_an_answer_in_pieces(box: BenchBox, follower: RotctldFollower) -> None:
    answer(follower, b"1.00\n1.00\n")
    follower.ask()
    pieces = [b"23", b"5.0", b"0\n2", b"5.00", b"\n"]
    assert [follower.receive(piece) for piece in pieces] == [False, False, False, False, True]
    assert box.orders == [place(235, 25)]


@pytest.mark.parametrize("said", [b"RPRT -5\n", b"RPRT -6\n", b"1000.00\n25.00\n", b"10.00\n220.00\n"])
def test_an_answer_without_a_direction_moves_nothing_and_is_told(
    box: BenchBox, follower: RotctldFollower, said: bytes
) -> None:
    answer(follower, b"1.00\n1.00\n", said)
    assert follower.trouble.startswith("answers ")
    assert box.orders == []
    answer(follower, b"2.00\n1.00\n")
    assert follower.trouble == ""
    assert box.orders == [place(2, 1)]


@pytest.mark.parametrize(
    "said",
    [
        b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n",
        b"SSH-2.0-OpenSSH_9.2p1 Debian-2\r\n",
        b"nan\nnan\n",
        b"inf\n0\n",
        b"235.00\nfoo\n",
        b"235.00\nRPRT 0\n",
        b"\xff\xfe\n",
        b"1" * 200 + b"\n",
        b"get_pos:\n",
    ],
)
def test_what_is_no_rotctld_is_not_listened_to(box: BenchBox, follower: RotctldFollower, said: bytes) -> None:
    answer(follower, b"1.00\n1.00\n")
    follower.ask()
    with pytest.raises(NotUnderstood, match=r"^it says "):
        follower.receive(said)
    assert box.orders == []


def test_half_an_answer_is_forgotten_with_the_next_question(box: BenchBox, follower: RotctldFollower) -> None:
    answer(follower, b"1.00\n1.00\n")
    follower.ask()
    assert not follower.receive(b"235.00\n25")
    answer(follower, b"2.00\n3.00\n")
    assert box.orders == [place(2, 3)]


@given(
    pieces=st.lists(st.one_of(st.binary(max_size=12), st.sampled_from([b"\n", b"RPRT -1\n", b"12.5\n"])), max_size=30)
)
def test_any_bytes(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    """An answer is understood or refused; both numbers of an order come from one answer."""
    box = new_box()
    follower = RotctldFollower(box, 1.0)
    follower.ask()
    try:
        for piece in pieces:
            if follower.receive(piece):
                follower.ask()
    except NotUnderstood:
        pass
    numbers = sum(word.strip()[:1].isdigit() or word.strip()[:1] in b"+-.," for word in b"".join(pieces).split())
    assert len(box.orders) * 2 <= numbers
