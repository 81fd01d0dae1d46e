"""The browsers that watch the bytes of the links.

Knows the WebSocket. A browser that is slow misses lines and is told how many; one that takes none is dropped. Does not
know how the lines come about.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable

from aiohttp import web

from rotator.web.wires import WireLog

MOST_AT_ONCE = 200
EVERY_S = 0.2
TAKES_S = 15.0
"""A browser that takes a message in no less than this is dropped."""
MOST_WATCHERS = 8
MESSAGES = """The box sends, as soon as there are new lines:

    {"lines": ["…", "…"], "upto": 480, "missed": 0}

`lines` are as `rotator monitor` prints them, the oldest first. `upto` is the number of the line after them: after a
lost connection ask for `?after=480`. `missed`: so many lines before these are gone. You send
nothing: the box closes then.
"""


class WireWatch:
    """The browsers that watch. `may_look` is asked at each message: a browser may be paired no more."""

    def __init__(self, wires: WireLog) -> None:
        self._wires = wires
        self._watchers = 0

    @property
    def is_full(self) -> bool:
        return self._watchers >= MOST_WATCHERS

    async def serve(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        """Until the browser leaves, or may look no more. `upto`: it has seen the lines before this one; None: none."""
        self._watchers += 1
        sender = asyncio.create_task(self._send(socket, upto, may_look), name="page: wires")
        try:
            async for _ in socket:
                return  # it has nothing to say
        finally:
            sender.cancel()
            await asyncio.gather(sender, return_exceptions=True)
            self._watchers -= 1

    async def _send(self, socket: web.WebSocketResponse, upto: int | None, may_look: Callable[[], bool]) -> None:
        try:
            while not socket.closed:
                if not may_look():
                    await socket.close()
                    return
                new = self._wires.after(upto or 0, MOST_AT_ONCE)
                if new.lines or upto is None:
                    # What was there before it came, it has not missed.
                    missed = 0 if upto is None else new.missed
                    async with asyncio.timeout(TAKES_S):
                        await socket.send_str(json.dumps({"lines": new.lines, "upto": new.upto, "missed": missed}))
                    upto = new.upto
                if len(new.lines) < MOST_AT_ONCE:
                    await asyncio.sleep(EVERY_S)
        except (TimeoutError, ConnectionError, RuntimeError):
            # It takes nothing, or has gone. Its reader ends with the transport.
            if (transport := socket.get_extra_info("transport")) is not None:
                transport.abort()
