"""The monitor's Unix socket: each connected watcher receives the transcript's lines as they are made.

Knows how many watchers may connect, and what to do when one reads too slowly. Ignores what a watcher sends. Does not
know what the lines mean.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from pathlib import Path
from typing import cast

from rotator.links.unix import claimed
from rotator.links.wire import reason

log = logging.getLogger(__name__)

MOST_WATCHERS = 8
UNREAD_LIMIT = 262_144
"""Most bytes that may wait for one watcher. Further lines are left out, and a remark gives their number."""


class MonitorSocket:
    """`greeting` returns the first lines for a new watcher. `listeners` holds a callback for each connected watcher.

    Without its socket the box still runs, and the log has the reason.
    """

    def __init__(self, path: Path, listeners: list[Callable[[str], None]], greeting: Callable[[], list[str]]) -> None:
        self._path = path
        self._listeners = listeners
        self._greeting = greeting
        self._watchers: set[_Watcher] = set()

    async def run(self) -> None:
        try:
            with claimed(self._path) as place:
                server = await asyncio.get_running_loop().create_unix_server(self._watcher, sock=place)
                try:
                    await asyncio.Event().wait()
                finally:
                    server.close()
                    for watcher in list(self._watchers):
                        watcher.drop()
        except BlockingIOError:
            log.warning("%s: another box uses it; this one cannot be monitored", self._path)
        except OSError as fault:
            log.warning("%s: cannot be monitored there: %s", self._path, reason(fault))

    def _watcher(self) -> _Watcher:
        return _Watcher(self._listeners, self._greeting, self._watchers)


class _Watcher(asyncio.Protocol):
    def __init__(
        self, listeners: list[Callable[[str], None]], greeting: Callable[[], list[str]], watchers: set[_Watcher]
    ) -> None:
        self._listeners = listeners
        self._greeting = greeting
        self._watchers = watchers
        self._transport: asyncio.Transport | None = None
        self._missed = 0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        self._transport = cast(asyncio.Transport, transport)
        if len(self._watchers) >= MOST_WATCHERS:
            self._transport.write(f"# {MOST_WATCHERS} are watching already\n".encode())
            self._transport.close()
            return
        self._watchers.add(self)
        for line in self._greeting():
            self._hear(line)
        self._listeners.append(self._hear)

    def connection_lost(self, exc: Exception | None) -> None:
        self._watchers.discard(self)
        if self._hear in self._listeners:
            self._listeners.remove(self._hear)

    def drop(self) -> None:
        if self._transport is None:
            return
        if self._transport.get_write_buffer_size():
            self._transport.abort()
        else:
            self._transport.close()

    def _hear(self, line: str) -> None:
        if self._transport is None or self._transport.is_closing():
            return
        text = f"# {self._missed} lines left out here: read too slowly\n" if self._missed else ""
        text += line + "\n"
        if self._transport.get_write_buffer_size() + len(text) > UNREAD_LIMIT:
            self._missed += 1
            return
        self._missed = 0
        self._transport.write(text.encode())
