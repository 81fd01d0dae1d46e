"""The console's socket: several users at a time, each with a conversation of its own.

Knows its place, and what happens when there can be no console. Knows no words and decides nothing.
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


def console_path(monitor: Path) -> Path:
    """The console's path, given the monitor's: beside it, and with another name for each monitor's name."""
    return monitor.with_name("console" if monitor.name == "monitor" else f"{monitor.name}-console")


class ConsoleSocket:
    """`session` makes the conversation of one connection.

    A new user is always let in, because the word may be `stop`: the user who has been silent longest makes room. The
    box runs without a console too: where the socket cannot be opened, there is a line in the log.
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
            log.warning("%s: another box has it; this one has no console", self._path)
        except OSError as fault:
            log.warning("%s: there can be no console: %s", self._path, reason(fault))
