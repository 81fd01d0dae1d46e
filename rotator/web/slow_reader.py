"""Drops a browser that takes no message of a WebSocket, or has gone.

Knows the WebSocket. Does not know the messages, nor how long a browser may need for one.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from aiohttp import web


@contextmanager
def dropped_if_slow(socket: web.WebSocketResponse) -> Iterator[None]:
    """While messages are sent within this context, a timeout or a lost connection ends the transport.

    The task that reads from the browser ends with the transport.
    """
    try:
        yield
    except (TimeoutError, ConnectionError, RuntimeError):
        if (transport := socket.get_extra_info("transport")) is not None:
            transport.abort()
