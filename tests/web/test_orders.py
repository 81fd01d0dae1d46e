"""Orders and questions over HTTP, against the whole box on a simulated rotor."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from contextlib import AbstractAsyncContextManager
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from rotator.protocols.methods import METHODS
from rotator.protocols.status_object import as_object
from tests.web.conftest import OFF, Box, page_of
from tests.web.test_live import live

Start = Callable[..., AbstractAsyncContextManager[Box]]


def test_the_status_is_that_of_the_command_line(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
            status, told = await box.get("status")
            assert status == 200
            assert told.keys() == as_object(box.status).keys()
            assert told["simulated"] is True

    asyncio.run(main())


def test_a_paired_browser_points_the_antenna_and_one_that_is_not_may_only_stop_it(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
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

    asyncio.run(main())


@pytest.mark.parametrize("body", [b"x" * 100_000, b"{", b'{"axis": "tilt"}', b"\xff\0", b""])
@pytest.mark.parametrize("kind", ["application/json", "text/plain", "image/png"])
def test_a_stop_counts_with_any_body(page_box: Start, body: bytes, kind: str) -> None:
    async def main() -> None:
        async with page_box() as box:
            async with box.http.post(f"{box.url}/api/stop", data=body, headers={"Content-Type": kind}) as answer:
                assert (answer.status, await answer.json()) == (200, {"ok": True})
            await box.until(lambda: box.status.latched == "page")

    asyncio.run(main())


@pytest.mark.parametrize(
    "said", ['{"stop": true}', '{"stop":1}', "STOP", '{"stop": tru', b"stop", '{"stop":true}' + " " * 999]
)
def test_so_does_a_damaged_stop_on_the_live_connection(page_box: Start, said: str | bytes) -> None:
    async def main() -> None:
        async with page_box() as box, box.http.ws_connect(f"{box.url}/api/live") as socket:
            for harmless in ('{"stop": false}', '{"let_go": true}'):
                await socket.send_str(harmless)
            await socket.receive()
            assert box.status.latched == ""
            await (socket.send_bytes(said) if isinstance(said, bytes) else socket.send_str(said))
            await box.until(lambda: box.status.latched == "page")

    asyncio.run(main())


def test_a_token_does_for_a_program_what_a_cookie_does_for_a_browser(page_box: Start, tmp_path: Path) -> None:
    async def main() -> None:
        async with page_box() as box:
            token = await at_the_console(tmp_path, "pair token curl")
            bearer = {"Authorization": f"Bearer {token[0]}"}
            assert (await box.get("me", headers=bearer))[1]["name"] == "curl"
            assert (await box.post("point", {"azimuth_deg": 9, "elevation_deg": 9}, headers=bearer))[0] == 200
            assert (await box.get("me"))[1]["paired"] is False
            assert token[0] not in (tmp_path / "paired.json").read_text()

    asyncio.run(main())


def test_what_a_person_revokes_moves_nothing_any_more(page_box: Start, tmp_path: Path) -> None:
    async def main() -> None:
        async with page_box() as box:
            me = await box.pair("lost phone")
            assert "lost phone" in (await at_the_console(tmp_path, "pair list"))[0]
            await at_the_console(tmp_path, f"pair revoke {me['number']}")
            status, _ = await box.post("point", {"azimuth_deg": 90, "elevation_deg": 30})
            assert status == 401
            assert box.status.wanted_azimuth_deg is None

    asyncio.run(main())


@pytest.mark.parametrize(
    ("path", "values", "says"),
    [
        ("point", {"azimuth_deg": 90}, "point needs elevation_deg"),
        ("point", {"azimuth_deg": "90", "elevation_deg": 1}, "azimuth_deg must be a number from -360 to 720"),
        ("point", {"azimuth_deg": True, "elevation_deg": 1}, "azimuth_deg must be a number from -360 to 720"),
        ("point", {"azimuth_deg": 1, "elevation_deg": 1, "speed": 3}, "point has no value 'speed'"),
        ("jog", {"turn": "left", "seconds": 1}, "turn must be one of cw, ccw, up, down"),
        ("jog", {"turn": "cw", "seconds": 600}, "seconds must be a number from 0.05 to 5"),
        ("track", {"target": ""}, "target must be a text"),
        ("resume", [1], "the body must be a JSON object"),
    ],
)
def test_a_mistake_says_what_to_send_instead(page_box: Start, path: str, values: object, says: str) -> None:
    async def main() -> None:
        async with page_box() as box:
            await box.pair()
            status, told = await box.post(path, values)
            assert status == 400
            assert says in told["error"]
            assert box.world.drives() == OFF

    asyncio.run(main())


def test_a_person_on_the_page_is_told_who_holds_the_antenna_and_takes_it_over(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
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

    asyncio.run(main())


def test_what_a_person_holds_no_other_on_the_page_parks_gives_back_or_ends(page_box: Start) -> None:
    async def main() -> None:
        async with page_box('[station]\nlocator = "JO62qm"\n') as box:
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

    asyncio.run(main())


def test_who_is_revoked_while_holding_the_antenna_holds_it_no_more(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
            me = await box.pair("lost phone")
            await box.post("point", {"azimuth_deg": 300, "elevation_deg": 60})
            await box.until(lambda: box.world.drives() != OFF and bool(box.status.held_by))
            assert (await box.post("revoke", {"number": me["number"]}))[0] == 200
            await box.until(lambda: box.world.drives() == OFF and box.status.held_by == "")
            assert (await box.pair("another"))["number"] == 2

    asyncio.run(main())


def test_the_description_names_every_path_and_only_those(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
            status, told = await box.get("openapi.json")
            assert status == 200
            for path, ways in told["paths"].items():
                for way in ways:
                    async with box.http.request(way.upper(), f"{box.url}{path}", json={}) as answer:
                        assert answer.status != 404, f"{way} {path}"
            assert {f"/api/{method.name}" for method in METHODS} <= told["paths"].keys()

    asyncio.run(main())


def test_reading_can_be_closed_and_stop_stays(page_box: Start) -> None:
    async def main() -> None:
        async with page_box(page='reading = "paired"') as box:
            for path in ("status", "box", "past", "live"):
                assert (await box.get(path))[0] == 401
            assert (await box.post("stop"))[0] == 200
            await box.pair()
            assert (await box.get("status"))[0] == 200

    asyncio.run(main())


def test_pairings_outlive_the_box(page_box: Start) -> None:
    async def main() -> None:
        async with page_box() as box:
            await box.pair("Anna's phone")
            cookies = {each.key: each.value for each in box.http.cookie_jar}
        async with page_box() as box, box.http.get(f"{box.url}/api/me", cookies=cookies) as answer:
            assert json.loads(await answer.text())["name"] == "Anna's phone"

    asyncio.run(main())


def test_a_taken_port_is_said_and_the_box_runs(page_box: Start, caplog: Any) -> None:
    async def main() -> None:
        async with page_box() as box:
            place = box.url.removeprefix("http://")
            page = page_of(box.app)
            page.start()
            page.stop()
            assert page.wire.state == "closed"
            assert f"there is no page: {place}: cannot listen there: Address already in use" in caplog.text
            assert (await box.get("status"))[0] == 200

    asyncio.run(main())


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


def test_a_late_resume_does_not_undo_a_stop_that_its_sender_has_not_seen(page_box: Start) -> None:
    """A request may hang in the air for seconds, and a stop overtakes it: it names the stops that it knows."""

    async def main() -> None:
        async with page_box() as box:
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

    asyncio.run(main())
