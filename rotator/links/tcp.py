"""A listening socket: any number of clients up to a limit, each with a conversation of its own.

Knows connections. Knows no protocol and decides nothing.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from typing import cast

from rotator.links.allowed import Allowed
from rotator.links.wire import Conversation, LinkError, Wire, reason
from rotator.protocols.session import Session
from rotator.runtime.log_limit import LogLimit

log = logging.getLogger(__name__)

MOST_CLIENTS = 128
UNREAD_LIMIT = 65_536
"""A client that reads nothing is dropped once this many bytes wait for it."""
READ_BYTES = 512
"""Taken from one client before the others have their turn: a flood of commands holds up nobody's stop."""


class TcpLink:
    def __init__(
        self,
        wire: Wire,
        host: str,
        port: int,
        session: Callable[[], Session],
        *,
        allowed: Allowed = Allowed(),  # noqa: B008 - it never changes
        most_clients: int = MOST_CLIENTS,
    ) -> None:
        self.wire = wire
        self.allowed = allowed
        self.most_clients = most_clients
        self.session = session
        self.clients: set[_Client] = set()
        self._host = host
        self._port = port
        self._complaints = LogLimit(time.monotonic)
        self._server: asyncio.Server | None = None

    async def open(self) -> None:
        """Raises LinkError."""
        try:
            self._server = await asyncio.get_running_loop().create_server(
                lambda: _Client(self), self._host, self._port, reuse_address=True
            )
        except (OSError, UnicodeError) as fault:
            raise LinkError(f"{self._host}:{self._port}: cannot listen there: {reason(fault)}") from fault
        self.wire.state = "listening"

    async def run(self) -> None:
        assert self._server is not None, "open() comes first"
        try:
            # It serves since it was created; `serve_forever` would wait for its clients before it lets itself be ended.
            await asyncio.Event().wait()
        finally:
            self.close()

    def close(self) -> None:
        """Listen no longer, and drop all clients. May be called twice."""
        if self._server is not None:
            self._server.close()
        for client in list(self.clients):
            client.drop()
        self.wire.state = "closed"

    def complain(self, text: str) -> None:
        told = self._complaints.tell(text)
        if told:
            log.warning("%s: %s", self.wire.name, told)

    def note(self) -> None:
        count = len(self.clients)
        self.wire.state = f"{count} client{'s' if count != 1 else ''}" if count else "listening"


class _Client(asyncio.BufferedProtocol):
    def __init__(self, link: TcpLink) -> None:
        self._link = link
        self._buffer = bytearray(READ_BYTES)
        self._transport: asyncio.Transport | None = None
        self._conversation: Conversation | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast(asyncio.Transport, transport)
        host = str((self._transport.get_extra_info("peername") or ("",))[0])
        if not self._link.allowed(host):
            self._link.complain(f"{host} is not in allow: turned away")
            self._transport.abort()
            return
        if len(self._link.clients) >= self._link.most_clients:
            self._link.complain(f"{self._link.most_clients} clients already, one more is turned away")
            self._transport.abort()
            return
        self._link.clients.add(self)
        self._conversation = Conversation(self._link.session(), self._link.wire, self._write, self._transport.close)
        self._link.note()

    def get_buffer(self, sizehint: int) -> bytearray:
        return self._buffer

    def buffer_updated(self, nbytes: int) -> None:
        if self._conversation is not None:
            self._conversation.received(bytes(self._buffer[:nbytes]))

    def connection_lost(self, exc: Exception | None) -> None:
        if self._conversation is not None:
            self._conversation.close()
        self._link.clients.discard(self)
        self._link.note()

    def drop(self) -> None:
        if self._transport is not None:
            self._transport.abort()

    def _write(self, data: bytes) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        if self._transport.get_write_buffer_size() + len(data) > UNREAD_LIMIT:
            self._link.complain("a client reads nothing: dropped")
            self._transport.abort()
            return
        self._transport.write(data)
