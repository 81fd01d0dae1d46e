"""Orders and questions over HTTP, against the whole box on a simulated rotor."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from tests.web.conftest import OFF, Box, Start, page_of, with_box
from tests.web.test_live import live


async def test_a_paired_browser_points_the_antenna_and_one_that_is_not_may_only_stop_it(box: Box) -> None:
    assert (await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30}))[0] == 401
    assert box.status.wanted_azimuth_deg is None
    await box.pair("Anna's phone")
    assert await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30}) == (200, {"ok": True})
    await box.until(lambda: box.status.azimuth.at_target and box.status.elevation.at_target)
    assert box.world.antenna()[0] == pytest.approx(90.0, abs=5.0)
    await box.post("point", {"azimuth_deg": 300, "elevation_deg": 30})
    await box.until(lambda: box.world.drives() != OFF)
    async with aiohttp.ClientSession() as stranger, stranger.post(f"{box.url}/api/stop") as answer:
        assert answer.status == 200
    await box.until(lambda: box.world.drives() == OFF)
    assert box.status.latched == "page"
    status, told = await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30})
    assert (status, told["error"]) == (409, "stopped by the page: nothing moves until resume")
    assert (await box.post("resume"))[0] == 200
    assert (await box.post("point", {"azimuth_deg": 200, "elevation_deg": 30}))[0] == 200
    await box.until(lambda: box.world.drives() != OFF)


async def until_stopped_and_released(box: Box) -> None:
    await box.until(lambda: bool(box.status.latched))
    assert (await box.post("resume"))[0] == 200
    await box.until(lambda: not box.status.latched)


async def test_a_stop_counts_with_any_body(box: Box) -> None:
    await box.pair()
    for body in (b"x" * 100_000, b"{", b'{"axis": "tilt"}', b"\xff\0", b""):
        for kind in ("application/json", "text/plain", "image/png"):
            async with box.http.post(f"{box.url}/api/stop", data=body, headers={"Content-Type": kind}) as answer:
                assert (answer.status, await answer.json()) == (200, {"ok": True})
            await until_stopped_and_released(box)


async def test_so_does_a_damaged_stop_on_the_live_connection(box: Box) -> None:
    await box.pair()
    for said in ('{"stop": true}', '{"stop":1}', "STOP", '{"stop": tru', b"stop", '{"stop":true}' + " " * 999):
        async with box.http.ws_connect(f"{box.url}/api/live") as socket:
            for harmless in ('{"stop": false}', '{"let_go": true}'):
                await socket.send_str(harmless)
            await socket.receive()
            assert box.status.latched == ""
            await (socket.send_bytes(said) if isinstance(said, bytes) else socket.send_str(said))
            await until_stopped_and_released(box)


async def test_a_token_does_for_a_program_what_a_cookie_does_for_a_browser(box: Box, tmp_path: Path) -> None:
    token = await at_the_console(tmp_path, "pair token curl")
    bearer = {"Authorization": f"Bearer {token[0]}"}
    assert (await box.get("me", headers=bearer))[1]["name"] == "curl"
    assert (await box.post("point", {"azimuth_deg": 9, "elevation_deg": 9}, headers=bearer))[0] == 200
    assert (await box.get("me"))[1]["paired"] is False
    assert token[0] not in (tmp_path / "paired.json").read_text()


async def test_what_a_person_revokes_moves_nothing_any_more(box: Box, tmp_path: Path) -> None:
    me = await box.pair("lost phone")
    assert "lost phone" in (await at_the_console(tmp_path, "pair list"))[0]
    await at_the_console(tmp_path, f"pair revoke {me['number']}")
    status, _ = await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30})
    assert status == 401
    assert box.status.wanted_azimuth_deg is None


async def test_a_person_on_the_page_is_told_who_holds_the_antenna_and_takes_it_over(box: Box) -> None:
    await box.pair("Anna")
    await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30})
    async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as other:
        bert = Box(box.app, box.world, box.url, other, box.anew)
        await bert.pair("Bert")
        await box.until(lambda: bool(box.status.held_by))
        status, told = await bert.post("point", {"azimuth_deg": 10, "elevation_deg": 30})
        assert (status, told["error"]) == (409, "Anna holds the antenna: take it over first")
        assert (await bert.post("take"))[0] == 200
        await box.until(lambda: box.status.held_by == "page#2")
        assert (await bert.post("point", {"azimuth_deg": 10, "elevation_deg": 30}))[0] == 200


@with_box('[station]\nlocator = "JO62qm"\n')
async def test_what_a_person_holds_no_other_on_the_page_parks_gives_back_or_ends(box: Box) -> None:
    await box.pair("Anna")
    assert (await box.post("track", {"target": "JN58td"}))[0] == 200
    await box.until(lambda: box.status.held_by == "page#1")
    await box.until(lambda: box.world.drives() != OFF)
    assert box.status.controlled_by == "track"
    async with aiohttp.ClientSession(cookie_jar=aiohttp.CookieJar(unsafe=True)) as other:
        bert = Box(box.app, box.world, box.url, other, box.anew)
        await bert.pair("Bert")
        for order in (("give-back",), ("park",), ("track", {"target": "off"})):
            status, told = await bert.post(*order)
            assert (status, told["error"]) == (409, "Anna holds the antenna: take it over first"), order
        assert (await box.post("park"))[0] == 200
        await box.until(lambda: box.status.storm)
        status, told = await bert.post("take")
        assert (status, told["error"]) == (409, "storm park by Anna: nothing else moves it until resume")
        # Like a stop: in every state, by anybody.
        assert (await bert.post("let-go"))[0] == 200
        await box.until(lambda: not box.status.storm and bool(box.status.latched))


async def test_who_is_revoked_while_holding_the_antenna_holds_it_no_more(box: Box) -> None:
    me = await box.pair("lost phone")
    await box.post("point", {"azimuth_deg": 300, "elevation_deg": 60})
    await box.until(lambda: box.world.drives() != OFF and bool(box.status.held_by))
    assert (await box.post("revoke", {"number": me["number"]}))[0] == 200
    await box.until(lambda: box.world.drives() == OFF and box.status.held_by == "")
    assert (await box.pair("another"))["number"] == 2


async def test_pairings_outlive_the_box(page_box: Start) -> None:
    async with page_box() as box:
        await box.pair("Anna's phone")
        cookies = {each.key: each.value for each in box.http.cookie_jar}
    async with page_box() as box, box.http.get(f"{box.url}/api/me", cookies=cookies) as answer:
        assert json.loads(await answer.text())["name"] == "Anna's phone"


async def test_a_taken_port_is_said_and_the_box_runs(box: Box, caplog: Any) -> None:
    place = box.url.removeprefix("http://")
    page = page_of(box.app)
    page.start()
    page.stop()
    assert page.wire.state == "closed"
    assert f"there is no page: {place}: cannot listen there: Address already in use" in caplog.text
    assert (await box.get("status"))[0] == 200


async def at_the_console(folder: Path, line: str) -> list[str]:
    """What the box's console answers, without its `ok`."""
    reader, writer = await asyncio.open_unix_connection(str(folder / "console"))
    try:
        writer.write(f"{line}\n".encode())
        answers = []
        while (answer := (await reader.readline()).decode().strip()) != "ok":
            assert not answer.startswith("error"), answer
            assert answer
            answers.append(answer)
        return answers
    finally:
        writer.close()
        await asyncio.gather(writer.wait_closed(), return_exceptions=True)


