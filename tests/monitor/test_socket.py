"""The monitor's socket: watchers that come, go, read slowly or not at all, and a box that does not notice."""

from __future__ import annotations

import asyncio
import logging
import stat
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import pytest

from rotator.monitor.socket import MOST_WATCHERS, UNREAD_LIMIT, MonitorSocket

PATIENCE_S = 30.0
GREETING = ["# rotator 1.0", "# link gs232b"]


class Box:
    """What is being watched."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.listeners: list[Callable[[str], None]] = []
        self.socket = MonitorSocket(path, self.listeners, lambda: GREETING)

    def say(self, line: str) -> None:
        for listener in list(self.listeners):
            listener(line)

    async def heard_by(self, count: int) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while len(self.listeners) != count:
                await asyncio.sleep(0)


@pytest.fixture
def box(tmp_path: Path) -> Box:
    return Box(tmp_path / "run" / "monitor")


@asynccontextmanager
async def running(box: Box) -> AsyncIterator[asyncio.Task[None]]:
    task = asyncio.create_task(box.socket.run())
    async with asyncio.timeout(PATIENCE_S):
        while not task.done() and not (box.path.is_socket() and stat.S_IMODE(box.path.stat().st_mode) == 0o660):
            await asyncio.sleep(0)
    try:
        yield task
    finally:
        task.cancel()
        with suppress(asyncio.CancelledError):
            await task
        await asyncio.sleep(0)  # the watchers' last turn


@asynccontextmanager
async def watcher(box: Box) -> AsyncIterator[asyncio.StreamReader]:
    # No more is read ahead than a line or two.
    reader, writer = await asyncio.open_unix_connection(str(box.path), limit=64)
    try:
        yield reader
    finally:
        writer.transport.abort()


async def line(reader: asyncio.StreamReader) -> str:
    return (await asyncio.wait_for(reader.readline(), PATIENCE_S)).decode()


async def test_a_watcher_hears_the_greeting_and_then_every_line(box: Box) -> None:
    async with running(box), watcher(box) as one, watcher(box) as other:
        await box.heard_by(2)
        box.say("18:03:22.114 gs232b#1 > C2\\r")
        for each in (one, other):
            assert [await line(each) for _ in range(3)] == [
                "# rotator 1.0\n",
                "# link gs232b\n",
                "18:03:22.114 gs232b#1 > C2\\r\n",
            ]


async def test_it_is_the_owner_s_and_the_group_s_and_gone_at_the_end(box: Box) -> None:
    async with running(box):
        assert stat.S_IMODE(box.path.stat().st_mode) == 0o660
    assert not box.path.exists()


async def test_what_it_says_is_not_heard(box: Box) -> None:
    async with running(box):
        reader, writer = await asyncio.open_unix_connection(str(box.path))
        writer.write(b"W235 025\r" * 1000)
        await box.heard_by(1)
        box.say("still there")
        assert [await line(reader) for _ in range(3)][-1] == "still there\n"
        writer.transport.abort()


async def test_a_slow_one_is_told_how_much_it_missed_and_costs_a_bounded_amount(box: Box) -> None:
    async with running(box), watcher(box) as slow, watcher(box):
        await box.heard_by(2)
        said = 40_000
        for number in range(said):
            box.say(f"{number:06d} {'x' * 50}")
        heard: list[str] = []
        box.say("last")
        async with asyncio.timeout(PATIENCE_S):
            while not heard or heard[-1] != "after\n":
                heard.append(await line(slow))
                if len(heard) == 4000:
                    box.say("after")
        lines = [text for text in heard if text[0].isdigit()]
        (missed,) = [text for text in heard if "left out" in text]
        assert int(missed.split()[1]) == said + 1 - len(lines)
        assert lines == [f"{number:06d} {'x' * 50}\n" for number in range(len(lines))]
        assert heard.index(missed) == len(heard) - 2
        assert len(lines) * 58 < 3 * UNREAD_LIMIT, "the kernel's buffers and ours"


async def test_one_watcher_too_many_is_told_so(box: Box) -> None:
    async with running(box):
        ends = [await asyncio.open_unix_connection(str(box.path)) for _ in range(MOST_WATCHERS)]
        await box.heard_by(MOST_WATCHERS)
        async with watcher(box) as late:
            assert await line(late) == f"# {MOST_WATCHERS} are watching already\n"
            assert await line(late) == ""
        for _, writer in ends:
            writer.transport.abort()


# --- places that cannot be used: the box goes on without


async def _ends_by_itself(box: Box) -> None:
    await asyncio.wait_for(box.socket.run(), PATIENCE_S)


async def test_another_box_has_the_place(box: Box, caplog: pytest.LogCaptureFixture) -> None:
    async with running(box):
        await _ends_by_itself(Box(box.path))
        assert box.path.is_socket(), "the first one keeps it"
    assert caplog.messages == [f"{box.path}: another box uses it; this one cannot be monitored"]


async def test_what_a_dead_box_left_is_replaced(box: Box) -> None:
    box.path.parent.mkdir()
    left = await asyncio.start_unix_server(lambda *_: None, str(box.path))
    left.close()
    async with running(box), watcher(box) as one:
        assert await line(one) == "# rotator 1.0\n"


@pytest.mark.parametrize(
    ("name", "why"), [("mine", "Address already in use"), ("x" * 200, "too long"), ("file/monitor", "File exists")]
)
def test_a_place_that_is_none(tmp_path: Path, name: str, why: str, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "mine").write_text("a file of the user's\n")
    (tmp_path / "file").write_text("")
    caplog.set_level(logging.WARNING)
    asyncio.run(_ends_by_itself(Box(tmp_path / name)))
    (message,) = caplog.messages
    assert message.startswith(f"{tmp_path / name}: cannot be monitored there: ")
    assert why in message
    assert (tmp_path / "mine").read_text() == "a file of the user's\n"
