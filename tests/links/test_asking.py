"""Another program's server that the box asks: there or not, silent, talkative, gone and back. Nothing of it moves the
antenna but a position that changes.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from typing import Any

import pytest

from rotator.exchange.sources import Source
from rotator.links.asking import AskingLink
from rotator.links.wire import Wire
from rotator.protocols.rotctld_follow import RotctldFollower
from rotator.runtime.client import Client

PATIENCE_S = 30.0
Running = Callable[[AskingLink], Any]


class Server:
    """Answers each question with what it has been given to say, and counts questions and connections."""

    def __init__(self, say: bytes | None = b"10.00\n20.00\n") -> None:
        self.say = say
        self.asked = 0
        self.met = 0
        self._writers: set[asyncio.StreamWriter] = set()
        self._more = asyncio.Condition()

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._writers.add(writer)
        self.met += 1
        with suppress(ConnectionError):
            while await reader.readline() == b"p\n":
                if self.say is not None:
                    writer.write(self.say)
                async with self._more:
                    self.asked += 1
                    self._more.notify_all()
        async with self._more:
            self._writers.discard(writer)
            self._more.notify_all()
        writer.close()

    async def questions(self, count: int) -> None:
        """Wait for so many more; the answers to all but the last have been taken then."""
        enough = self.asked + count
        await self._until(lambda: self.asked >= enough)

    async def left(self) -> None:
        await self._until(lambda: not self._writers)

    def hang_up(self) -> None:
        for writer in self._writers:
            writer.transport.abort()

    async def _until(self, true: Callable[[], bool]) -> None:
        async with asyncio.timeout(PATIENCE_S), self._more:
            await self._more.wait_for(true)


@asynccontextmanager
async def listening(port: int, server: Server) -> AsyncIterator[Server]:
    listener = await asyncio.start_server(server.serve, "127.0.0.1", port)
    try:
        yield server
    finally:
        listener.close()
        server.hang_up()
        await server.left()


@pytest.fixture
def link(wire: Wire, port: int, bench: Any) -> AskingLink:
    def follower() -> RotctldFollower:
        return RotctldFollower(Client(bench.loop, bench.mount, Source("follow", 1)), 1.0)

    return AskingLink(wire, "127.0.0.1", port, follower, every_s=0.01, silence_s=0.3, retry_s=0.01)


async def test_it_follows_what_changes(link: AskingLink, port: int, running: Running, bench: Any) -> None:
    async with listening(port, Server()) as server, running(link):
        await server.questions(3)
        assert link.wire.state == "open"
        assert bench.drives() == (0, 0)
        server.say = b"300.00\n80.00\n"
        await server.questions(3)
        assert bench.drives() == (1, 1)
        assert bench.loop.status.wanted_azimuth_deg == 300
        assert server.met == 1
    assert link.wire.state == "closed"


async def test_it_asks_no_faster_than_it_is_told_to(wire: Wire, port: int, bench: Any, running: Running) -> None:
    clock = asyncio.get_running_loop().time
    follower = RotctldFollower(Client(bench.loop, bench.mount, Source("follow", 1)), 1.0)
    slow = AskingLink(wire, "127.0.0.1", port, lambda: follower, every_s=0.05)
    async with listening(port, Server()) as server, running(slow):
        await server.questions(1)
        begun_s = clock()
        await server.questions(4)
        assert clock() - begun_s >= 4 * 0.05 - 0.02


async def test_a_server_that_is_not_there_yet_is_waited_for(
    link: AskingLink, port: int, running: Running, bench: Any, log: Any
) -> None:
    async with running(link):
        await log.wait(f"127.0.0.1:{port} cannot be reached: Connection refused")
        assert link.wire.state == "waiting for it"
        async with listening(port, Server()) as server:
            await server.questions(2)
            await log.wait(f"127.0.0.1:{port} answers")
        await log.wait("cannot be reached", times=2)
    assert log.count("cannot be reached") == 2
    assert bench.drives() == (0, 0)


async def test_back_again_it_points_somewhere_else_and_nothing_moves(
    link: AskingLink, port: int, running: Running, bench: Any, log: Any
) -> None:
    async with running(link):
        async with listening(port, Server()) as server:
            await server.questions(2)
        await log.wait("has closed the connection")
        async with listening(port, Server(b"0.00\n0.00\n")) as server:
            await server.questions(3)
            assert bench.drives() == (0, 0)
            server.say = b"182.00\n0.00\n"
            await server.questions(3)
            assert bench.drives() == (-1, -1)


@pytest.mark.long
@pytest.mark.parametrize(
    ("say", "told"),
    [
        (None, "gives no answer within 0.3 s"),
        (b"10.00\n", "gives no answer within 0.3 s"),
        (b"\n" * 5000, "gives no answer within 0.3 s"),
        (b"HTTP/1.1 400 Bad Request\r\n\r\n", "does not speak the protocol: it says 'HTTP/1.1 400 Bad Request'"),
        (b"\x00" * 70_000 + b"\n", "does not speak the protocol: it says more than 128 bytes in a line"),
    ],
)
async def test_a_server_of_no_use_moves_nothing_and_is_told_once(  # noqa: PLR0917
    link: AskingLink, port: int, running: Running, bench: Any, log: Any, say: bytes | None, told: str
) -> None:
    async with listening(port, Server(say)) as server, running(link):
        await server.questions(4)
        assert server.met >= 3
    assert log.count(told) == 1
    assert len(log.said) == 1
    assert bench.drives() == (0, 0)


@pytest.mark.parametrize(
    "bad", [b"HTTP/1.1 400 Bad Request\r\n", b"\x00" * 200, b"RPRT -6\n", b"999.00\n20.00\n", b"10.00\n", None]
)
async def test_after_a_bad_answer_a_good_one_is_compared_with_the_last_good_one(
    link: AskingLink, port: int, running: Running, bench: Any, bad: bytes | None
) -> None:
    """The other rotor has turned meanwhile, and stands: this antenna has to get there too."""

    async with listening(port, Server()) as server, running(link):
        await server.questions(3)
        server.say = bad
        await server.questions(2)
        server.say = b"300.00\n80.00\n"
        await server.questions(3)
        assert bench.drives() == (1, 1)
        assert bench.loop.status.wanted_azimuth_deg == 300


async def test_a_server_that_knows_no_position_is_asked_on_and_told_once(
    link: AskingLink, port: int, running: Running, bench: Any, log: Any
) -> None:
    async with listening(port, Server(b"RPRT -6\n")) as server, running(link):
        await server.questions(4)
        server.say = b"10.00\n20.00\n"
        await log.wait("answers", times=2)
        assert server.met == 1
    assert log.said == [
        f"link: 127.0.0.1:{port} answers 'RPRT -6' for a position",
        f"link: 127.0.0.1:{port} answers",
    ]
    assert bench.drives() == (0, 0)


async def test_a_server_that_hangs_up(link: AskingLink, port: int, running: Running, bench: Any, log: Any) -> None:
    async with listening(port, Server()) as server, running(link):
        for times in (1, 2):
            await server.questions(2)
            server.hang_up()
            await log.wait("has closed the connection", times)
        await server.questions(2)
        assert server.met == 3
    assert bench.drives() == (0, 0)


async def test_a_name_that_no_machine_has(wire: Wire, running: Running, new_ear: type[Any], log: Any) -> None:
    link = AskingLink(wire, "no host", 4533, new_ear, every_s=0.01, retry_s=0.01)
    async with running(link):
        await log.wait("no host:4533 cannot be reached: ")
