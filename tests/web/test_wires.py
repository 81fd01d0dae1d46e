"""The wire monitor on the page: the lines of `rotator monitor`, bounded, and honest about what is missing."""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import Wire
from rotator.monitor.tap import Tap
from rotator.monitor.transcript import Piece, Way, parse
from rotator.web.help_api import MOST_WATCHERS
from rotator.web.logs import LONGEST_LINE, MOST_LINES, WireLog
from tests.web.conftest import PATIENCE_S, Box

NOON = datetime(2026, 11, 23, 12)


@pytest.fixture
def tap() -> Tap:
    status = Status(0.0, AxisStatus(0, 450, 0.0), AxisStatus(0, 180, 0.0))
    made = Tap(lambda: NOON, lambda: status)
    made.link(Wire("gs232b", "gs232b", "run/gs232"), {})
    return made


@pytest.fixture
def wires(tap: Tap) -> WireLog:
    log = WireLog(tap)
    log.keep()
    return log


def send(tap: Tap, data: bytes) -> None:
    tap.note(Source("gs232b", 1), Way.IN, data, text=True)


def pieces(lines: Any) -> list[bytes]:
    return [entry.data for line in lines if isinstance(entry := parse(line), Piece)]


def test_each_line_comes_once_to_each_reader(tap: Tap, wires: WireLog) -> None:
    send(tap, b"C2\r")
    first = wires.after(0)
    send(tap, b"W235 025\r")
    assert pieces(first.lines) == [b"C2\r"]
    assert pieces(wires.after(first.upto).lines) == [b"W235 025\r"]
    assert pieces(wires.after(0).lines) == [b"C2\r", b"W235 025\r"]
    assert wires.after(wires.after(0).upto).lines == ()


def test_a_slow_reader_misses_lines_and_knows_how_many(tap: Tap, wires: WireLog) -> None:
    for number in range(MOST_LINES + 25):
        send(tap, b"%d" % number)
    new = wires.after(5)
    assert new.missed == 20
    assert pieces(new.lines)[0] == b"25"
    assert new.upto == MOST_LINES + 25


def test_a_crowd_of_lines_comes_in_parts_without_a_gap(tap: Tap, wires: WireLog) -> None:
    for number in range(500):
        send(tap, b"%d" % number)
    seen, upto = [], 0
    while lines := (new := wires.after(upto, 200)).lines:
        assert new.missed == 0
        seen += pieces(lines)
        upto = new.upto
    assert seen == [b"%d" % number for number in range(500)]


def test_a_long_line_is_cut(tap: Tap, wires: WireLog) -> None:
    send(tap, b"x" * 100_000)
    (line,) = wires.after(0).lines
    assert len(line) < LONGEST_LINE + 10


async def test_a_paired_browser_sees_what_a_program_sends_and_comes_back_without_a_gap(
    box: Box, tmp_path: Path
) -> None:
    with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
        await box.http.ws_connect(f"{box.url}/api/wires")
    assert refused.value.status == 401
    me = await box.pair()
    with (tmp_path / "gs232").open("r+b", buffering=0) as program:
        async with box.http.ws_connect(f"{box.url}/api/wires") as watch:
            assert (await told(watch))["lines"] == []
            program.write(b"C2\r")
            seen = await until(watch, "> C2")
        program.write(b"B\r")
        async with box.http.ws_connect(f"{box.url}/api/wires?after={seen['upto']}") as watch:
            again = await until(watch, "> B")
            assert "C2" not in str(again)
            assert again["missed"] == 0
            await box.post("revoke", {"number": me["number"]})
            while (message := await watch.receive(PATIENCE_S)).type is aiohttp.WSMsgType.TEXT:
                pass
            assert message.type in (aiohttp.WSMsgType.CLOSE, aiohttp.WSMsgType.CLOSED)


async def test_so_many_watch_and_no_more(box: Box) -> None:
    await box.pair()
    watching = [await box.http.ws_connect(f"{box.url}/api/wires") for _ in range(MOST_WATCHERS)]
    status, answer = await box.get("wires")
    assert (status, answer["error"]) == (409, f"{MOST_WATCHERS} are watching already")
    for each in watching:
        await each.close()


async def told(watch: aiohttp.ClientWebSocketResponse) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(await watch.receive_str(timeout=PATIENCE_S))
    return answer


async def until(watch: aiohttp.ClientWebSocketResponse, text: str) -> dict[str, Any]:
    while True:
        answer = await told(watch)
        if any(text in line for line in answer["lines"]):
            return answer
