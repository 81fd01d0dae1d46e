"""The thread of the page: an event loop of its own, so that no browser delays a link, a stop or the control.

Knows the socket on which the page listens, and how its parts start and end. If the port is taken, it says so and the
box runs without a page; a page that fails while it runs begins anew. Does not know the page.
"""

from __future__ import annotations

import asyncio
import logging
import socket
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Protocol

from rotator.links.listening import cannot_listen
from rotator.links.wire import Wire
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.memory import loading
from rotator.runtime.open_files import say_it_once
from rotator.web.connections import Connection, Connections
from rotator.web.logs import http_logger

if TYPE_CHECKING:
    from rotator.web.api import PageParts
    from rotator.web.pairing import Pairings

log = logging.getLogger(__name__)

PAGE_THREAD = "page"
JOIN_S = 2.0
UNSENT_BYTES = 16_384
KEEP_S = 5.0
AGAIN_S = 1.0
"""Seconds until a page that has failed begins anew: asyncio waits so long for files before it takes a connection."""
WAITING = 128
"""Connections that the kernel keeps until the page takes them."""
AT_ONCE = 16
"""New connections taken at a time. Few, so that in a flood each is read before others need its place."""


class Kept(Protocol):
    """Collects lines for the page, from its start to its end."""

    def keep(self) -> None: ...

    def forget(self) -> None: ...


class PageThread:
    """`build` is called in the thread, because its modules are slow to load. `clock` gives seconds."""

    def __init__(
        self,
        host: str,
        port: int,
        build: Callable[[], PageParts],
        kept: Sequence[Kept],
        clock: Callable[[], float],
        *,
        events: EventWatch,
        rival: str = "",
    ) -> None:
        """`events` shows the control thread whether this thread's event loop runs.

        `rival`: what else of the configuration listens at this port; empty: nothing.
        """
        self._host, self._port, self._rival = host, port, rival
        self._build = build
        self._clock = clock
        self._kept = kept
        self._events = events
        shown = f"[{host}]" if ":" in host else host
        self.wire = Wire("page", "page", f"http://{shown}:{port}")
        self._socket: socket.socket | None = None
        self._thread = threading.Thread(target=self._run, name=PAGE_THREAD, daemon=True)
        self._loop: asyncio.AbstractEventLoop | None = None
        self._stopping = threading.Event()
        self._stop: asyncio.Event | None = None

    def start(self) -> None:
        """Listen, and serve from now on. Raises nothing: without a page the box runs on."""
        try:
            self._socket = self._listening()
        except (OSError, UnicodeError) as fault:
            self.wire.state = "closed"
            log.warning("there is no page: %s", cannot_listen(fault, self._host, self._port, self._rival))
            return
        self.wire.state = "listening"
        for each in self._kept:
            each.keep()
        self._thread.start()

    def _listening(self) -> socket.socket:
        """Raises OSError, UnicodeError."""
        ipv6 = ":" in self._host
        made = socket.create_server(
            (self._host, self._port),
            family=socket.AF_INET6 if ipv6 else socket.AF_INET,
            backlog=WAITING,
            dualstack_ipv6=ipv6 and self._host == "::" and socket.has_dualstack_ipv6(),
        )
        # A slow browser must not get a queue of old pictures.
        made.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, UNSENT_BYTES)
        return made

    def stop(self) -> None:
        """Returns when the thread has ended."""
        self._stopping.set()
        loop, stop = self._loop, self._stop
        if loop is not None and stop is not None:
            with suppress(RuntimeError):  # the page just ended by itself
                loop.call_soon_threadsafe(stop.set)
        if self._thread.is_alive():
            self._thread.join(JOIN_S)
        if self._socket is not None and not self._thread.is_alive():
            self._socket.close()  # a thread that still loads its libraries closes it itself
        for each in self._kept:
            each.forget()
        self.wire.state = "closed"

    def _run(self) -> None:
        said = ""
        while True:
            try:
                self._socket = self._socket or self._listening()
                with asyncio.Runner() as runner:
                    self.wire.state = "listening"
                    runner.run(self._serve(self._socket))
            except Exception as fault:
                if repr(fault) != said:
                    log.exception("page: it has failed, and begins anew; the box runs on without it")
                said = repr(fault)
                self.wire.state = "waiting"
            if self._socket is not None:
                # Otherwise a browser would wait for an answer that never comes.
                self._socket.close()
                self._socket = None
            if self._stopping.wait(AGAIN_S):
                return

    async def _serve(self, place: socket.socket) -> None:
        self._loop, self._stop = asyncio.get_running_loop(), asyncio.Event()
        say_it_once(self._loop)
        with loading():  # some hundred modules, here: so they do not delay the start of the box
            from aiohttp import http_exceptions, web  # noqa: PLC0415

            from rotator.web.api import Api  # noqa: PLC0415
            from rotator.web.live import Live  # noqa: PLC0415

            parts = self._build()
        if self._stopping.is_set():
            return
        connections = Connections(parts.doors.lets_in, self._clock)
        live = Live(parts.scene.now, parts.scene.past.note, self._clock)
        runner = web.AppRunner(
            Api(parts, live, connections).application(),
            access_log=None,
            logger=http_logger(http_exceptions.HttpProcessingError),
            handle_signals=False,
            keepalive_timeout=8.0,
            lingering_time=0.0,
            shutdown_timeout=0.5,
        )
        await runner.setup()
        server = runner.server
        assert server is not None, "a runner that is set up has a server"
        listening = await self._loop.create_server(
            lambda: Connection(connections, server()), sock=place, backlog=AT_ONCE
        )
        # The event loop has made the queue as short as the number it takes at once.
        place.listen(WAITING)
        works = [
            connections.watch(),
            live.run(),
            _keep(parts.pairings),
            self._events.run(),
            *(each() for each in parts.works),
        ]
        tasks: list[asyncio.Task[Any]] = [asyncio.create_task(work, name="page") for work in works]
        try:
            if not self._stopping.is_set():
                asked = asyncio.create_task(self._stop.wait(), name="page: stop")
                tasks.append(asked)
                ended, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
                for task in ended:
                    # Without pictures, or without the watch over connections, the page must end.
                    task.result()
        finally:
            listening.close()
            connections.drop_all()
            for close in parts.closes:
                await close()
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await runner.cleanup()
            await asyncio.to_thread(parts.pairings.keep)


async def _keep(pairings: Pairings) -> None:
    """Write the latest visits, until cancelled. In a thread of its own, so that a stop does not wait for the disk."""
    while True:
        await asyncio.sleep(KEEP_S)
        await asyncio.to_thread(pairings.keep)
