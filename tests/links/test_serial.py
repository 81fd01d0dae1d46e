"""A serial port that comes and goes, and the URLs that pyserial opens in its place.

The port is a pseudo-terminal behind a symlink: taking both away is what unplugging an adapter looks like.
"""

from __future__ import annotations

import asyncio
import os
import queue
import socket
import termios
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import pytest
import serial
from serial.rfc2217 import PortManager

from rotator.links.serial import SerialLink
from rotator.links.wire import Wire

PATIENCE_S = 30.0
RETRY_S = 0.01
POSITION = b"AZ=235  EL=025\r\n"
Running = Callable[[SerialLink], Any]


class Adapter:
    """A USB adapter under a fixed name, and the PC at its other end."""

    def __init__(self, path: Path, end: Callable[[int], Any]) -> None:
        self.path = path
        self._end = end
        self._slave = -1
        self.pc: Any = None

    def plug_in(self) -> None:
        master, self._slave = os.openpty()
        self.pc = self._end(master)
        self.path.symlink_to(os.ttyname(self._slave))

    def unplug(self) -> None:
        self.path.unlink()
        os.close(self._slave)
        self.pc.close()
        self._slave = -1

    def line_speed(self) -> tuple[int, int]:
        """As the driver was told: the speed, and the flags for size, parity and stop bits."""
        _, _, flags, _, _, speed, _ = termios.tcgetattr(self._slave)
        return speed, flags & (termios.CSIZE | termios.PARENB | termios.CSTOPB | termios.CRTSCTS)

    def close(self) -> None:
        if self._slave >= 0:
            os.close(self._slave)


class CountedPool(ThreadPoolExecutor):
    """Where asyncio does its blocking work; it tells when so much of it has been done."""

    def __init__(self, goal: int) -> None:
        super().__init__(thread_name_prefix="asyncio_counted")
        self._left = goal
        self.reached = asyncio.Event()

    def submit(self, *work: Any, **more: Any) -> Any:
        self._left -= 1
        if self._left <= 0:
            self.reached.set()
        return super().submit(*work, **more)


@pytest.fixture
def adapter(tmp_path: Path, end: Callable[[int], Any]) -> Iterator[Adapter]:
    adapter = Adapter(tmp_path / "ttyUSB0", end)
    yield adapter
    adapter.close()


@pytest.fixture
def link(wire: Wire, adapter: Adapter, bench: Any) -> SerialLink:
    return SerialLink(wire, str(adapter.path), 9600, bench.gs232, retry_s=RETRY_S)


# --- a port


def test_it_talks_9600_8n1_without_echo(link: SerialLink, adapter: Adapter, running: Running, log: Any) -> None:
    async def talk() -> None:
        adapter.plug_in()
        async with running(link):
            await log.wait("open at")
            assert link.wire.state == "open"
            assert adapter.line_speed() == (termios.B9600, termios.CS8)
            for _ in range(100):
                assert await adapter.pc.ask(b"C2\r") == POSITION
        assert log.said == [f"link: {adapter.path} open at 9600 baud"]

    asyncio.run(talk())


def test_garbage_is_answered_and_moves_nothing(
    link: SerialLink, adapter: Adapter, running: Running, log: Any, bench: Any
) -> None:
    """Bytes as they look at the wrong baud rate."""

    async def talk() -> None:
        adapter.plug_in()
        async with running(link):
            await log.wait("open at")
            await adapter.pc.write(bytes(range(256)) * 4 + b"\r")
            answers = b""
            while not answers.endswith(POSITION):
                answers += await adapter.pc.ask(b"C2\r")
            assert set(answers.replace(POSITION, b"").split(b"\r\n")) == {b"?>", b""}
            assert bench.drives() == (0, 0)

    asyncio.run(talk())


def test_a_missing_port_is_waited_for_and_said_once(
    link: SerialLink, adapter: Adapter, running: Running, log: Any
) -> None:
    async def talk() -> None:
        tries = CountedPool(10)
        asyncio.get_running_loop().set_default_executor(tries)
        async with running(link):
            await asyncio.wait_for(tries.reached.wait(), PATIENCE_S)
            assert len(log.said) == 1
            assert log.said[0].startswith(f"link: {adapter.path} cannot be opened: ")
            assert log.said[0].endswith("; waiting for it")
            assert "No such file or directory" in log.said[0]
            assert link.wire.state == "waiting for it"
            adapter.plug_in()
            await log.wait("open at")
            assert await adapter.pc.ask(b"C2\r") == POSITION

    asyncio.run(talk())


def test_unplugged_and_plugged_in_again(link: SerialLink, adapter: Adapter, running: Running, log: Any) -> None:
    async def talk() -> None:
        adapter.plug_in()
        async with running(link) as task:
            for count in range(1, 4):
                await log.wait("open at", times=count)
                assert await adapter.pc.ask(b"C2\r") == POSITION
                adapter.unplug()
                await log.wait(" lost: ", times=count)
                adapter.plug_in()
            await log.wait("open at", times=4)
            assert await adapter.pc.ask(b"C2\r") == POSITION
            assert not task.done()

    asyncio.run(talk())


