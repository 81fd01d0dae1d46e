"""URLs that pyserial opens in place of a port: a socket, a port lent over the network, and one without a descriptor."""

from __future__ import annotations

import asyncio
import queue
import socket
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack, closing, suppress
from typing import Any, cast

import pytest
import serial
from serial.rfc2217 import PortManager

from rotator.links.serial import SerialLink
from rotator.links.wire import Wire

PATIENCE_S = 30.0
RETRY_S = 0.01
POSITION = b"AZ=235  EL=025\r\n"
Running = Callable[[SerialLink], Any]


async def test_a_socket_is_a_port_and_comes_back_like_one(wire: Wire, bench: Any, running: Running, log: Any) -> None:
    """ser2net in raw mode: a descriptor, but no terminal."""

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
            self._manager = PortManager(cast(Any, device), cast(Any, self))
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


# pyserial 3.5 starts its thread in a way that Python 3.10 has deprecated, and leaves a socket open when nobody answers.
@pytest.mark.filterwarnings(
    "ignore:setDaemon:DeprecationWarning",
    "ignore:setName:DeprecationWarning",
    "ignore::pytest.PytestUnraisableExceptionWarning",
)
async def test_a_port_without_a_descriptor(wire: Wire, bench: Any, running: Running, log: Any) -> None:
    with closing(Lender()) as lender:
        async with running(SerialLink(wire, lender.url, 9600, bench.gs232, retry_s=RETRY_S)):
            await log.wait("open at")
            for _ in range(20):
                assert await asyncio.to_thread(lender.ask, b"C2\r", len(POSITION)) == POSITION
            assert await asyncio.to_thread(lender.ask, b"\xffQ\r", 4) == b"?>\r\n"
            lender.hang_up()
            await log.wait(" lost: ")


async def test_a_port_without_a_descriptor_is_let_go_of_quietly(
    wire: Wire, bench: Any, running: Running, log: Any
) -> None:
    """Its thread ends after the event loop that it reported to."""

    async with running(SerialLink(wire, "loop://", 9600, bench.gs232, retry_s=RETRY_S)):
        await log.wait("open at")
    for thread in threading.enumerate():
        if thread.name == wire.name:
            thread.join(PATIENCE_S)


@pytest.mark.parametrize(
    "url", ["hwgrep://(", "loop://?logging=nonsense", "alt://x?class=Nonsense", "rfc2217://", "no://"]
)
async def test_a_url_that_pyserial_cannot_use_is_waited_for_like_a_port(
    wire: Wire, new_ear: type[Any], running: Running, log: Any, url: str
) -> None:
    """A handler of pyserial may raise any exception. None of them may end the box."""

    async with running(SerialLink(wire, url, 9600, new_ear, retry_s=RETRY_S)):
        await log.wait(f"link: {url} cannot be opened: ")
        assert wire.state == "waiting for it"
    assert log.count("waiting for it") == 1


def test_a_machine_that_does_not_answer_holds_up_no_end(wire: Wire, new_ear: type[Any]) -> None:
    """Its packets are lost: pyserial waits five seconds for a connection."""
    with closing(socket.socket()) as full, ExitStack() as queue_of_it:
        full.bind(("127.0.0.1", 0))
        full.listen(0)
        for _ in range(4):
            waiting = queue_of_it.enter_context(closing(socket.socket()))
            waiting.setblocking(False)
            waiting.connect_ex(full.getsockname())

        async def talk() -> float:
            link = asyncio.create_task(
                SerialLink(wire, f"socket://127.0.0.1:{full.getsockname()[1]}", 9600, new_ear).run()
            )
            await asyncio.sleep(0)
            link.cancel()
            await asyncio.gather(link, return_exceptions=True)
            return time.monotonic()

        cancelled_s = asyncio.run(talk())
        assert time.monotonic() - cancelled_s < 1.0
