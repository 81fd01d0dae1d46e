"""Lines to hang a link on: both ends as file descriptors, a box behind it, and ears for the log.

Nothing here sleeps: it waits for bytes, connections and log records, far longer than any should take.
"""

from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import AbstractAsyncContextManager, asynccontextmanager, suppress
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.exchange.sources import Source
from rotator.links.wire import Wire
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop
from tests.boxes import free_port

PATIENCE_S = 30.0
PERIOD_S = 0.05
LOOK_S = 3.0
"""So long the box looks at a still antenna before it closes its first relay."""


class Bench:
    """A box that stands at 235 and 25, and has seen that, in simulated time: it acts when the test says so."""

    def __init__(self) -> None:
        clock = SimClock()
        config = Config()
        self.station = Station(config, clock, clock.sleep, (235.0, 25.0))
        self.loop = ControlLoop(build_controller(config), self.station.rotor, clock, PERIOD_S)
        self.mount = build_mount(config)
        for _ in range(round(LOOK_S / PERIOD_S)):
            self.loop.cycle()
            clock.sleep(PERIOD_S)

    def drives(self) -> tuple[int, int]:
        """Which way the motors run, once the box has taken its orders."""
        assert self.station.world is not None
        self.loop.cycle()
        return self.station.world.drives()

    def gs232(self, dialect: Dialect = Dialect.B) -> Gs232Session:
        return Gs232Session(Client(self.loop, self.mount, Source("gs232", 1)), dialect)

    def rotctld(self) -> RotctldSession:
        return RotctldSession(Client(self.loop, self.mount, Source("rotctld", 1)))


class Ear:
    """A session that only listens: it keeps all it has heard, and says when it has heard enough."""

    idle_s = None
    closed = False

    def __init__(self) -> None:
        self.heard = b""
        self._more = asyncio.Event()

    def receive(self, data: bytes) -> list[bytes]:
        self.heard += data
        self._more.set()
        return []

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return []

    async def hears(self, count: int) -> bytes:
        async with asyncio.timeout(PATIENCE_S):
            while len(self.heard) < count:
                self._more.clear()
                await self._more.wait()
        return self.heard


class End:
    """One end of a line. A `read` here is one read of the kernel's."""

    def __init__(self, where: int | Path) -> None:
        self.fd = where if isinstance(where, int) else os.open(where, os.O_RDWR | os.O_NOCTTY)
        os.set_blocking(self.fd, False)

    async def read(self) -> bytes:
        events = asyncio.get_running_loop()
        ready = asyncio.Event()
        events.add_reader(self.fd, ready.set)
        try:
            await asyncio.wait_for(ready.wait(), PATIENCE_S)
        finally:
            events.remove_reader(self.fd)
        return os.read(self.fd, 4096)

    async def write(self, data: bytes) -> None:
        events = asyncio.get_running_loop()
        ready = asyncio.Event()
        events.add_writer(self.fd, ready.set)
        try:
            while data:
                ready.clear()
                await asyncio.wait_for(ready.wait(), PATIENCE_S)
                with suppress(BlockingIOError):
                    data = data[os.write(self.fd, data) :]
        finally:
            events.remove_writer(self.fd)

    async def ask(self, data: bytes) -> bytes:
        await self.write(data)
        return await self.read()

    def nothing(self) -> bool:
        """Nothing has come."""
        try:
            return os.read(self.fd, 1) == b""
        except BlockingIOError:
            return True

    def close(self) -> None:
        if self.fd >= 0:
            os.close(self.fd)
            self.fd = -1


class Log(logging.Handler):
    """What the links have said, and a way to wait for the next time they say something."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self.said: list[str] = []
        self._more: asyncio.Event | None = None

    def emit(self, record: logging.LogRecord) -> None:
        self.said.append(record.getMessage())
        if self._more is not None:
            self._more.set()

    def count(self, words: str) -> int:
        return sum(words in text for text in self.said)

    async def wait(self, words: str, times: int = 1) -> None:
        self._more = asyncio.Event()
        async with asyncio.timeout(PATIENCE_S):
            while self.count(words) < times:
                self._more.clear()
                await self._more.wait()


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def bench() -> Iterator[Bench]:
    bench = Bench()
    yield bench
    bench.station.close()


@pytest.fixture
def wire() -> Wire:
    return Wire("link", "test", "here")


@pytest.fixture
def new_ear() -> type[Ear]:
    return Ear


@pytest.fixture
def end() -> Iterator[Callable[[int | Path], End]]:
    """Opens an end of a line; whatever is still open is closed after the test."""
    ends: list[End] = []

    def open_end(where: int | Path) -> End:
        ends.append(End(where))
        return ends[-1]

    yield open_end
    for each in ends:
        each.close()


@pytest.fixture
def log() -> Iterator[Log]:
    ear = Log()
    logger = logging.getLogger("rotator.links")
    before = logger.level
    logger.setLevel(logging.INFO)
    logger.addHandler(ear)
    yield ear
    logger.removeHandler(ear)
    logger.setLevel(before)


@pytest.fixture
def running() -> Callable[[Any], AbstractAsyncContextManager[asyncio.Task[None]]]:
    """Opens a link, runs it as the app does, and stops it by cancelling. One that ends by itself fails the test."""

    @asynccontextmanager
    async def run(link: Any) -> AsyncIterator[asyncio.Task[None]]:
        await link.open()
        test = asyncio.current_task()
        assert test is not None
        task = asyncio.create_task(link.run())

        def ended(_task: asyncio.Task[None]) -> None:
            test.cancel()

        task.add_done_callback(ended)
        await asyncio.sleep(0)  # its first turn
        try:
            yield task
            assert not task.done(), "the link has ended by itself"
        finally:
            failed = task.done()
            if not failed:
                task.remove_done_callback(ended)
                task.cancel()
            else:
                test.uncancel()
            outcome: BaseException | None
            async with asyncio.timeout(PATIENCE_S):
                (outcome,) = await asyncio.gather(task, return_exceptions=True)
            if isinstance(outcome, Exception):
                raise outcome

    return run
