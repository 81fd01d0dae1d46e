"""The clients of a listening stream socket, TCP or Unix: each client has a separate conversation.

Knows how many clients may connect, and when a client is refused or dropped. Does not know the socket's address, which
machines are allowed, or what the bytes mean.
"""

from __future__ import annotations

import asyncio
import logging
import re
import socket
import time
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from typing import cast

from rotator.links.wire import Conversation, Wire
from rotator.protocols.session import Addressed, Session
from rotator.runtime.log_limit import LogLimit

log = logging.getLogger(__name__)

UNREAD_LIMIT = 65_536
"""Most bytes of replies that may wait for one client. A client that reads nothing is dropped at this limit."""
READ_BYTES = 512
"""Most bytes read from one client in one turn, so that a flood of commands cannot delay another client's stop."""

GONE_AFTER_S = (5, 2, 3)
"""Seconds of silence before a client is asked for a sign of life; seconds between two questions; their number. A client
that has lost power or network does not close its connection; its jog ends 11 s later."""
_BROWSER = re.compile(rb"(?:GET|HEAD|POST|PUT|PATCH|DELETE|OPTIONS|CONNECT|TRACE) |\x16\x03")
"""The first word of a request, or the greeting of https: no protocol but `pstrotatoraz`, which judges requests itself,
begins like this."""
LONGEST = len(b"OPTIONS ")


class Beginning:
    """The first bytes of one connection, in any pieces: any web site can let the browsers that show it send bytes to a
    port, with a whole order in the body, and a browser in the network is allowed to connect."""

    def __init__(self) -> None:
        self._bytes = b""

    def is_a_browsers(self, data: bytes) -> bool:
        """Take the next bytes. Returns whether the connection has begun as a browser's does."""
        if len(self._bytes) < LONGEST:
            self._bytes += data[: LONGEST - len(self._bytes)]
        return _BROWSER.match(self._bytes) is not None


@dataclass(eq=False)
class Clients:
    """`session` makes the protocol's side of a new connection.

    `allowed` takes a machine's address and returns whether that machine may connect. When `most` clients are connected,
    a new client is refused. With `makes_room` the new client is accepted, and the client that has been silent longest
    is dropped. A browser's connection is ended before its bytes are read, unless the protocol `speaks_http`.
    """

    wire: Wire
    session: Callable[[], Session]
    most: int
    _: KW_ONLY
    allowed: Callable[[str], bool] = lambda _host: True
    makes_room: bool = False
    speaks_http: bool = False
    _connected: dict[_Client, None] = field(default_factory=dict, init=False)
    """In the order of their last bytes: the client that has been silent longest comes first."""
    _complaints: LogLimit = field(default_factory=lambda: LogLimit(time.monotonic), init=False)

    def __len__(self) -> int:
        return len(self._connected)

    def new(self) -> asyncio.BufferedProtocol:
        """The protocol of a new connection, for asyncio's `create_server`."""
        return _Client(self)

    def drop_all(self) -> None:
        connected, self._connected = self._connected, {}
        for client in connected:
            client.drop()

    def admit(self, client: _Client, host: str) -> bool:
        """Accept or refuse a client that has just connected. Returns whether it is accepted."""
        if not self.allowed(host):
            self.complain(f"{host} is not in allow: turned away")
            return False
        if len(self._connected) >= self.most:
            if not self.makes_room:
                self.complain(f"{self.most} clients already, one more is turned away")
                return False
            silent = next(iter(self._connected))
            del self._connected[silent]
            silent.drop()
        self._connected[client] = None
        self._show_count()
        return True

    def heard(self, client: _Client) -> bool:
        """Note that a client has sent bytes. Returns False for a client that has been dropped."""
        if client not in self._connected:
            return False
        del self._connected[client]
        self._connected[client] = None
        return True

    def forget(self, client: _Client) -> None:
        if client in self._connected:
            del self._connected[client]
            self._show_count()

    def complain(self, text: str) -> None:
        if line := self._complaints.admit(text):
            log.warning("%s: %s", self.wire.name, line)

    def _show_count(self) -> None:
        count = len(self._connected)
        self.wire.state = f"{count} client{'s' if count != 1 else ''}" if count else "listening"


class _Client(asyncio.BufferedProtocol):
    def __init__(self, clients: Clients) -> None:
        self._clients = clients
        self._buffer = bytearray(READ_BYTES)
        self._transport: asyncio.Transport | None = None
        self._conversation: Conversation | None = None
        self._beginning = Beginning()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast(asyncio.Transport, transport)
        peer = self._transport.get_extra_info("peername")  # of a Unix socket: an empty text
        host = str(peer[0]) if peer else ""
        if not self._clients.admit(self, host):
            self._transport.abort()
            return
        _watch(self._transport.get_extra_info("socket"))
        clients = self._clients
        session = clients.session()
        if host and isinstance(session, Addressed):
            session.comes_from(host)
        self._conversation = Conversation(session, clients.wire, self._write, self._transport.close)

    def get_buffer(self, sizehint: int) -> bytearray:
        return self._buffer

    def buffer_updated(self, nbytes: int) -> None:
        if self._conversation is None or not self._clients.heard(self):
            return
        data = bytes(self._buffer[:nbytes])
        if not self._clients.speaks_http and self._beginning.is_a_browsers(data):
            self._clients.complain("a browser speaks HTTP here, a web site in it perhaps: turned away")
            self.drop()
            return
        self._conversation.received(data)

    def eof_received(self) -> None:
        if self._conversation is not None and self._clients.heard(self):
            self._conversation.finish()

    def connection_lost(self, exc: Exception | None) -> None:
        if self._conversation is not None:
            self._conversation.close()
        self._clients.forget(self)

    def drop(self) -> None:
        if self._transport is not None:
            self._transport.abort()

    def _write(self, data: bytes) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        if self._transport.get_write_buffer_size() + len(data) > UNREAD_LIMIT:
            self._clients.complain("a client reads nothing: dropped")
            self._transport.abort()
            return
        self._transport.write(data)


def _watch(client: socket.socket) -> None:
    """Let the kernel notice a TCP client that has lost power or network. A Unix socket's client cannot."""
    if client.family not in (socket.AF_INET, socket.AF_INET6):
        return
    silent_s, every_s, times = GONE_AFTER_S
    client.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, silent_s)
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, every_s)
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPCNT, times)
    # The same for answers on their way, which suspend the questions above.
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, 1000 * (silent_s + every_s * times))
