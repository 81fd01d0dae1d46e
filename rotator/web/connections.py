"""The connections of the page: how many at a time, and which one is closed when it hangs or a new one needs its place.

Knows transports and times. A connection that sends no request, or reads no answer, is closed. So a flood of half-open
connections cannot block a STOP. Does not know the requests: `begin` and `end` tell when they come and go.
"""

from __future__ import annotations

import asyncio
import ipaddress
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import cast

MOST = 256
SILENT_S = 8.0
"""Seconds that a connection may stay without a request, also at its beginning."""
ANSWER_S = 20.0
"""Seconds that an answer may take, including the time to read it."""
LOOK_S = 1.0
YOUNG_S = 1.0
"""Seconds: a younger connection is closed last, because its request is on its way."""
UNREAD_BYTES = 32_768


@dataclass(slots=True, eq=False)
class _Open:
    transport: asyncio.Transport
    host: str
    opened_s: float
    since_s: float
    asks: bool = False
    live: bool = False
    """The connection is a WebSocket that shows the antenna live, and has no time limit."""


def machine(address: str) -> str:
    """The name of one machine. For IPv6 its network of 64 bits, in which a machine chooses its addresses freely."""
    try:
        ip = ipaddress.ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if ip.version == 4:
        return str(ip)
    return str(ip.ipv4_mapped or ipaddress.ip_network((int(ip) >> 64 << 64, 64)))


class Connections:
    """`lets_in`: whether a machine with this address may connect. `clock` gives seconds."""

    def __init__(self, lets_in: Callable[[str], bool], clock: Callable[[], float]) -> None:
        self._lets_in = lets_in
        self._clock = clock
        self._open: dict[asyncio.BaseTransport, _Open] = {}

    def __len__(self) -> int:
        return len(self._open)

    async def watch(self) -> None:
        """Close connections that hang, until cancelled."""
        while True:
            await asyncio.sleep(LOOK_S)
            self.look()

    def look(self) -> None:
        now_s = self._clock()
        for connection in list(self._open.values()):
            if not connection.live and now_s - connection.since_s > (ANSWER_S if connection.asks else SILENT_S):
                self._drop(connection)

    def admit(self, transport: asyncio.Transport) -> bool:
        """Take a new connection. If all places are taken, another one is closed."""
        peer = transport.get_extra_info("peername")
        host = str(peer[0]) if peer else ""
        if not self._lets_in(host):
            return False
        if len(self._open) >= MOST:
            self._drop(self._least_needed())
        transport.set_write_buffer_limits(high=UNREAD_BYTES)
        now_s = self._clock()
        self._open[transport] = _Open(transport, machine(host), now_s, now_s)
        return True

    def _least_needed(self) -> _Open:
        """The oldest connection of the machine with the most connections. Live ones, and those whose request may be on
        its way, come last.

        Otherwise many machines with one connection each would push out a person with two.
        """
        young_s = self._clock() - YOUNG_S
        still = [connection for connection in self._open.values() if not connection.live] or list(self._open.values())
        found = [connection for connection in still if connection.opened_s <= young_s] or still
        most, _ = Counter(connection.host for connection in found).most_common(1)[0]
        return min((each for each in found if each.host == most), key=lambda each: (each.asks, each.since_s))

    def begin(self, transport: asyncio.BaseTransport | None) -> None:
        """A request has come."""
        self._note(transport, asks=True)

    def end(self, transport: asyncio.BaseTransport | None) -> None:
        """The answer to the request is being sent."""
        self._note(transport, asks=False)

    def live(self, transport: asyncio.BaseTransport | None) -> None:
        """The connection has become a WebSocket, which has its own rules."""
        if transport is not None and (connection := self._open.get(transport)) is not None:
            connection.live = True

    def forget(self, transport: asyncio.BaseTransport) -> None:
        self._open.pop(transport, None)

    def drop_all(self) -> None:
        for connection in list(self._open.values()):
            self._drop(connection)

    def _note(self, transport: asyncio.BaseTransport | None, *, asks: bool) -> None:
        if transport is not None and (connection := self._open.get(transport)) is not None:
            connection.asks, connection.since_s = asks, self._clock()

    def _drop(self, connection: _Open) -> None:
        self._open.pop(connection.transport, None)
        connection.transport.abort()


class Connection(asyncio.Protocol):
    """Stands in front of the HTTP library's protocol, and passes everything on after it is admitted."""

    def __init__(self, connections: Connections, inner: asyncio.Protocol) -> None:
        self._connections = connections
        self._inner = inner
        self._transport: asyncio.Transport | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        made = cast(asyncio.Transport, transport)
        if not self._connections.admit(made):
            made.abort()
            return
        self._transport = made
        self._inner.connection_made(transport)

    def data_received(self, data: bytes) -> None:
        if self._transport is not None:
            self._inner.data_received(data)

    def eof_received(self) -> bool | None:
        return self._inner.eof_received() if self._transport is not None else None

    def pause_writing(self) -> None:
        self._inner.pause_writing()

    def resume_writing(self) -> None:
        self._inner.resume_writing()

    def connection_lost(self, exc: Exception | None) -> None:
        if self._transport is not None:
            self._connections.forget(self._transport)
            self._inner.connection_lost(exc)
