"""A listening socket: clients that share a port and nothing else, whole or in pieces, many, deaf or gone."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack, asynccontextmanager, closing
from typing import Any

import pytest

from rotator.links.stream import READ_BYTES
from rotator.links.tcp import MOST_CLIENTS, TcpLink
from rotator.links.wire import LinkError, Wire
from rotator.protocols.session import Session

PATIENCE_S = 30.0
POSITION = b"AZ=235  EL=025\r\n"
Running = Callable[[TcpLink], Any]


class Client:
    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader = reader
        self.writer = writer

    async def send(self, data: bytes) -> None:
        self.writer.write(data)
        await self.writer.drain()

    async def answer(self) -> bytes:
        """A line, or what there was before the connection ended."""
        return await asyncio.wait_for(self._reader.readline(), PATIENCE_S)

    async def ask(self, data: bytes) -> bytes:
        await self.send(data)
        return await self.answer()

    async def is_turned_away(self) -> bool:
        try:
            return await self.answer() == b""
        except ConnectionError:
            return True


@asynccontextmanager
async def connected(port: int) -> AsyncIterator[Client]:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        yield Client(reader, writer)
    finally:
        writer.close()
        await asyncio.gather(writer.wait_closed(), return_exceptions=True)


@pytest.fixture
def gs232(wire: Wire, port: int, bench: Any) -> TcpLink:
    return TcpLink(wire, "127.0.0.1", port, bench.gs232)


@pytest.fixture
def rotctld(wire: Wire, port: int, bench: Any) -> TcpLink:
    return TcpLink(wire, "127.0.0.1", port, bench.rotctld)


# --- conversations


async def test_each_client_has_a_conversation_of_its_own(gs232: TcpLink, port: int, running: Running) -> None:
    async with running(gs232), connected(port) as one, connected(port) as other:
        await one.send(b"C")
        assert await other.ask(b"C2\r") == POSITION
        assert await one.ask(b"2\r") == POSITION
        assert await other.ask(b"B\r") == b"EL=025\r\n"


async def test_the_wire_counts_its_clients(rotctld: TcpLink, port: int, running: Running) -> None:
    async with running(rotctld):
        assert rotctld.wire.state == "listening"
        async with connected(port) as one:
            await one.ask(b"p\n")
            assert rotctld.wire.state == "1 client"
            async with connected(port) as other:
                await other.ask(b"p\n")
                assert rotctld.wire.state == "2 clients"
    assert rotctld.wire.state == "closed"


async def test_a_client_that_ends_no_line_is_heard_when_it_falls_silent(
    rotctld: TcpLink, port: int, running: Running, bench: Any
) -> None:
    """Gpredict on Windows, up to 2018."""

    async with running(rotctld), connected(port) as client:
        assert await client.ask(b"P 300 80") == b"RPRT 0\n"
        assert bench.drives() == (1, 1)


class Metered:
    """A session, and how many bytes it has been given."""

    idle_s = None

    def __init__(self, session: Session) -> None:
        self._session = session
        self.taken = 0

    @property
    def closed(self) -> bool:
        return self._session.closed

    def receive(self, data: bytes) -> list[bytes]:
        self.taken += len(data)
        return self._session.receive(data)

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return self._session.idle()


async def test_nobodys_flood_and_nobodys_pause_holds_up_a_stop(
    wire: Wire, port: int, running: Running, bench: Any
) -> None:
    """Ten clients send half a million questions, one wants to pause; then a hand presses stop. A few turns of each
    client later it has its answer."""
    sessions: list[Metered] = []

    def session() -> Metered:
        sessions.append(Metered(bench.rotctld()))
        return sessions[-1]

    async with running(TcpLink(wire, "127.0.0.1", port, session)), AsyncExitStack() as crowd:
        hand = await crowd.enter_async_context(connected(port))
        floods = [(b"p" * 100 + b"\n") * 500] * 10 + [b"\\pause 600\n"]
        clients = [await crowd.enter_async_context(connected(port)) for _ in floods]
        assert await hand.ask(b"P 300 80\n") == b"RPRT 0\n"
        assert bench.drives() == (1, 1)
        for client, flood in zip(clients, floods, strict=True):
            client.writer.write(flood)
        assert await hand.ask(b"S\n") == b"RPRT 0\n"
        assert all(each.taken <= 10 * READ_BYTES for each in sessions)
        assert bench.drives() == (0, 0)


# --- browsers

POST = b"POST / HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: https://site.example\r\nContent-Length: 10\r\n\r\n"


async def test_what_a_web_site_lets_a_browser_send_is_no_order(
    rotctld: TcpLink, port: int, running: Running, bench: Any, log: Any
) -> None:
    order = b"P 300 80\n"
    sent = [(POST + order,), (b"PO", POST[2:], order), (b"\x16\x03\x01\n" + order,)]

    async with running(rotctld), connected(port) as program:
        for pieces in sent:
            async with connected(port) as browser:
                for piece in pieces:
                    await browser.send(piece)
                assert await browser.is_turned_away()
        await log.wait("link: a browser speaks HTTP here, a web site in it perhaps: turned away")
        assert bench.drives() == (0, 0)
        assert await program.ask(order) == b"RPRT 0\n"
        assert bench.drives() == (1, 1)


async def test_a_protocol_on_http_is_for_browsers_too(wire: Wire, port: int, running: Running, bench: Any) -> None:
    link = TcpLink(wire, "127.0.0.1", port, bench.rotctld, speaks_http=True)
    async with running(link), connected(port) as browser:
        assert await browser.ask(POST) == b"RPRT -4\n"


# --- coming and going


async def test_q_ends_that_connection_and_no_other(rotctld: TcpLink, port: int, running: Running) -> None:
    async with running(rotctld), connected(port) as one, connected(port) as other:
        assert await one.ask(b"S\nq\n") == b"RPRT 0\n"
        assert await one.answer() == b""
        assert await other.ask(b"S\n") == b"RPRT 0\n"


async def test_a_client_that_vanishes_disturbs_nobody(gs232: TcpLink, port: int, running: Running) -> None:
    async with running(gs232), connected(port) as other:
        async with connected(port) as one:
            await one.send(b"C2\r" * 100)
            one.writer.transport.abort()
        assert await other.ask(b"C2\r") == POSITION


async def test_one_client_too_many_is_turned_away(gs232: TcpLink, port: int, running: Running, log: Any) -> None:
    async with running(gs232), AsyncExitStack() as crowd:
        clients = [await crowd.enter_async_context(connected(port)) for _ in range(MOST_CLIENTS)]
        for client in clients:
            assert await client.ask(b"C2\r") == POSITION
        async with connected(port) as late:
            assert await late.is_turned_away()
        await log.wait(f"link: {MOST_CLIENTS} clients already, one more is turned away")
        for client in clients:
            assert await client.ask(b"C2\r") == POSITION
        await crowd.aclose()
        async with connected(port) as later:
            assert await later.ask(b"C2\r") == POSITION


async def test_a_client_that_never_reads_is_dropped_and_the_others_live(
    gs232: TcpLink, port: int, running: Running, log: Any
) -> None:
    async with running(gs232), connected(port) as other:
        with closing(socket.socket()) as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.setblocking(False)
            await asyncio.get_running_loop().sock_connect(deaf, ("127.0.0.1", port))
            with pytest.raises(ConnectionError):
                await asyncio.wait_for(_ask_for_ever(deaf), PATIENCE_S)
            assert await other.ask(b"C2\r") == POSITION
    assert log.count("link: a client reads nothing: dropped") == 1


async def _ask_for_ever(client: socket.socket) -> None:
    while True:
        await asyncio.get_running_loop().sock_sendall(client, b"H\r" * 1000)


async def test_stopped_it_lets_its_clients_go_and_its_port_too(gs232: TcpLink, port: int, running: Running) -> None:
    async with AsyncExitStack() as clients:
        for _ in range(2):
            async with running(gs232):
                client = await clients.enter_async_context(connected(port))
                assert await client.ask(b"C2\r") == POSITION
            assert await client.is_turned_away()


# --- places that cannot be listened at


async def test_a_port_in_use(gs232: TcpLink, port: int, running: Running, new_ear: type[Any]) -> None:
    async with running(gs232), connected(port) as client:
        with pytest.raises(LinkError) as refused:
            await TcpLink(Wire("second", "test", "here"), "127.0.0.1", port, new_ear).open()
        assert str(refused.value).startswith(f"127.0.0.1:{port}: cannot listen there: Address already in use: end")
        assert await client.ask(b"C2\r") == POSITION


def test_a_name_that_no_machine_has(wire: Wire, new_ear: type[Any]) -> None:
    with pytest.raises(socket.gaierror) as unknown:
        socket.getaddrinfo("no host", 4533)
    with pytest.raises(LinkError) as refused:
        asyncio.run(TcpLink(wire, "no host", 4533, new_ear).open())
    assert str(refused.value).startswith(f"no host:4533: cannot listen there: {unknown.value.strerror}: write an")


def test_a_name_that_cannot_be(wire: Wire, new_ear: type[Any]) -> None:
    with pytest.raises(LinkError, match=r"^a\.\.b:4533: cannot listen there: "):
        asyncio.run(TcpLink(wire, "a..b", 4533, new_ear).open())