async def test_a_press_of_stop_that_comes_by_two_ways_is_one_stop(box: Box) -> None:
    await box.pair()
    async with live(box) as browser:
        for press, key in enumerate(("a-1", "a-2"), 1):
            await browser.socket.send_str(f'{{"stop": true, "key": "{key}"}}')
            await box.until(lambda: bool(box.status.latched))
            assert (await box.post("stop", headers={"Idempotency-Key": key}))[0] == 200
            assert (await box.post("resume", headers={"If-Match": f'"{press}"'}))[0] == 200
            await box.until(lambda: not box.status.latched)
            # One that is late by seconds does not hold the antenna again.
            assert (await box.post("stop", headers={"Idempotency-Key": key}))[0] == 200
        assert not box.status.latched
    # A stop without a key is a stop each time, and so is one whose message is damaged.
    assert (await box.post("stop", headers={"Idempotency-Key": ""}))[0] == 200
    assert (await box.post("stop"))[0] == 200
    async with live(box) as browser:
        assert browser.told["now"]["stops"] == 4


async def test_a_late_resume_does_not_undo_a_stop_that_its_sender_has_not_seen(box: Box) -> None:
    """A request may hang in the air for seconds, and a stop overtakes it: it names the stops that it knows."""
    await box.pair()
    assert (await box.post("stop"))[0] == 200
    await box.until(lambda: bool(box.status.latched))
    async with live(box) as browser:
        seen = {"If-Match": f'"{browser.told["now"]["stops"]}"'}
    assert (await box.post("stop"))[0] == 200
    async with live(box) as browser:
        newer = {"If-Match": f'"{browser.told["now"]["stops"]}"'}
    assert newer != seen
    status, told = await box.post("resume", headers=seen)
    assert status == 412
    assert box.status.latched
    assert "stopped again" in told["error"]
    assert (await box.post("resume", headers=newer))[0] == 200
    await box.until(lambda: not box.status.latched)
