"""A listening TCP socket.

Knows the socket's address, and which machines may connect. Does not know what the bytes mean. The rules for the
connected clients are in `stream`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from rotator.links.listening import Allowed, cannot_listen
from rotator.links.stream import Clients
from rotator.links.wire import LinkError, Wire
from rotator.protocols.session import Session

MOST_CLIENTS = 128


class TcpLink:
    """`session` makes the protocol's side of a new connection. `speaks_http`: browsers may connect."""

    def __init__(
        self,
        wire: Wire,
        host: str,
        port: int,
        session: Callable[[], Session],
        *,
        allowed: Allowed = Allowed(),  # noqa: B008 - it never changes
        most_clients: int = MOST_CLIENTS,
        speaks_http: bool = False,
    ) -> None:
        self.wire = wire
        self._host = host
        self._port = port
        self._clients = Clients(wire, session, most_clients, allowed=allowed, speaks_http=speaks_http)
        self._server: asyncio.Server | None = None

    async def open(self) -> None:
        """Raises LinkError."""
        try:
            self._server = await asyncio.get_running_loop().create_server(
                self._clients.new, self._host, self._port, reuse_address=True
            )
        except (OSError, UnicodeError) as fault:
            raise LinkError(cannot_listen(fault, self._host, self._port)) from fault
        self.wire.state = "listening"

    async def run(self) -> None:
        assert self._server is not None, "open() comes first"
        try:
            # The server already works. `serve_forever` is not used: on the way out it would wait for its clients.
            await asyncio.Event().wait()
        finally:
            self.close()

    def close(self) -> None:
        """Stop listening, and drop all clients. May be called twice."""
        if self._server is not None:
            self._server.close()
        self._clients.drop_all()
        self.wire.state = "closed"
