"""A listening socket: any number of clients up to a limit, each with a conversation of its own.

Knows connections. Knows no protocol and decides nothing.
"""

from __future__ import annotations

import asyncio
import logging
import os
import socket
from collections.abc import Callable
from typing import cast

from rotator.links.wire import Conversation, LinkError, Wire
from rotator.protocols.session import Session

log = logging.getLogger(__name__)

MOST_CLIENTS = 128
UNREAD_LIMIT = 65_536
"""A client that reads nothing is dropped once this many bytes wait for it."""


class TcpLink:
    def __init__(self, wire: Wire, host: str, port: int, session: Callable[[], Session]) -> None:
        self.wire = wire
        self._host = host
        self._port = port
        self._session = session
        self._clients: set[_Client] = set()
        self._server: asyncio.Server | None = None

    async def open(self) -> None:
        """Raises LinkError."""
        try:
            self._server = await asyncio.get_running_loop().create_server(
                lambda: _Client(self.wire, self._session, self._clients), self._host, self._port, reuse_address=True
            )
        except (OSError, UnicodeError) as fault:
            raise LinkError(f"{self._host}:{self._port}: cannot listen there: {_why(fault)}") from fault
        self.wire.state = "listening"

    async def run(self) -> None:
        assert self._server is not None, "open() comes first"
        try:
            # It serves since it was created; `serve_forever` would wait for its clients before it lets itself be ended.
            await asyncio.Event().wait()
        finally:
            self._server.close()
            for client in list(self._clients):
                client.drop()
            self.wire.state = "closed"


def _why(fault: OSError | UnicodeError) -> str:
    match fault:
        case socket.gaierror():
            return fault.strerror or str(fault)
        case OSError(errno=int() as number):
            # asyncio wraps the system's words in many of its own.
            return os.strerror(number)
        case OSError():
            return str(fault)
        case _:
            return "no machine can have that name"


class _Client(asyncio.Protocol):
    def __init__(self, wire: Wire, session: Callable[[], Session], clients: set[_Client]) -> None:
        self._wire = wire
        self._session = session
        self._clients = clients
        self._transport: asyncio.Transport | None = None
        self._conversation: Conversation | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast(asyncio.Transport, transport)
        if len(self._clients) >= MOST_CLIENTS:
            log.warning("%s: %d clients already, one more is turned away", self._wire.name, MOST_CLIENTS)
            self._transport.abort()
            return
        self._clients.add(self)
        self._conversation = Conversation(self._session(), self._wire, self._write, self._transport.close)
        self._note()

    def data_received(self, data: bytes) -> None:
        if self._conversation is not None:
            self._conversation.received(data)

    def connection_lost(self, exc: Exception | None) -> None:
        if self._conversation is not None:
            self._conversation.close()
        self._clients.discard(self)
        self._note()

    def drop(self) -> None:
        if self._transport is not None:
            self._transport.abort()

    def _write(self, data: bytes) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        if self._transport.get_write_buffer_size() + len(data) > UNREAD_LIMIT:
            log.warning("%s: a client reads nothing: dropped", self._wire.name)
            self._transport.abort()
            return
        self._transport.write(data)

    def _note(self) -> None:
        count = len(self._clients)
        self._wire.state = f"{count} client{'s' if count != 1 else ''}" if count else "listening"
