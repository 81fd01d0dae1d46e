"""The console's Unix socket: each connected user has a separate conversation.

Knows the socket's path, the most users at a time, and what to do when the socket cannot be opened. Does not know the
console's commands.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from pathlib import Path

from rotator.links.stream import Clients
from rotator.links.unix import claimed
from rotator.links.wire import Wire, reason
from rotator.protocols.session import Session

log = logging.getLogger(__name__)

MOST_CLIENTS = 32


class ConsoleSocket:
    """`session` makes the protocol's side of a new connection.

    A new user is always accepted, because the first command may be `stop`: when the socket is full, the user who has
    been silent longest is dropped. Without its socket the box still runs, and the log has the reason.
    """

    def __init__(self, path: Path, session: Callable[[], Session]) -> None:
        self.wire = Wire("console", "console", str(path))
        self.clients = Clients(self.wire, session, MOST_CLIENTS, makes_room=True)
        self._path = path

    async def run(self) -> None:
        try:
            with claimed(self._path) as place:
                server = await asyncio.get_running_loop().create_unix_server(self.clients.new, sock=place)
                self.wire.state = "listening"
                try:
                    await asyncio.Event().wait()
                finally:
                    server.close()
                    self.clients.drop_all()
                    self.wire.state = "closed"
        except BlockingIOError:
            log.warning("%s: another box uses it; this one has no console", self._path)
        except OSError as fault:
            log.warning("%s: there can be no console: %s", self._path, reason(fault))
