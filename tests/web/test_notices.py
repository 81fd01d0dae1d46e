"""Notices by a webhook: what is told, once, to a receiver such as ntfy; and one that is away holds up nothing."""

from __future__ import annotations

import asyncio
import base64
import logging
import re
import threading
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from queue import Queue
from typing import Any

import pytest

from hw.ports import Axis
from rotator.config.page import NotifyTable
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.status import AxisStatus, Flown, Status
from rotator.views.news import News, Notice
from rotator.web.webhook import Webhook
from tests.boxes import free_port
from tests.web.conftest import PATIENCE_S, Start

SECRET = "Zq7xSecret"
AT_S, UTC_S = 100.0, 1.8e9
STATUS = Status(AT_S, AxisStatus(0, 450, 120.0), AxisStatus(0, 180, 0.0))
OPEN = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "0.0 V")


@dataclass
class Receiver:
    """What came, and what it answers: each of these codes once, then 200. None: no answer before the end."""

    url: str = ""
    answers: list[int | None] = field(default_factory=list)
    came: Queue[tuple[str, dict[str, str], str]] = field(default_factory=Queue)
    over: threading.Event = field(default_factory=threading.Event)


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    found = Receiver()

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"])).decode()
            found.came.put((self.path, dict(self.headers), body))
            code = found.answers.pop(0) if found.answers else 200
            if code is None:
                found.over.wait(PATIENCE_S)
                return
            self.send_response(code)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            """Keeps quiet."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    found.url = f"http://127.0.0.1:{server.server_port}/{SECRET}"
    yield found
    found.over.set()
    server.shutdown()
    server.server_close()


async def test_a_box_tells_of_a_stop_and_of_a_pass(page_box: Start, receiver: Receiver) -> None:
    url = receiver.url.replace("//", f"//anna:{SECRET}@")
    async with page_box(f'[notify]\nurl = "{url}"\nbefore_min = 5\n') as box:
        await box.pair("Anna's phone")
        await box.post("stop")
        path, headers, text = await next_at(receiver)
        assert (path, headers["Title"], text) == (
            f"/{SECRET}",
            "STOPPED by the page",
            "Nothing moves before a person lets it.",
        )
        assert base64.b64decode(headers["Authorization"].removeprefix("Basic ")).decode() == f"anna:{SECRET}"
        assert headers["Content-Type"] == "text/plain; charset=utf-8"
        await box.post("resume")
        table = "t,az,el\n120,20,5\n180,50,25\n"
        async with box.http.post(f"{box.url}/api/track-table?name=bird.csv", data=table) as answer:
            assert answer.status == 200
        await box.until(lambda: not receiver.came.empty())
        assert re.fullmatch(r"bird comes in (?:1:\d\d|2:00) min", receiver.came.get()[1]["Title"])
    assert receiver.came.empty(), "each is told once"


async def test_a_receiver_that_never_answers_delays_neither_an_order_nor_the_end(
    page_box: Start, receiver: Receiver
) -> None:
    receiver.answers = [None]
    async with page_box(f'[notify]\nurl = "{receiver.url}"\n') as box:
        await box.pair()
        await box.post("stop")
        await next_at(receiver)
        await box.post("resume")
        assert (await box.post("point", {"azimuth_deg": 90, "elevation_deg": 20}))[0] == 200
        await box.until(lambda: box.status.moving)
    assert not receiver.over.is_set(), "the box has ended, and the receiver still does not answer"


@asynccontextmanager
async def notify(table: NotifyTable, *told: Notice) -> AsyncIterator[None]:
    """Running, with these notices at once, and no pause between two tries."""
    left = [list(told)]
    webhook = Webhook(table, lambda: left.pop() if left else [], waits_s=(0.0, 0.0))
    running = asyncio.create_task(webhook.run())
    yield
    running.cancel()
    await asyncio.gather(running, return_exceptions=True)


def news(title: str, event: str = "fault") -> Notice:
    return Notice(event, title, "text", time.time())


async def next_at(receiver: Receiver) -> tuple[str, dict[str, str], str]:
    return await asyncio.to_thread(receiver.came.get, timeout=PATIENCE_S)


async def test_it_is_tried_again_where_that_may_help_and_its_title_may_be_of_any_letters(receiver: Receiver) -> None:
    receiver.answers = [503, 429, 200, 403]
    async with notify(NotifyTable(url=receiver.url), news("Ö"), news("refused"), news("last")):
        titles = [(await next_at(receiver))[1]["Title"] for _ in range(5)]
    assert titles == ["=?utf-8?b?w5Y=?="] * 3 + ["refused", "last"]


async def test_as_json_it_has_its_parts(receiver: Receiver) -> None:
    async with notify(NotifyTable(url=receiver.url, form="json"), news("It comes", "pass")):
        _, headers, text = await next_at(receiver)
    assert headers["Content-Type"] == "application/json"
    assert '"event": "pass", "title": "It comes", "text": "text", "utc_s": ' in text


async def test_old_news_is_not_told(receiver: Receiver) -> None:
    async with notify(NotifyTable(url=receiver.url), Notice("pass", "ISS comes", "", 1.0), news("now")):
        assert (await next_at(receiver))[1]["Title"] == "now"


async def test_a_receiver_that_is_away_is_told_to_the_log_once_without_the_secret(
    caplog: pytest.LogCaptureFixture, receiver: Receiver
) -> None:
    """It takes the last one: by then the others have failed."""
    receiver.answers = [500] * 6
    url = receiver.url.replace("//", f"//anna:{SECRET}@")
    with caplog.at_level(logging.INFO, "rotator.web.webhook"):
        async with notify(NotifyTable(url=url), news("one"), news("two"), news("three")):
            for _ in range(7):
                await next_at(receiver)
        async with notify(NotifyTable(url=f"http://127.0.0.1:{free_port()}/{SECRET}"), news("four")):
            async with asyncio.timeout(PATIENCE_S):
                while len(caplog.messages) < 2:
                    await asyncio.sleep(0.01)
    assert caplog.messages[0] == "notify: 127.0.0.1: the server answers 500"
    assert caplog.messages[1].startswith("notify: 127.0.0.1: no answer: ")
    assert SECRET not in str(caplog.messages)


def flown(begin_s: float, name: str = "ISS") -> Status:
    return replace(STATUS, flown=Flown(name, begin_s, begin_s + 600))


FAULTY = replace(STATUS, azimuth=replace(STATUS.azimuth, fault=OPEN))


@pytest.mark.parametrize(
    ("steps", "titles"),
    [
        ([(STATUS, None)], []),
        ([(replace(STATUS, latched="page#1"), None)] * 3, ["STOPPED by the page"]),
        ([(replace(STATUS, latched="panel", storm=True), None)], ["STORM PARK by the panel"]),
        ([(FAULTY, None), (FAULTY, None), (STATUS, None), (FAULTY, None)], ["FAULT azimuth: pot open or shorted"]),
        ([(flown(AT_S + 301), None), (flown(AT_S + 299), None), (flown(AT_S + 298), None)], ["ISS comes in 4:59 min"]),
        ([(STATUS, ("SO-50", UTC_S + 240)), (STATUS, ("SO-50", UTC_S + 245))], ["SO-50 comes in 4:00 min"]),
        ([(flown(AT_S - 10), ("SO-50", UTC_S + 120))], ["SO-50 comes in 2:00 min"]),
        ([(STATUS, ("SO-50", UTC_S - 1))], []),
    ],
)
def test_what_is_new_is_told_once(steps: list[tuple[Status, Any]], titles: list[str]) -> None:
    news_of = News(("pass", "fault", "stop"), 300.0)
    told = [each.title for status, upcoming in steps for each in news_of.step(status, upcoming, UTC_S)]
    assert told == titles


def test_only_what_was_asked_for_is_told() -> None:
    assert News(("pass",), 300.0).step(replace(FAULTY, latched="page#1"), None, UTC_S) == []
