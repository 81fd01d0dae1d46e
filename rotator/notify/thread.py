"""The threads that notice and tell: one compares, one posts to the address of [notify]. No other part waits for them.

Knows time and HTTP. An address may be a secret: the log names its host alone. What nobody takes is dropped.
"""

from __future__ import annotations

import base64
import json
import logging
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from email.header import Header
from http.client import HTTPException
from queue import Full, Queue
from urllib.error import HTTPError
from urllib.parse import unquote, urlsplit
from urllib.request import Request

from rotator.config.notify import NotifyTable
from rotator.fetching.download import no_answer, opener
from rotator.notify.watch import Notice

log = logging.getLogger(__name__)

LOOK_S, ANSWER_S = 0.5, 10.0
MOST_WAITING, LATE_S = 16, 900.0
"""More notices than these are dropped, and so is what has waited for so long."""
WAITS_S = (5.0, 30.0, 120.0)
"""Pauses before it is tried again."""
PASSING = (408, 425, 429)
"""Answers below 500 after which another try may succeed."""


class NotifyThread:
    """`notices` tells what is new since it was called last. `waits_s`: as `WAITS_S`."""

    def __init__(
        self, table: NotifyTable, notices: Callable[[], Sequence[Notice]], waits_s: Sequence[float] = WAITS_S
    ) -> None:
        self._table, self._notices, self._waits_s = table, notices, waits_s
        self._queue: Queue[Notice] = Queue(MOST_WAITING)
        self._stopping = threading.Event()
        self._trouble = ""
        """Why the latest notice was not taken. The log has each new reason once."""

    def start(self) -> None:
        for work, name in ((self._look, "notices"), (self._send, "notify")):
            threading.Thread(target=work, name=name, daemon=True).start()

    def stop(self) -> None:
        """A post in work does not hold up the end of the box."""
        self._stopping.set()
        with suppress(Full):
            self._queue.put_nowait(Notice("", "", "", 0.0))

    def _look(self) -> None:
        while not self._stopping.wait(LOOK_S):
            for notice in self._notices():
                with suppress(Full):
                    self._queue.put_nowait(notice)

    def _send(self) -> None:
        while not self._stopping.is_set():
            notice = self._queue.get()
            for wait_s in (*self._waits_s, 0.0):
                if time.time() - notice.at_utc_s > LATE_S:
                    break
                trouble, again = post(self._table, notice)
                if trouble and trouble != self._trouble:
                    log.warning("notify: %s: %s", urlsplit(self._table.url or "").hostname, trouble)
                self._trouble = trouble
                if not again or self._stopping.wait(wait_s):
                    break


def post(table: NotifyTable, notice: Notice) -> tuple[str, bool]:
    """Why it was not taken, and whether another try may succeed. An empty reason: it was."""
    try:
        with opener().open(_request(table, notice), timeout=ANSWER_S):
            return "", False
    except HTTPError as answer:
        answer.close()
        return f"the server answers {answer.code}", answer.code >= 500 or answer.code in PASSING
    except (OSError, HTTPException, ValueError) as fault:
        return no_answer(getattr(fault, "reason", fault)), True


def _request(table: NotifyTable, notice: Notice) -> Request:
    parts = urlsplit(table.url or "")
    login, _, host = parts.netloc.rpartition("@")
    headers = {"Authorization": f"Basic {base64.b64encode(unquote(login).encode()).decode()}"} if login else {}
    if table.form == "json":
        headers["Content-Type"] = "application/json"
        told = {"event": notice.event, "title": notice.title, "text": notice.text, "utc_s": round(notice.at_utc_s)}
        body = json.dumps(told, ensure_ascii=False)
    else:
        headers["Content-Type"] = "text/plain; charset=utf-8"
        headers["Title"] = notice.title if notice.title.isascii() else Header(notice.title, "utf-8", 10_000).encode()
        body = notice.text
    return Request(parts._replace(netloc=host).geturl(), body.encode(), headers)
