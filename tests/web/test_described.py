"""The API is what it says: each answer as described, each example taken for what it is, each wrong value refused."""

from __future__ import annotations

import asyncio
import json
import re
import time
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.calibrating.on_page import PageCalibration
from rotator.config.load import parse
from rotator.store.flown import FlownPass, FlownPasses, picture_name
from rotator.web import assets
from tests.boxes import file_with_page
from tests.web.conftest import PATIENCE_S, Box, Start, with_box
from tests.web.described import Described, of_another_kind
from tests.web.test_sky import FOLLOWS, TLE, send

NO_TOKEN, MAY_READ, TOKEN = 0, 3, 2
"""By the number of ways to show who asks."""
FOR_ALL = {"get me", "get openapi.json", "post pair/begin", "post pair", "post stop"}
FOR_READERS = {
    *(
        "get status",
        "get box",
        "get past",
        "get path",
        "get live",
        "get passes",
        "get next",
        "get followed",
        "get sky",
        "get unreached",
    ),
    *("get elements", "get flown", "get flown/picture", "get flown/table", "get doctor", "post demo"),
    "get passes.ics",
}
"""All else needs a token: who orders, changes, or sees names, bytes and the file."""


async def description(box: Box) -> Described:
    status, told = await box.get("openapi.json")
    assert status == 200
    return Described(told)


async def asked(box: Box, way: str, path: str, **more: Any) -> tuple[int, str, bytes]:
    """Until it is computed."""
    async with asyncio.timeout(PATIENCE_S):
        while True:
            async with box.http.request(way, f"{box.url}{path}", **more) as answer:
                found = answer.status, answer.content_type, await answer.read()
            if found[0] not in (202, 503):
                return found
            await asyncio.sleep(0.05)


@pytest.mark.long
@pytest.mark.parametrize("more", ["", FOLLOWS], ids=["bare", "with a sky"])
async def test_every_answer_is_as_described(page_box: Start, file: Path, tmp_path: Path, more: str) -> None:
    flown = FlownPass(picture_name("ISS", 1.7e9), "ISS", 1.7e9, 1.7e9 + 600, 0.4, 1.2, None)
    FlownPasses(tmp_path).keep(flown, "<svg/>", "utc,t\n")
    async with page_box(more, file=file) as box:
        await box.pair()
        if more:
            await send(box, "mine.tle", TLE)
            assert (await box.post("track", {"target": "Moon"}))[0] == 200
        told = await description(box)
        for path, one in told.routes("get"):
            query = {"file": flown.file} if path.startswith("/api/flown/") else {}
            found = await asked(box, "GET", path, params=query)
            is_socket = "101" in one["responses"]
            computed = not {"202", "503"}.isdisjoint(one["responses"]) and not more
            assert found[0] == 400 if is_socket else found[0] == 200 or (computed and found[0] == 409), (
                path,
                found,
            )
            told.judge(one, *found)
        assert (await box.post("track", {"target": "off"}))[0] == 200
        assert (await box.post("stop"))[0] == 200
        told.judge(dict(told.routes("get"))["/api/status"], *await asked(box, "GET", "/api/status"))


async def test_what_a_calibration_says_is_as_described(page_box: Start, tmp_path: Path, file: Path) -> None:
    config = parse(file_with_page(tmp_path, 1), "a test's file")
    calibration = PageCalibration(config, Axis.AZIMUTH, file, time.monotonic)
    async with page_box() as box:
        told = await description(box)
        told.answers("/api/calibration", calibration.shown())


async def test_what_a_socket_sends_is_described_in_words_and_the_picture_by_its_schema(box: Box) -> None:
    await box.pair()
    told = await description(box)
    for path, one in told.routes("get"):
        if "101" not in one["responses"]:
            continue
        async with box.http.ws_connect(f"{box.url}{path}") as socket:
            messages = [await socket.receive_json()]
            if path == "/api/live":
                messages.append(await socket.receive_json())
                await socket.send_str('{"hold": "cw", "press": 1, "n": 0}')
                while "refused" not in messages[-1]:
                    messages.append(await socket.receive_json())
        examples = re.findall(r"^ {4}(\{.*\})$", one["description"], re.MULTILINE)
        forms = {tuple(sorted(json.loads(text.replace("{…}", "{}")))) for text in examples}
        assert {tuple(sorted(message)) for message in messages} <= forms
        for message in messages:
            if "now" in message:
                told.valid({"$ref": "#/components/schemas/picture"}, message["now"])
            if "hello" in message:
                told.answers("/api/box", message["hello"].pop("box"))
                told.answers("/api/me", message["hello"])


@pytest.mark.long
@pytest.mark.parametrize("reading", ["open", "paired"])
async def test_who_may_ask_is_as_described(page_box: Start, reading: str) -> None:
    async with page_box(page=f'reading = "{reading}"') as box:
        told = await description(box)
        for way in ("get", "post"):
            for path, one in told.routes(way):
                status, kind, body = await asked(box, way, path)
                name = f"{way} {path.removeprefix('/api/')}"
                needs = NO_TOKEN if name in FOR_ALL else MAY_READ if name in FOR_READERS else TOKEN
                assert len(one["security"]) == needs, name
                assert (status == 401) == (needs == TOKEN or (needs == MAY_READ and reading == "paired")), name
                if status != 200:
                    told.judge(one, status, kind, body)


@with_box(FOLLOWS, file=True)
async def test_every_example_has_a_form_that_the_box_takes(box: Box) -> None:
    await box.pair()
    told = await description(box)
    for path, one in told.routes("post"):
        for form in told.bodies(one):
            told.valid(form, form["examples"][0])
            found = await asked(box, "POST", path, json=form["examples"][0])
            assert found[0] != 400, (path, found)
            told.judge(one, *found)


@with_box(FOLLOWS, file=True)
async def test_one_value_of_another_kind_is_refused_with_a_sentence(box: Box, file: Path) -> None:
    await box.pair()
    told = await description(box)
    before = file.read_text()
    for path, one in told.routes("post"):
        for form in told.bodies(one):
            example = form["examples"][0]
            changed = [{**example, name: of_another_kind(example.get(name, True))} for name in form["properties"]]
            for wrong in (*changed, {**example, "surplus": 1}, [example]):
                status, kind, body = await asked(box, "POST", path, json=wrong)
                assert status == 400, (path, wrong, body)
                told.judge(one, status, kind, body)
                assert " " in json.loads(body)["error"]
    assert file.read_text() == before
    assert not box.anew.asked
    assert not box.status.moving


async def test_all_that_the_page_asks_for_is_described(box: Box) -> None:
    told = await description(box)
    scripts = [file.plain.decode() for path, file in assets.load().items() if re.fullmatch(r"/\w+\.js", path)]
    for way, calls in {"get": "read|load", "post": "post|change|upload|send"}.items():
        named = {name for text in scripts for name in re.findall(rf'\b(?:{calls})\("([a-z/-]+)', text)}
        assert len(named) > 5
        assert {f"/api/{name}" for name in named} <= dict(told.routes(way)).keys()
