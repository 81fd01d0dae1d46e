"""A crowd of browsers, each a machine of its own.

A browser asks for what `rotator/web/static/app.js` asks for, and as often: the files of the page, ten pictures a
second, what the box is, the past, the next pass, what is up, where the antenna cannot point, the path of what is
tracked. Does not know the box.
"""

from __future__ import annotations

import asyncio
import json
import random
import time
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass, field

import aiohttp

from rotator.web import assets

COMES_WITHIN_S = 5.0
PAST_S, NEXT_S, SKY_S, COMPUTES_S = 5.0, 20.0, 60.0, 2.0
"""As in app.js and overhead.js."""


@dataclass
class Browser:
    http: aiohttp.ClientSession
    pictures: list[float] = field(default_factory=list)
    """The moment of each."""
    answers: int = 0
    failed: list[str] = field(default_factory=list)

    here: asyncio.Event = field(default_factory=asyncio.Event)
    """It has got its first picture, or nothing at all."""

    async def visit(self) -> None:
        """The whole page, then its requests, until cancelled."""
        await asyncio.sleep(random.random() * COMES_WITHIN_S)
        for path in assets.load():
            await self._read(path)
        async with asyncio.TaskGroup() as requests:
            requests.create_task(self._look())
            requests.create_task(self._again("/api/past", PAST_S))
            requests.create_task(self._again("/api/next", NEXT_S))
            requests.create_task(self._again("/api/sky", SKY_S))
            requests.create_task(self._read("/api/unreached"))

    async def _look(self) -> None:
        try:
            async with self.http.ws_connect("/api/live") as live:
                await self._read("/api/box")
                await self._pictures_of(live)
            self.failed.append(f"the live connection ended: {live.close_code}")
        except aiohttp.ClientError as fault:
            self.failed.append(f"the live connection: {fault}")
        finally:
            self.here.set()

    async def _pictures_of(self, live: aiohttp.ClientWebSocketResponse) -> None:
        tracked = ""
        async for message in live:
            self.pictures.append(time.monotonic())
            self.here.set()
            path = json.loads(message.data)["now"]["path"]
            if path != tracked:
                tracked = path
                await self._read("/api/path")

    async def _again(self, path: str, every_s: float) -> None:
        while True:
            status = await self._read(path)
            await asyncio.sleep(COMPUTES_S if status == 202 else every_s)

    async def _read(self, path: str) -> int:
        try:
            async with self.http.get(path) as answer:
                await answer.read()
        except aiohttp.ClientError as fault:
            self.failed.append(f"{path}: {fault}")
            return 0
        if not answer.ok:
            self.failed.append(f"{path}: {answer.status}")
        self.answers += 1
        return answer.status

    def rate_hz(self) -> float:
        return (len(self.pictures) - 1) / (self.pictures[-1] - self.pictures[0]) if len(self.pictures) > 1 else 0.0


@asynccontextmanager
async def browsers(port: int, count: int) -> AsyncIterator[list[Browser]]:
    """All of them look on within it."""
    async with AsyncExitStack() as sessions:
        crowd = []
        for number in range(count):
            connector = aiohttp.TCPConnector(local_addr=(f"127.0.1.{1 + number}", 0))
            session = aiohttp.ClientSession(f"http://127.0.0.1:{port}", connector=connector)
            crowd.append(Browser(await sessions.enter_async_context(session)))
        visits = [asyncio.create_task(browser.visit()) for browser in crowd]
        for browser in crowd:
            await browser.here.wait()
        yield crowd
        for visit in visits:
            visit.cancel()
        ended = await asyncio.gather(*visits, return_exceptions=True)
        for browser, fault in zip(crowd, ended, strict=True):
            if not isinstance(fault, asyncio.CancelledError):
                browser.failed.append(repr(fault))
