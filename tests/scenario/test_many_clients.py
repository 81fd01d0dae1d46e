"""A hundred programs on one port of a box in a process of its own, and one that never reads: all the others are served.

How fast is for `benchmarks/running/busy.py` to say: here nothing is measured in seconds.
"""

from __future__ import annotations

import asyncio
import signal
import socket
import subprocess
import sys
from collections.abc import AsyncIterator, Iterator
from contextlib import AsyncExitStack, asynccontextmanager, closing
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.boxes import FAST_ROTOR, free_port, greets

PATIENCE_S = 120.0
CLIENTS, QUESTIONS = 100, 50
GROWTH_KIB = 20_000
"""A hundred connections and what waits for one deaf client; without bounds the flood below alone would be 200 MB."""


@dataclass(frozen=True, slots=True)
class Box:
    process: subprocess.Popen[bytes]
    port: int
    log: Path

    def resident_kib(self) -> int:
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS:"))


class Client:
    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader = reader
        self._writer = writer

    async def ask(self, question: bytes, lines: int = 1) -> bytes:
        self._writer.write(question)
        return b"".join([await self._line() for _ in range(lines)])

    async def _line(self) -> bytes:
        return await asyncio.wait_for(self._reader.readuntil(b"\n"), PATIENCE_S)

    async def until(self, word: bytes, *, there: bool) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while (word in await self.ask(b"s\n")) is not there:
                pass


@asynccontextmanager
async def connected(port: int) -> AsyncIterator[Client]:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        yield Client(reader, writer)
    finally:
        writer.transport.abort()


@pytest.fixture
def box(tmp_path: Path) -> Iterator[Box]:
    port = free_port()
    config, log = tmp_path / "rotator.toml", tmp_path / "log.txt"
    config.write_text(
        f'{FAST_ROTOR}\n[state]\npath = "{tmp_path}/state.json"\n[[link]]\nprotocol = "rotctld"\n'
        f'tcp = "127.0.0.1:{port}"\nmost_clients = {CLIENTS + 2}\n'
    )
    with log.open("wb") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(config)],
            stdout=subprocess.PIPE,
            stderr=errors,
        )
    assert process.stdout is not None
    with closing(process.stdout):
        assert greets(process.stdout)
        yield Box(process, port, log)
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE_S) == 0


async def poll(client: Client, done: asyncio.Event) -> int:
    """Ask as fast as it is answered, as often as each must be, and then until all is over."""
    answered = 0
    while answered < QUESTIONS or not done.is_set():
        azimuth, elevation = (await client.ask(b"p\n", lines=2)).split()
        assert -1 <= float(azimuth) <= 451
        assert -1 <= float(elevation) <= 181
        answered += 1
    return answered


async def flood(port: int) -> None:
    """Ask for what is long, and read none of it, until the box has had enough."""
    with closing(socket.socket()) as deaf:
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        deaf.setblocking(False)
        events = asyncio.get_running_loop()
        await events.sock_connect(deaf, ("127.0.0.1", port))
        with pytest.raises(ConnectionError):
            await asyncio.wait_for(_ask_for_ever(deaf), PATIENCE_S)


async def _ask_for_ever(deaf: socket.socket) -> None:
    while True:
        await asyncio.get_running_loop().sock_sendall(deaf, b"1\n" * 1000)


@pytest.mark.quiet
def test_everybody_is_served_and_one_stop_stops_it(box: Box) -> None:
    async def talk() -> int:
        async with AsyncExitStack() as crowd:
            hand = await crowd.enter_async_context(connected(box.port))
            clients = [await crowd.enter_async_context(connected(box.port)) for _ in range(CLIENTS)]
            for client in clients:
                await client.ask(b"p\n", lines=2)
            before_kib, done = box.resident_kib(), asyncio.Event()
            async with asyncio.TaskGroup() as group:
                polls = [group.create_task(poll(client, done)) for client in clients]
                await flood(box.port)
                # The deaf one has gone, and two places are left: the hand's, and this one.
                async with connected(box.port) as last, connected(box.port) as too_many:
                    await last.ask(b"p\n", lines=2)
                    with pytest.raises((asyncio.IncompleteReadError, ConnectionError)):
                        await too_many.ask(b"p\n")
                assert await hand.ask(b"M CW -1\n") == b"RPRT 0\n"
                await hand.until(b"MOVING", there=True)
                assert await hand.ask(b"S\n") == b"RPRT 0\n"
                await hand.until(b"MOVING", there=False)
                done.set()
            assert all(each.result() >= QUESTIONS for each in polls)
            return box.resident_kib() - before_kib

    grown_kib = asyncio.run(talk())
    assert grown_kib < GROWTH_KIB
    log = box.log.read_text()
    assert log.count("a client reads nothing: dropped") == 1
    assert log.count(f"{CLIENTS + 2} clients already, one more is turned away") == 1
    assert "Traceback" not in log
    assert "FAULT" not in log
