"""The log on the page, and what strangers' bytes leave in it."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterator
from typing import Any

import pytest

from rotator.web.logs import MOST_LOG_LINES, HttpLog, LogLines
from tests.web.conftest import PATIENCE_S, Box, Start


@pytest.fixture
def lines() -> Iterator[LogLines]:
    kept = LogLines()
    kept.keep()
    yield kept
    kept.forget()


def test_the_latest_lines_are_kept_the_newest_first(lines: LogLines) -> None:
    log = logging.getLogger("rotator.test")
    for number in range(MOST_LOG_LINES + 10):
        log.warning("line %d\nits second line", number)
    told = lines.latest_first()
    assert len(told) == MOST_LOG_LINES
    assert told[0]["text"] == f"line {MOST_LOG_LINES + 9}"
    assert told[0]["rank"] == "warning"


def test_a_line_that_cannot_be_written_ends_nothing(lines: LogLines, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(logging, "raiseExceptions", False)
    lines.handle(logging.LogRecord("x", logging.WARNING, "f", 1, "%d of %d", ("one",), None))
    lines.handle(logging.LogRecord("x", logging.WARNING, "f", 1, "and on", (), None))
    assert [line["text"] for line in lines.latest_first()] == ["and on"]


async def test_the_log_is_for_paired_browsers(box: Box) -> None:
    assert (await box.get("log"))[0] == 401
    await box.pair("Anna's phone")
    await box.post("stop")
    async with asyncio.timeout(PATIENCE_S):
        while not any("stopped by Anna" in line["text"] for line in (await box.get("log"))[1]["lines"]):
            await asyncio.sleep(0)


async def test_bytes_that_are_no_request_are_told_in_one_line(page_box: Start, caplog: Any) -> None:
    async with page_box() as box:
        host, _, port = box.url.removeprefix("http://").partition(":")
        for junk in (
            b"\x16\x03\x01\x02\x00\x01\r\n\r\n",
            b"GET / HTTP/9.9\r\n\r\n",
            b"\x00" * 100 + b"\r\n\r\n",
        ) * 5:
            reader, writer = await asyncio.open_connection(host, int(port))
            writer.write(junk)
            assert b"400" in await reader.readline()
            writer.close()
        assert (await box.get("status"))[0] == 200
    about = [record for record in caplog.records if record.name == "rotator.web.http"]
    assert [record.getMessage() for record in about] == ["page: a request was no HTTP"]
    assert about[0].exc_info is None


def test_a_mistake_of_ours_keeps_its_trace() -> None:
    trace = HttpLog(KeyError, lambda: 100.0)
    error = ZeroDivisionError("ours")
    record = logging.LogRecord("x", logging.ERROR, "f", 1, "failed", None, (ZeroDivisionError, error, None))
    assert trace.filter(record)
    assert record.exc_info is not None
