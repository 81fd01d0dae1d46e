"""Gives this box's elements to other boxes, so that one box asks the network for all: a plain GET, read-only.

Knows HTTP, by aiohttp, and which machines may ask. Does not know what elements mean; the other box checks that.
`routes` are for any server of aiohttp.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import logging
import time
from collections.abc import Awaitable, Callable, Sequence

from aiohttp import ETag, web

from rotator.links.listening import Allowed, cannot_listen
from rotator.orbits import omm
from rotator.orbits.elements import Elements

log = logging.getLogger(__name__)

PATH = "/elements"
Known = Callable[[], Sequence[Elements] | None]
"""The newest elements of each satellite: the same object until one is new. None: nothing has been read yet."""
ROWS_AT_ONCE, PAUSE_S = 10, 0.001
LOOK_S, MOST_LOOKS = 0.1, 100
"""Seconds: longest wait for an answer. A box that has just started still reads its files."""
MOST_CLIENTS = 16
KEPT_S = 5.0
"""Seconds: a connection without a further request is closed after this time."""


class ElementsServer:
    """Without its port the box still runs, and the log has the reason."""

    def __init__(self, host: str, port: int, known: Known, *, allowed: Allowed) -> None:
        self._host = host
        self._port = port
        self._allowed = allowed
        self._app = web.Application(middlewares=[self._only_allowed])
        self._app.add_routes(routes(known))
        self.where: tuple[str, int] | None = None
        """The address at which it listens; None: it does not listen."""

    async def run(self) -> None:
        """Serve until cancelled."""
        runner = web.AppRunner(self._app, access_log=None, keepalive_timeout=KEPT_S, shutdown_timeout=0.1)
        await runner.setup()
        assert runner.server is not None, "after setup there is one"
        asked = runner.server

        def new() -> asyncio.BaseProtocol:
            return asked() if len(asked.connections) < MOST_CLIENTS else _TurnedAway()

        try:
            loop = asyncio.get_running_loop()
            server = await loop.create_server(new, self._host, self._port, reuse_address=True)
        except (OSError, UnicodeError) as fault:
            log.error("[sky] serve: %s", cannot_listen(fault, self._host, self._port))
            await runner.cleanup()
            return
        self.where = server.sockets[0].getsockname()[:2]
        log.info("other boxes may fetch its elements: http://%s:%d%s", self._host, self._port, PATH)
        try:
            await asyncio.Event().wait()
        finally:
            self.where = None
            server.close()
            await runner.cleanup()

    @web.middleware
    async def _only_allowed(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        if not self._allowed(request.remote or ""):
            raise web.HTTPForbidden(text="not in allow\n")
        return await handler(request)


class _TurnedAway(asyncio.Protocol):
    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        if isinstance(transport, asyncio.Transport):
            transport.abort()


class _Answer:
    """The elements as OMM, made once for all clients, and again when they change."""

    def __init__(self, known: Known) -> None:
        self._known = known
        self._made_of: Sequence[Elements] | None = None
        self._body = b""
        self._etag = ETag("")
        self._making = asyncio.Lock()

    async def made(self) -> tuple[bytes, ETag]:
        """Raises HTTPServiceUnavailable."""
        looks = 0
        while (newest := self._known()) is None and looks < MOST_LOOKS:
            looks += 1
            await asyncio.sleep(LOOK_S)
        if not newest:
            raise web.HTTPServiceUnavailable(text="this box has no elements yet\n")
        async with self._making:
            if newest is not self._made_of:
                self._body = await asyncio.to_thread(_body, newest)
                self._etag = ETag(hashlib.sha256(self._body).hexdigest()[:32])
                self._made_of = newest
            return self._body, self._etag


def _body(elements: Sequence[Elements]) -> bytes:
    """The answer, made with pauses: the threads of the motors need the same interpreter."""
    rows = []
    for number, each in enumerate(elements):
        rows.append(json.dumps(omm.message(each)).encode())
        if number % ROWS_AT_ONCE == 0:
            time.sleep(PAUSE_S)
    return b"[\n" + b",\n".join(rows) + b"\n]\n"


def routes(known: Known) -> list[web.RouteDef]:
    """`/elements`: the newest elements of each satellite, as OMM."""
    answer = _Answer(known)

    async def elements(request: web.Request) -> web.StreamResponse:
        body, etag = await answer.made()
        has = any(each.value in (etag.value, "*") for each in request.if_none_match or ())
        response = web.Response(status=304) if has else web.Response(body=body, content_type="application/json")
        response.etag = etag
        return response

    return [web.get(PATH, elements)]
