"""The console's socket: several people at a time, each with a conversation of its own.

Knows Unix sockets, and clients that are too many, or do not read. Knows no words and decides nothing.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from pathlib import Path
from typing import cast

from rotator.links.unix import claimed
from rotator.links.wire import Conversation, Wire, reason
from rotator.protocols.session import Session

log = logging.getLogger(__name__)

MOST_CLIENTS = 32
UNREAD_LIMIT = 65_536
"""A client that reads nothing is dropped once this many bytes wait for it."""
READ_BYTES = 512
"""Taken from one client before the others have their turn."""


def console_path(monitor: Path) -> Path:
    """Where the console is, given where the monitor is: beside it, and with a name of its own for each monitor's."""
    return monitor.with_name("console" if monitor.name == "monitor" else f"{monitor.name}-console")


class ConsoleSocket:
    """`session` makes the conversation of one connection.

    It may not keep the box from running: where it cannot be opened the log says so, and that is all.
    """

    def __init__(self, path: Path, session: Callable[[], Session]) -> None:
        self.wire = Wire("console", "console", str(path))
        self.session = session
        self.clients: dict[_Client, None] = {}
        """The one that has been silent longest comes first."""
        self._path = path

    async def run(self) -> None:
        try:
            with claimed(self._path) as place:
                server = await asyncio.get_running_loop().create_unix_server(lambda: _Client(self), sock=place)
                self.wire.state = "listening"
                try:
                    await asyncio.Event().wait()
                finally:
                    server.close()
                    for client in list(self.clients):
                        client.drop()
                    self.wire.state = "closed"
        except BlockingIOError:
            log.warning("%s: another box has it; this one has no console", self._path)
        except OSError as fault:
            log.warning("%s: there can be no console: %s", self._path, reason(fault))

    def enter(self, client: _Client) -> None:
        """Whoever comes is let in, for it may be to stop the antenna: the one that is silent longest makes room."""
        if len(self.clients) >= MOST_CLIENTS:
            silent = next(iter(self.clients))
            del self.clients[silent]
            silent.drop()
        self.clients[client] = None


class _Client(asyncio.BufferedProtocol):
    def __init__(self, console: ConsoleSocket) -> None:
        self._console = console
        self._buffer = bytearray(READ_BYTES)
        self._transport: asyncio.Transport | None = None
        self._conversation: Conversation | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast(asyncio.Transport, transport)
        console = self._console
        self._conversation = Conversation(console.session(), console.wire, self._write, self._transport.close)
        console.enter(self)

    def get_buffer(self, sizehint: int) -> bytearray:
        return self._buffer

    def buffer_updated(self, nbytes: int) -> None:
        if self._conversation is None or self not in self._console.clients:
            return
        del self._console.clients[self]
        self._console.clients[self] = None
        self._conversation.received(bytes(self._buffer[:nbytes]))

    def connection_lost(self, exc: Exception | None) -> None:
        if self._conversation is not None:
            self._conversation.close()
        self._console.clients.pop(self, None)

    def drop(self) -> None:
        if self._transport is not None:
            self._transport.abort()

    def _write(self, data: bytes) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        if self._transport.get_write_buffer_size() + len(data) > UNREAD_LIMIT:
            log.warning("console: a client reads nothing: dropped")
            self._transport.abort()
            return
        self._transport.write(data)
