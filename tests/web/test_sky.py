"""The sky on the page's API: an order that is dragged, elements that are sent, and what hostile files do not do."""

from __future__ import annotations

import asyncio
import contextlib
import io
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from rotator.store.uploads import MOST_BYTES
from rotator.web.plan import next_pass
from tests.orbits import skyfield_oracle
from tests.web.conftest import Box, Start, with_box

FOLLOWS = """
[station]
locator = "JN18eu"
[sky]
[[sky.follow]]
name = "ISS"
[[sky.follow]]
name = "SO-50"
"""
TLE = skyfield_oracle.TLE.read_bytes()


async def send(box: Box, name: str, content: bytes | Any) -> tuple[int, dict[str, Any]]:
    async with box.http.post(
        f"{box.url}/api/elements",
        params={"name": name},
        data=io.BytesIO(content) if isinstance(content, bytes) else content,
    ) as answer:
        return answer.status, await answer.json()


@with_box(FOLLOWS)
async def test_an_order_counts_and_the_file_stays(box: Box, tmp_path: Path) -> None:
    assert (await box.post("followed", {"order": ["SO-50", "ISS"]}))[0] == 401
    await box.pair()
    for wrong in (["ISS"], ["ISS", "ISS"], ["ISS", "SO-50", "X"], ["ISS", 5], "ISS", [["ISS"], "SO-50"]):
        status, told = await box.post("followed", {"order": wrong})
        assert status == 400, told
    assert await box.post("followed", {"order": ["SO-50", "ISS"]}) == (200, {"ok": True})
    _, told = await box.get("followed")
    assert [(each["name"], each["priority"], each["written"]) for each in told["followed"]] == [
        ("SO-50", 2.0, 1.0),
        ("ISS", 1.0, 1.0),
    ]
    assert "priorities" in (tmp_path / "state.json").read_text()
    assert await box.post("followed", {"order": None}) == (200, {"ok": True})
    _, told = await box.get("followed")
    assert {each["priority"] for each in told["followed"]} == {1.0}


@with_box(FOLLOWS)
async def test_elements_that_are_sent_are_known_at_once_and_last(box: Box, tmp_path: Path) -> None:
    await box.pair()
    assert await send(box, "mine.tle", TLE) == (200, {"name": "mine.txt"})
    async with asyncio.timeout(30.0):
        while (told := (await box.get("elements"))[1])["satellites"] != 3:
            await asyncio.sleep(0.05)
    (file,) = told["files"]
    assert (file["name"], file["uploaded"], file["satellites"]) == ("mine.txt", True, 3)
    assert file["newest_days"] > 100
    _, told = await box.get("followed")
    assert {each["fault"] for each in told["followed"]} == {""}
    assert await box.post("elements/remove", {"name": "../state.json"}) != (200, {"ok": True})
    assert await box.post("elements/remove", {"name": "mine.txt"}) == (200, {"ok": True})
    async with asyncio.timeout(30.0):
        while (await box.get("elements"))[1]["satellites"]:
            await asyncio.sleep(0.05)


HOSTILE = {
    "empty": b"",
    "no elements": b"hello\nworld\n",
    "a picture": b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 8,
    "half a file": TLE[:-40],
    "one letter wrong": TLE.replace(b"51.6353", b"51.6354"),
    "deep": b"[" * 100_000,
    "one line": b"x" * 500_000,
    "bombs of numbers": b'[{"OBJECT_NAME": "X", "NORAD_CAT_ID": 1' + b"0" * 5000 + b"}]",
    "an escape for terminals": b'[{"OBJECT_NAME": "\\u001b[2J", "NORAD_CAT_ID": 5}]',
}


@pytest.mark.long
@with_box(FOLLOWS)
async def test_hostile_files_are_refused_by_name_and_leave_nothing(box: Box, tmp_path: Path) -> None:
    assert (await send(box, "x.tle", TLE))[0] == 401, "who is not paired sends nothing"
    await box.pair()
    for what, content in HOSTILE.items():
        status, told = await send(box, "bad.tle", content)
        assert status == 400, what
        assert told["error"].startswith("bad.txt is not taken: "), what
        assert told["error"].isprintable(), what
    with contextlib.suppress(aiohttp.ClientError):  # it may be cut off before it has read the answer
        assert (await send(box, "large.tle", bytes(MOST_BYTES + 1)))[0] == 413
    for name in ("", "../..", "x" * 201):
        assert (await send(box, name, TLE))[0] == 400
    assert not list((tmp_path / "uploaded").glob("*"))
    assert (await box.get("status"))[0] == 200


@pytest.mark.parametrize("paired", [True, False])
async def test_a_file_that_never_ends_is_cut_off(page_box: Start, tmp_path: Path, *, paired: bool) -> None:
    async def endless() -> Any:
        while True:
            yield b"1 25544U 98067A   25059.54152977\n" * 2000

    async with page_box(FOLLOWS) as box:
        if paired:
            await box.pair()
        with contextlib.suppress(aiohttp.ClientError):
            assert (await send(box, "x.tle", endless()))[0] == (413 if paired else 401)
        assert not (tmp_path / "uploaded").exists()
        assert (await box.get("status"))[0] == 200


async def test_a_picture_that_is_not_there_is_no_file_of_the_box(box: Box) -> None:
    assert await box.get("flown") == (200, {"flown": [], "pictures": 30})
    for file in ("..%2Fstate.json", "state.json", "%2Fetc%2Fpasswd", "20250301-000000-iss.svg"):
        for kind in ("picture", "table"):
            async with box.http.get(f"{box.url}/api/flown/{kind}?file={file}") as answer:
                assert answer.status == 404


NOON_S = datetime(2026, 3, 1, 12, tzinfo=UTC).timestamp()


def found(name: str, minutes: float, highest_deg: float, *, flown: bool | None = None) -> dict[str, Any]:
    aos = datetime.fromtimestamp(NOON_S + 60 * minutes, UTC).isoformat()
    plan = None if flown is None else {"flown": flown}
    return {"name": name, "aos": aos, "los": aos, "max_el_deg": highest_deg, "plan": plan}


def test_the_next_pass_is_that_of_the_plan() -> None:
    first, second = found("A", 5, 60.0), found("B", 9, 12.0, flown=True)
    left_out = found("C", 2, 80.0, flown=False)
    assert next_pass([first, left_out, second], NOON_S) == second


def test_without_a_plan_it_is_the_next_that_rises_high_enough() -> None:
    past, low, high = found("A", -5, 60.0), found("B", 2, 9.0), found("C", 9, 12.0)
    up = {**found("D", 0, 80.0), "aos": None}
    assert next_pass([past, up, low, high], NOON_S) == high
    assert next_pass([past, low], NOON_S) is None
    assert next_pass([], time.time()) is None
