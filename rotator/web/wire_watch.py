"""The browsers that watch the bytes of the links.

Knows the WebSocket. A slow browser misses lines and gets their number; a browser that takes no line is dropped. Does
not know how the lines are made.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable

from aiohttp import web

from rotator.web.slow_reader import dropped_if_slow
from rotator.web.wires import WireLog

MOST_AT_ONCE = 200
EVERY_S = 0.2
TAKES_S = 15.0
"""Seconds: a browser that needs longer to take a message is dropped."""
MOST_WATCHERS = 8
MESSAGES = """The box sends, as soon as there are new lines:

    {"lines": ["…", "…"], "upto": 480, "missed": 0}

`lines` are as `rotator monitor` prints them, the oldest first. `upto` is the number of the line after them: after a
lost connection ask for `?after=480`. `missed`: so many lines before these are gone. You send
nothing: the box closes then.
"""


class WireWatch:
    """The browsers that watch. `may_look` is called before each message, because a pairing may have ended."""

    def __init__(self, wires: WireLog) -> None:
        self._wires = wires
        self._watchers = 0

    @property
    def is_full(self) -> bool:
        return self._watchers >= MOST_WATCHERS

    async def serve(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        """Serve until the browser leaves or loses its right to look. `upto`: number of its next line; None: all."""
        self._watchers += 1
        sender = asyncio.create_task(self._send(socket, upto, may_look), name="page: wires")
        try:
            async for _ in socket:
                return  # the page never sends a message here
        finally:
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)
            self._watchers -= 1

    async def _send(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        with dropped_if_slow(socket):
            while not socket.closed:
                if not may_look():
                    await socket.close()
                    return
                new = self._wires.after(upto or 0, MOST_AT_ONCE)
                if new.lines or upto is None:
                    # Lines from before its connection do not count as missed.
                    missed = 0 if upto is None else new.missed
                    async with asyncio.timeout(TAKES_S):
                        await socket.send_str(json.dumps({"lines": new.lines, "upto": new.upto, "missed": missed}))
                    upto = new.upto
                if len(new.lines) < MOST_AT_ONCE:
                    await asyncio.sleep(EVERY_S)
