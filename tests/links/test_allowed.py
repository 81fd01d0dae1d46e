"""Who may connect: networks and addresses of both families, and a listening socket that turns the others away."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from rotator.links.listening import Allowed
from rotator.links.tcp import TcpLink
from rotator.links.wire import Wire
from tests.tables import every_row

PATIENCE_S = 30.0


@every_row(
    ("networks", "host", "may"),
    [
        (None, "203.0.113.9", True),
        ([], "127.0.0.1", False),
        (["192.168.1.0/24"], "192.168.1.77", True),
        (["192.168.1.0/24"], "192.168.2.77", False),
        (["192.168.1.5/24"], "192.168.1.77", True),
        (["192.168.1.5"], "192.168.1.5", True),
        (["192.168.1.5"], "192.168.1.6", False),
        (["192.168.1.0/24"], "::ffff:192.168.1.77", True),
        (["fd00::/8"], "fd12:3456::1", True),
        (["fd00::/8"], "fe80::1", False),
        (["fe80::/10"], "fe80::1%eth0", True),
        (["fd00::/8"], "192.168.1.5", False),
        (["192.168.1.0/24", "::1"], "::1", True),
        (["192.168.1.0/24"], "", False),
    ],
)
def test_who_may(networks: list[str] | None, host: str, may: bool) -> None:
    assert Allowed(networks)(host) is may


async def answer(port: int, from_host: str) -> bytes:
    reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(from_host, 0))
    try:
        writer.write(b"C2\r")
        return await asyncio.wait_for(reader.read(64), PATIENCE_S)
    except ConnectionError:
        return b""
    finally:
        writer.transport.abort()


async def test_a_stranger_is_turned_away_and_told_of_once(
    wire: Wire, port: int, bench: Any, running: Callable[[TcpLink], Any], log: Any
) -> None:
    """Every address of 127.0.0.0/8 is this machine's, so it can come as somebody else."""
    sessions = 0

    def session() -> Any:
        nonlocal sessions
        sessions += 1
        return bench.gs232()

    async with running(TcpLink(wire, "127.0.0.1", port, session, allowed=Allowed(["127.0.0.2"]))):
        for _ in range(5):
            assert await answer(port, "127.0.0.3") == b""
        assert sessions == 0
        assert await answer(port, "127.0.0.2") == b"AZ=235  EL=025\r\n"
    assert log.said == ["link: 127.0.0.3 is not in allow: turned away"]


async def test_how_many_is_the_link_s_own(
    wire: Wire, port: int, bench: Any, running: Callable[[TcpLink], Any], log: Any
) -> None:
    async with running(TcpLink(wire, "127.0.0.1", port, bench.gs232, most_clients=1)):
        _, first = await asyncio.open_connection("127.0.0.1", port)
        for _ in range(3):
            assert await answer(port, "127.0.0.1") == b""
        first.transport.abort()
    assert log.said == ["link: 1 clients already, one more is turned away"]