def test_half_a_command_does_not_outlive_the_plug(
    link: SerialLink, adapter: Adapter, running: Running, log: Any
) -> None:
    async def talk() -> None:
        adapter.plug_in()
        async with running(link):
            await log.wait("open at")
            assert await adapter.pc.ask(b"C2\rW300 0") == POSITION
            adapter.unplug()
            await log.wait(" lost: ")
            adapter.plug_in()
            await log.wait("open at", times=2)
            assert await adapter.pc.ask(b"80\r") == b"?>\r\n"

    asyncio.run(talk())


def test_what_is_no_port_at_all_is_waited_for_too(
    wire: Wire, running: Running, log: Any, bench: Any, tmp_path: Path
) -> None:
    async def talk() -> None:
        async with running(SerialLink(wire, f"nonsense://{tmp_path}", 9600, bench.gs232, retry_s=RETRY_S)):
            await log.wait("cannot be opened")
            assert wire.state == "waiting for it"

    asyncio.run(talk())


# --- URLs


def test_a_socket_is_a_port_and_comes_back_like_one(wire: Wire, bench: Any, running: Running, log: Any) -> None:
    """ser2net in raw mode: a descriptor, but no terminal."""

    async def talk() -> None:
        events = asyncio.get_running_loop()
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.setblocking(False)
            url = f"socket://127.0.0.1:{server.getsockname()[1]}"
            async with running(SerialLink(wire, url, 9600, bench.gs232, retry_s=RETRY_S)):
                for count in (1, 2):
                    far_end, _ = await asyncio.wait_for(events.sock_accept(server), PATIENCE_S)
                    with far_end:
                        await log.wait("open at", times=count)
                        await events.sock_sendall(far_end, b"C2\r")
                        assert await asyncio.wait_for(events.sock_recv(far_end, 99), PATIENCE_S) == POSITION
                    await log.wait(" lost: hung up", times=count)

    asyncio.run(talk())


class Lender:
    """A serial port lent over the network (RFC 2217), as by ser2net: pyserial's own server, and a program behind it."""

    def __init__(self) -> None:
        self._server = socket.create_server(("127.0.0.1", 0))
        self._server.settimeout(PATIENCE_S)
        self.url = f"rfc2217://127.0.0.1:{self._server.getsockname()[1]}"
        self._heard: queue.Queue[bytes] = queue.Queue()
        self._thread = threading.Thread(target=self._lend, name="lender")
        self._thread.start()

    def _lend(self) -> None:
        with suppress(OSError), serial.serial_for_url("loop://") as device:
            self._client, _ = self._server.accept()
            self._manager = PortManager(device, self)
            while data := self._client.recv(1024):
                for byte in self._manager.filter(data):
                    self._heard.put(byte)

    def write(self, data: bytes) -> None:
        """For the manager's own talk with the client."""
        self._client.sendall(data)

    def ask(self, data: bytes, length: int) -> bytes:
        self._client.sendall(b"".join(self._manager.escape(data)))
        return b"".join(self._heard.get(timeout=PATIENCE_S) for _ in range(length))

    def hang_up(self) -> None:
        with suppress(OSError):
            self._client.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        self.hang_up()
        self._thread.join(PATIENCE_S)
        self._client.close()
        self._server.close()


# pyserial 3.5 starts its thread in a way that Python 3.10 has deprecated.
@pytest.mark.filterwarnings("ignore:setDaemon:DeprecationWarning", "ignore:setName:DeprecationWarning")
def test_a_port_without_a_descriptor(wire: Wire, bench: Any, running: Running, log: Any) -> None:
    async def talk() -> None:
        with closing(Lender()) as lender:
            async with running(SerialLink(wire, lender.url, 9600, bench.gs232, retry_s=RETRY_S)):
                await log.wait("open at")
                for _ in range(20):
                    assert await asyncio.to_thread(lender.ask, b"C2\r", len(POSITION)) == POSITION
                assert await asyncio.to_thread(lender.ask, b"\xffQ\r", 4) == b"?>\r\n"
                assert wire.last_out.endswith(b"?>\r\n")
                lender.hang_up()
                await log.wait(" lost: ")

    asyncio.run(talk())


def test_a_port_without_a_descriptor_is_let_go_of_quietly(wire: Wire, bench: Any, running: Running, log: Any) -> None:
    """Its thread ends after the event loop that it reported to."""

    async def talk() -> None:
        async with running(SerialLink(wire, "loop://", 9600, bench.gs232, retry_s=RETRY_S)):
            await log.wait("open at")

    asyncio.run(talk())
    for thread in threading.enumerate():
        if thread.name == wire.name:
            thread.join(PATIENCE_S)
