"""The console's socket: people that come, go, say too much or do not listen, and a box that runs on."""

from __future__ import annotations

import asyncio
import logging
import stat
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import pytest

from rotator.cli.reach import connected
from rotator.config.places import console_path
from rotator.links.console import MOST_CLIENTS, ConsoleSocket
from rotator.links.stream import UNREAD_LIMIT

PATIENCE_S = 30.0


class Parrot:
    """Says every whole line again. `much`: at length."""

    idle_s = None
    closed = False

    def __init__(self) -> None:
        self._begun = b""

    def receive(self, data: bytes) -> list[bytes]:
        *lines, self._begun = (self._begun + data).split(b"\n")
        return [line + b"\n" if line != b"much" else b"x" * 1000 + b"\n" for line in lines]

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return []


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "console"


@asynccontextmanager
async def running(path: Path) -> AsyncIterator[ConsoleSocket]:
    console = ConsoleSocket(path, Parrot)
    task = asyncio.create_task(console.run())
    async with asyncio.timeout(PATIENCE_S):
        while not task.done() and console.wire.state != "listening":
            await asyncio.sleep(0)
    assert not task.done()
    try:
        yield console
    finally:
        task.cancel()
        with suppress(asyncio.CancelledError):
            await task
        await asyncio.sleep(0)  # the clients' last turn


async def test_folders_with_long_names_have_a_console_too(tmp_path: Path) -> None:
    """The kernel takes no socket's path above 107 bytes."""
    path = tmp_path / ("long name " * 10) / ("ü" * 60) / "console"

    async with running(path):
        place = await asyncio.to_thread(connected, path)
        assert place is not None
        reader, writer = await asyncio.open_unix_connection(sock=place)
        writer.write(b"stop\n")
        assert await asyncio.wait_for(reader.readline(), PATIENCE_S) == b"stop\n"
        writer.close()
        await writer.wait_closed()
    assert not path.exists()
    assert connected(path) is None


class Person:
    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader = reader
        self.writer = writer

    async def ask(self, line: bytes) -> bytes:
        self.writer.write(line + b"\n")
        return await self.answer()

    async def answer(self) -> bytes:
        return await asyncio.wait_for(self.reader.readline(), PATIENCE_S)

    async def is_dropped(self) -> None:
        async with asyncio.timeout(PATIENCE_S):
            with suppress(ConnectionResetError):
                while await self.reader.read(4096):
                    pass


@asynccontextmanager
async def person(path: Path) -> AsyncIterator[Person]:
    # No more is read ahead than a line or two.
    reader, writer = await asyncio.open_unix_connection(str(path), limit=64)
    try:
        yield Person(reader, writer)
    finally:
        writer.transport.abort()


async def test_each_has_a_conversation_of_its_own(path: Path) -> None:
    async with running(path), person(path) as one, person(path) as other:
        one.writer.write(b"where ")
        assert await other.ask(b"stop") == b"stop\n"
        assert await one.ask(b"is it") == b"where is it\n"


async def test_whoever_says_all_at_once_and_closes_hears_the_answer(path: Path) -> None:
    async with running(path), person(path) as one:
        one.writer.write(b"stop\nstatus\n")
        one.writer.write_eof()
        assert [await one.answer() for _ in range(3)] == [b"stop\n", b"status\n", b""]


async def test_it_is_the_owner_s_and_the_group_s_and_gone_at_the_end(path: Path) -> None:
    async with running(path) as console:
        assert stat.S_IMODE(path.stat().st_mode) == 0o660
        assert console.wire.state == "listening"
    assert not path.exists()
    assert console.wire.state == "closed"


async def test_one_that_goes_is_forgotten(path: Path) -> None:
    async with running(path) as console:
        async with person(path) as one:
            await one.ask(b"status")
            assert len(console.clients) == 1
        async with asyncio.timeout(PATIENCE_S):
            while console.clients:
                await asyncio.sleep(0)


async def test_one_that_reads_nothing_is_dropped_and_costs_the_others_nothing(
    path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    async with running(path) as console, person(path) as deaf, person(path) as other:
        await other.ask(b"status")
        deaf.writer.write(b"much\n" * (UNREAD_LIMIT // 100))
        async with asyncio.timeout(PATIENCE_S):
            while len(console.clients) != 1:
                await asyncio.sleep(0)
        assert await other.ask(b"stop") == b"stop\n"
    assert caplog.messages == ["console: a client reads nothing: dropped"]


async def test_the_one_that_is_silent_longest_makes_room(path: Path) -> None:
    async with running(path) as console:
        people = [Person(*await asyncio.open_unix_connection(str(path))) for _ in range(MOST_CLIENTS)]
        for each in people:
            await each.ask(b"status")
        await people[0].ask(b"still here")
        async with person(path) as late:
            assert await late.ask(b"stop") == b"stop\n"
            await people[1].is_dropped()
            assert await people[0].ask(b"and here") == b"and here\n"
            assert len(console.clients) == MOST_CLIENTS
        for each in people:
            each.writer.transport.abort()


# --- places


def test_it_is_beside_the_monitor() -> None:
    assert console_path(Path("/run/rotator/monitor")) == Path("/run/rotator/console")


def test_two_boxes_with_monitors_in_one_folder_have_a_console_each() -> None:
    assert console_path(Path("run/north")) == Path("run/north-console")
    assert console_path(Path("run/south")) == Path("run/south-console")
    assert console_path(Path("run/console")) != Path("run/console")


async def test_what_a_dead_box_left_is_replaced(path: Path) -> None:
    path.parent.mkdir()
    left = await asyncio.start_unix_server(lambda *_: None, str(path))
    left.close()
    assert path.is_socket()
    async with running(path), person(path) as one:
        assert await one.ask(b"status") == b"status\n"


async def _ends_by_itself(path: Path) -> None:
    await asyncio.wait_for(ConsoleSocket(path, Parrot).run(), PATIENCE_S)


async def test_another_box_has_the_place(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    async with running(path), person(path) as one:
        await _ends_by_itself(path)
        assert await one.ask(b"status") == b"status\n"
        async with person(path) as other:
            assert await other.ask(b"status") == b"status\n"
    assert caplog.messages == [f"{path}: another box uses it; this one has no console"]


@pytest.mark.parametrize(
    ("name", "why"), [("mine", "Address already in use"), ("x" * 200, "too long"), ("file/console", "File exists")]
)
def test_a_place_that_is_none(tmp_path: Path, name: str, why: str, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "mine").write_text("a file of the user's\n")
    (tmp_path / "file").write_text("")
    caplog.set_level(logging.WARNING)
    asyncio.run(_ends_by_itself(tmp_path / name))
    (message,) = caplog.messages
    assert message.startswith(f"{tmp_path / name}: there can be no console: ")
    assert why in message
    assert (tmp_path / "mine").read_text() == "a file of the user's\n"
