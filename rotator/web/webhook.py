"""Posts what is new to the address of [notify], as a task of the page. No other part waits for it.

Knows HTTP. An address may be a secret: the log names its host alone. What nobody takes is dropped.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections import deque
from collections.abc import Callable, Sequence
from email.header import Header
from typing import Any
from urllib.parse import urlsplit

import aiohttp

from rotator.config.page import NotifyTable
from rotator.fetching.download import ANSWER_S, no_answer
from rotator.views.news import Notice

log = logging.getLogger(__name__)

LOOK_S = 0.5
WHOLE = aiohttp.ClientTimeout(ANSWER_S)
MOST_WAITING, LATE_S = 16, 900.0
"""More notices than these are dropped, the oldest first, and so is what has waited for so long."""
WAITS_S = (5.0, 30.0, 120.0)
"""Pauses before it is tried again."""
PASSING = (408, 425, 429)
"""Answers below 500 after which another try may succeed."""


class Webhook:
    """`news` tells what is new since it was called last. `waits_s`: as `WAITS_S`."""

    def __init__(
        self, table: NotifyTable, news: Callable[[], Sequence[Notice]], waits_s: Sequence[float] = WAITS_S
    ) -> None:
        self._table, self._news, self._waits_s = table, news, waits_s
        self._waiting: deque[Notice] = deque(maxlen=MOST_WAITING)
        self._trouble = ""
        """Why the latest notice was not taken. The log has each new reason once."""

    async def run(self) -> None:
        """Look and post until cancelled. There is an address."""
        sending = asyncio.create_task(self._send(), name="page: notices")
        try:
            while True:
                self._waiting.extend(self._news())
                await asyncio.sleep(LOOK_S)
        finally:
            sending.cancel()

    async def _send(self) -> None:
        while True:
            await asyncio.sleep(LOOK_S)
            while self._waiting:
                notice = self._waiting.popleft()
                for wait_s in (*self._waits_s, 0.0):
                    if time.time() - notice.at_utc_s > LATE_S or not await self._post(notice):
                        break
                    await asyncio.sleep(wait_s)

    async def _post(self, notice: Notice) -> bool:
        """Whether another try may succeed."""
        trouble, again = "", False
        try:
            async with (
                aiohttp.ClientSession(timeout=WHOLE) as http,
                http.post(self._table.url or "", allow_redirects=False, **self._content(notice)) as answer,
            ):
                if answer.status >= 300:
                    trouble = f"the server answers {answer.status}"
                    again = answer.status >= 500 or answer.status in PASSING
        except (aiohttp.ClientError, OSError, ValueError) as fault:
            trouble, again = no_answer(getattr(fault, "os_error", fault)), True
        if trouble and trouble != self._trouble:
            log.warning("notify: %s: %s", urlsplit(self._table.url or "").hostname, trouble)
        self._trouble = trouble
        return again

    def _content(self, notice: Notice) -> dict[str, Any]:
        event, title, text, utc_s = notice.event, notice.title, notice.text, round(notice.at_utc_s)
        if self._table.form == "json":
            return {"json": {"event": event, "title": title, "text": text, "utc_s": utc_s}}
        title = title if title.isascii() else Header(title, "utf-8", 10_000).encode()
        return {"data": text, "headers": {"Title": title}}
