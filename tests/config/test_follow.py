"""The one link that connects instead of listening: what it needs, and that it cannot lead to the box itself."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from tests.config.texts import FIRST, faults, link


def test_it_has_a_place_and_a_pace() -> None:
    (follow,) = parse(link("rotctld-follow", connect="shack.local:4533"), "x").link
    assert (follow.where, follow.poll_s) == ("shack.local:4533", 0.1)
    (follow,) = parse(link("rotctld-follow", connect="[::1]:4533") + "poll_s = 0.02\n", "x").link
    assert follow.poll_s == 0.02


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (link("rotctld-follow"), "the first [[link]]: rotctld-follow must have connect, and none of pty, serial, tcp"),
        (
            link("rotctld-follow", tcp="127.0.0.1:4533"),
            "the first [[link]]: rotctld-follow must have connect, and none of pty, serial, tcp",
        ),
        (
            link("rotctld-follow", connect="127.0.0.1:4534", pty="x"),
            "the first [[link]]: rotctld-follow must have connect, and none of pty, serial, tcp",
        ),
        (
            link("rotctld", connect="127.0.0.1:4533"),
            "the first [[link]]: connect is for rotctld-follow only; rotctld must have exactly one of pty, serial, tcp",
        ),
        (
            link("rotctld-follow", connect="4533"),
            FIRST + 'connect: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
        ),
        (
            link("rotctld-follow", connect="a:1") + "poll_s = 0\n",
            "the first [[link]]: poll_s = 0: must be greater than or equal to 0.02",
        ),
        (
            link("rotctld-follow", connect="a:1") * 2,
            "2 links use a:1: the first [[link]] and the second [[link]]: give one of them another place",
        ),
    ],
)
def test_one_fault(text: str, said: str) -> None:
    assert faults(text) == [said]


def test_a_misspelt_protocol_is_one_fault() -> None:
    (fault,) = faults(link("rotctl-follow", connect="127.0.0.1:4534"))
    assert fault.endswith("; did you mean rotctld-follow?")


@pytest.mark.parametrize(
    ("tcp", "connect"),
    [
        ("127.0.0.1:4533", "127.0.0.1:4533"),
        ("127.0.0.1:4533", "localhost:4533"),
        ("localhost:4533", "127.0.0.1:4533"),
        ("0.0.0.0:4533", "localhost:4533"),
        ("0.0.0.0:4533", "127.0.0.1:4533"),
        ("[::]:4533", "[::1]:4533"),
        ("0.0.0.0:4533", "0.0.0.0:4533"),
        ("192.168.1.5:4533", "192.168.1.5:4533"),
    ],
)
def test_it_does_not_follow_itself(tcp: str, connect: str) -> None:
    (fault,) = faults(link("rotctld", tcp=tcp) + link("rotctld-follow", connect=connect))
    assert fault == (
        f'the second [[link]]: connect = "{connect}" is the box itself (tcp of the first [[link]] = "{tcp}"): '
        "give one of the two another port"
    )


@pytest.mark.parametrize(
    ("tcp", "connect"),
    [
        ("127.0.0.1:4533", "127.0.0.1:4534"),
        ("0.0.0.0:4533", "192.168.1.7:4533"),
        ("192.168.1.5:4533", "127.0.0.1:4533"),  # another program may have the other address
    ],
)
def test_another_place_is_good(tcp: str, connect: str) -> None:
    assert faults(link("rotctld", tcp=tcp) + link("rotctld-follow", connect=connect)) == []
