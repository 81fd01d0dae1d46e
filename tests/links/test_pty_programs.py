"""Programs that come and go on a pseudo-terminal: what one leaves behind does not reach the next.

The programs are processes of their own, killed where it matters. In the search they are file descriptors, which the
kernel counts in the same way.
"""

from __future__ import annotations

import asyncio
import fcntl
import os
import subprocess
import sys
import tempfile
import termios
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.links.pty import PtyLink
from rotator.links.wire import Wire
from tests.search import examples

Running = Callable[[PtyLink], Any]
POSITION = b"AZ=235  EL=025\r\n"
PATIENCE_S = 30.0
NOBODY = 65_534

CHILD = """
import os, sys
port = os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY)
exec(sys.argv[2])
print("ready", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "gs232"


@asynccontextmanager
async def program(path: Path, first: str) -> AsyncIterator[asyncio.subprocess.Process]:
    """A process that has opened the port and done `first`, and then waits. It is killed at the end."""
    pipe = asyncio.subprocess.PIPE
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", CHILD, str(path), first, stdin=pipe, stdout=pipe
    )
    assert process.stdout is not None
    try:
        async with asyncio.timeout(PATIENCE_S):
            assert await process.stdout.readline() == b"ready\n"
        yield process
    finally:
        with suppress(ProcessLookupError):
            process.kill()
        await process.wait()


class Sessions:
    """The conversations of a link, in order: what each has heard. Each answers every byte with its own number."""

    def __init__(self) -> None:
        self.heard: list[bytes] = []
        self.over: list[bool] = []
        self._more = asyncio.Event()

    def new(self) -> Session:
        self.heard.append(b"")
        self.over.append(False)
        return Session(self, len(self.heard) - 1)

    def changed(self) -> None:
        self._more.set()

    async def until(self, done: Callable[[], bool]) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while not done():
                self._more.clear()
                await self._more.wait()


class Session:
    idle_s = None
    closed = False

    def __init__(self, sessions: Sessions, number: int) -> None:
        self._sessions = sessions
        self._number = number

    def receive(self, data: bytes) -> list[bytes]:
        assert not self._sessions.over[self._number]
        self._sessions.heard[self._number] += data
        self._sessions.changed()
        return [bytes([self._number % 256]) * len(data)]

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return []

    def ended(self) -> None:
        self._sessions.over[self._number] = True
        self._sessions.changed()


def link_to(path: Path, sessions: Sessions) -> PtyLink:
    return PtyLink(Wire("link", "test", "here"), path, sessions.new)


# --- processes


async def test_answers_that_a_killed_program_has_not_read_do_not_reach_the_next(
    path: Path, running: Running, end: Callable[[Path], Any], bench: Any
) -> None:
    async with running(PtyLink(Wire("link", "gs232", "here"), path, bench.gs232)):
        async with program(path, "for _ in range(2000): os.write(port, b'C2\\r')"):
            pass
        client = end(path)
        assert await client.ask(b"!\r") == b"?>\r\n"


async def test_each_program_is_a_connection_of_its_own(path: Path, running: Running) -> None:
    sessions = Sessions()
    async with running(link_to(path, sessions)):
        for number in range(3):
            async with program(path, "os.write(port, b'W300 0')"):
                await sessions.until(lambda: b"".join(sessions.heard).endswith(b"W300 0"))
                assert sessions.over == [True] * number + [False]
            await sessions.until(lambda: all(sessions.over))
        assert sessions.heard == [b"W300 0"] * 3, "half a command does not outlive its program"


async def test_while_a_second_program_has_it_open_nothing_ends(
    path: Path, running: Running, end: Callable[[Path], Any]
) -> None:
    """Opened and closed at the same moment by several: the kernel merges equal events."""

    sessions = Sessions()
    async with running(link_to(path, sessions)):
        stays = end(path)
        for _ in range(3):
            others = [os.open(path, os.O_RDWR | os.O_NOCTTY) for _ in range(5)]
            for other in others:
                os.close(other)
                await turns()
        async with program(path, "pass"):
            pass
        assert await stays.ask(b"1") == b"\0"
        assert sessions.over == [False]
        stays.close()
        await sessions.until(lambda: sessions.over == [True])


async def test_last_words_are_heard(path: Path, running: Running, bench: Any, end: Callable[[Path], Any]) -> None:
    """`echo S > run/gs232`: opened, written and closed before the box looks."""

    async with running(PtyLink(Wire("link", "gs232", "here"), path, bench.gs232)):
        assert await end(path).ask(b"W300 080\rC2\r") == POSITION
        assert bench.drives() == (1, 1)
        await asyncio.to_thread(subprocess.run, ["sh", "-c", f"printf 'S\\r' > {path}"], check=True)
        client = end(path)
        assert await client.ask(b"C2\r") == POSITION
        assert bench.drives() == (0, 0)


def test_one_left_in_exclusive_use_can_be_opened_again() -> None:
    """Qt and others set TIOCEXCL. A killed program leaves it set, and the kernel lets no ordinary user in any more."""

    async def look() -> None:
        sessions = Sessions()
        link = link_to(folder / "port", sessions)
        await link.open()
        task = asyncio.create_task(link.run())
        try:
            for number in range(3):
                port = os.open(folder / "port", os.O_RDWR | os.O_NOCTTY)
                fcntl.ioctl(port, termios.TIOCEXCL)
                os.write(port, b"x")
                await sessions.until(lambda: len(sessions.heard) > number)  # noqa: B023 - it is used at once
                os.close(port)
                await sessions.until(lambda: all(sessions.over))
                await asyncio.sleep(0)
        finally:
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)

    child = os.fork()
    if child == 0:
        code = 1
        with suppress(BaseException):
            if os.getuid() == 0:
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            with tempfile.TemporaryDirectory() as made:
                folder = Path(made)
                asyncio.run(look())
            code = 0
        os._exit(code)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0


async def test_what_a_program_sets_on_the_line_ends_with_it(
    path: Path, running: Running, end: Callable[[Path], Any]
) -> None:
    """A terminal with echo would send each answer back to the box."""
    echo = "import termios; a = termios.tcgetattr(port); a[3] |= termios.ECHO; termios.tcsetattr(port, 0, a)"

    sessions = Sessions()
    async with running(link_to(path, sessions)):
        async with program(path, echo + "; os.write(port, b'x')"):
            await sessions.until(lambda: len(sessions.heard) > 0)
        await sessions.until(lambda: all(sessions.over))
        await asyncio.sleep(0)
        client = end(path)
        assert not termios.tcgetattr(client.fd)[3] & termios.ECHO


async def test_a_kernel_without_watches_is_no_end(
    path: Path, running: Running, end: Callable[[Path], Any], log: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """fs.inotify.max_user_instances is 128: other programs may have them all."""

    class Exhausted:
        def __init__(self, _path: Path) -> None:
            raise OSError(24, "Too many open files")

    monkeypatch.setattr("rotator.links.terminal.Openings", Exhausted)

    sessions = Sessions()
    async with running(link_to(path, sessions)):
        for number in range(2):
            client = end(path)
            assert await client.ask(b"x") == bytes([number])
            client.close()
            await sessions.until(lambda: all(sessions.over))
    assert log.count("Too many open files") == 1


# --- any order of events

steps = st.lists(
    st.tuples(st.sampled_from(["open", "close", "write", "write", "look"]), st.integers(0, 3)), max_size=30
)


async def turns() -> None:
    """Let the link see what has happened."""
    for _ in range(12):
        await asyncio.sleep(0)


async def heard(sessions: Sessions, written: bytes) -> None:
    """The kernel carries the bytes a little later, and then the link looks."""
    await sessions.until(lambda: b"".join(sessions.heard) == written)
    await turns()


@settings(max_examples=examples(150))
@given(steps)
def test_any_programs_in_any_order(tmp_path_factory: pytest.TempPathFactory, script: list[tuple[str, int]]) -> None:
    """The box looks at moments of its own. Every byte is heard once and in order; and once it has seen the last program
    leave, the next one has a conversation of its own, and hears no answer to another's bytes."""
    path = tmp_path_factory.mktemp("any") / "port"

    async def play() -> None:
        sessions = Sessions()
        link = link_to(path, sessions)
        await link.open()
        task = asyncio.create_task(link.run())
        ports: dict[int, int] = {}
        written = b""
        try:
            for count, (step, which) in enumerate(script):
                match step:
                    case "open" if which not in ports:
                        ports[which] = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
                    case "close" if which in ports:
                        os.close(ports.pop(which))
                    case "write" if which in ports:
                        written += (byte := bytes([count]))
                        os.write(ports[which], byte)
                    case "look":
                        await heard(sessions, written)
            await heard(sessions, written)
            while ports:
                os.close(ports.popitem()[1])
            await sessions.until(lambda: all(sessions.over))
            await turns()
            before = len(sessions.heard)
            last = ports[9] = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
            os.write(last, b"?")
            await heard(sessions, written + b"?")
            assert os.read(last, 4096) == bytes([before]), "one answer, of a new conversation"
        finally:
            for port in ports.values():
                os.close(port)
            task.cancel()
            await asyncio.gather(task, return_exceptions=True)

    asyncio.run(play())
