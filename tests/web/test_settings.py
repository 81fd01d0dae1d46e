"""The settings by the page's API: checked by the loader, written whole, refused to strangers and to latecomers."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from rotator.config.load import load, shipped
from rotator.exchange.sources import Source
from rotator.exchange.status import Latch
from rotator.runtime.anew import Anew
from tests.web.conftest import PATIENCE_S, Box, Start, with_box

REMARK = "[station]\nlocator = 'JO62qm' # my garden\n"


def change(place: list[Any], value: object) -> dict[str, object]:
    return {"place": place, "value": value}


async def change_from(box: Box, *changes: dict[str, object], **more: object) -> dict[str, object]:
    _, told = await box.get("settings")
    return {"digest": told["digest"], "changes": list(changes), **more}


@with_box(REMARK, file=True)
async def test_a_change_is_shown_then_written_with_the_old_file_beside_it(box: Box, file: Path) -> None:
    await box.pair()
    before = file.read_text()
    wanted = await change_from(box, change(["station", "locator"], "JN58td"))
    status, told = await box.post("settings/check", wanted)
    assert status == 200
    assert told["mistakes"] == []
    assert '+locator = "JN58td" # my garden' in told["diff"]
    assert told["changes"] == [{"place": ["station", "locator"], "before": "JO62qm", "after": "JN58td"}]
    assert file.read_text() == before, "a check writes nothing"
    assert (await box.post("settings/write", wanted))[0] == 200
    assert load(file).station.locator == "JN58td"
    assert file.with_name("r.toml.bak").read_text() == before
    await box.until(lambda: box.anew.asked)


@with_box(REMARK, file=True)
async def test_a_mistake_is_told_beside_its_key_in_the_loaders_words(box: Box, file: Path) -> None:
    await box.pair()
    before = file.read_text()
    wanted = await change_from(
        box, change(["azimuth", "tolerance_deg"], 99), change(["link", 0, "bauds"], 1), change(["lcds", "x"], 1)
    )
    status, told = await box.post("settings/check", wanted)
    assert status == 200
    found = [(each["places"], each["text"]) for each in told["mistakes"]]
    assert (
        [["azimuth", "tolerance_deg"]],
        "azimuth.tolerance_deg = 99: must be less than or equal to 45",
    ) in found
    assert ([["link", 0, "bauds"]], "the first [[link]]: bauds = 1: no such key; did you mean baud?") in found
    assert any(places == [["lcds"]] and "no such table; did you mean [lcd]?" in text for places, text in found)
    status, told = await box.post("settings/write", wanted)
    assert status == 422
    assert file.read_text() == before
    assert not box.anew.asked


@with_box(REMARK, file=True)
async def test_the_second_of_two_browsers_is_told_that_the_file_has_changed(box: Box, file: Path) -> None:
    await box.pair()
    anna = await change_from(box, change(["station", "locator"], "JN58td"))
    bert = await change_from(box, change(["azimuth", "offset_deg"], 3))
    assert (await box.post("settings/write", anna))[0] == 200
    written = file.read_text()
    for path in ("settings/check", "settings/write"):
        status, told = await box.post(path, bert)
        assert status == 409
        assert "has been changed meanwhile" in told["error"]
    assert file.read_text() == written


NO_CHANGES: list[list[dict[str, object]]] = [
    [change(["../../etc", "passwd"], 1)],
    [change(["link", 99], None)],
    [change([], None)],
    [change(["a"] * 99, None)],
    [change(["azimuth", "max_deg"], 1)] * 600,
]


@with_box(REMARK, file=True)
async def test_what_is_no_change_is_refused(box: Box, file: Path) -> None:
    await box.pair()
    before = file.read_text()
    for changes in NO_CHANGES:
        status, told = await box.post("settings/write", await change_from(box, *changes))
        assert (status, bool(told["error"])) == (400, True), changes
    assert file.read_text() == before


@with_box(REMARK, file=True)
async def test_a_new_start_never_stops_the_antenna_unsaid(box: Box, file: Path) -> None:
    await box.pair()
    await box.post("point", {"azimuth_deg": 200, "elevation_deg": 60})
    await box.until(lambda: box.status.moving)
    wanted = await change_from(box, change(["azimuth", "offset_deg"], 3))
    for path, body in (("settings/write", wanted), ("restart", {})):
        status, told = await box.post(path, body)
        assert status == 409
        assert "the antenna moves, and the new start stops it" in told["error"]
    assert load(file).azimuth.offset_deg == 0
    assert (await box.post("settings/write", {**wanted, "stop": True}))[0] == 200
    await box.until(lambda: box.anew.asked)


async def test_a_box_without_a_file_gets_one(page_box: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    own = tmp_path / "rotator.toml"
    async with page_box() as box:
        assert (await box.post("settings/file"))[0] == 401
        await box.pair()
        _, told = await box.get("settings")
        assert (told["file"], told["used"], told["there"]) == (str(own), False, False)
        assert told["in_force"]["rotor"]["hardware"] == "sim"
        assert not own.exists()
        assert await box.post("settings/file") == (200, {"ok": True, "run": told["run"]})
        await box.until(lambda: box.anew.asked)
        assert (box.anew.file, own.read_text()) == (own, shipped())


@pytest.mark.parametrize(
    ("path", "more"),
    [("settings/write", {"changes": [change(["station", "locator"], "JO62qm")]}), ("calibrate", {"axis": "azimuth"})],
)
async def test_what_needs_a_file_makes_it(
    page_box: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str, more: dict[str, object]
) -> None:
    monkeypatch.chdir(tmp_path)
    async with page_box() as box:
        await box.pair()
        _, told = await box.get("settings")
        begun = {"digest": told["digest"]} if "changes" in more else {}
        assert (await box.post(path, {**begun, **more}))[0] == 200
        await box.until(lambda: box.anew.asked)
        assert box.anew.file == tmp_path / "rotator.toml"
        assert load(box.anew.file).station.locator == ("JO62qm" if begun else None)


@pytest.mark.parametrize(
    ("text", "status"), [("[azimuth]\nmax_deg = 400\n", 200), ("[azimuth]\nmax_deg = true\n", 409), ("", 409)]
)
async def test_a_file_that_is_there_is_taken_as_it_is_or_refused(
    page_box: Start, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, status: int
) -> None:
    monkeypatch.chdir(tmp_path)
    own = tmp_path / "rotator.toml"
    own.write_text(text)
    async with page_box() as box:
        await box.pair()
        assert (await box.post("settings/file"))[0] == status
        assert box.anew.file == (own if status == 200 else None)
        assert own.read_text() == text


@with_box(file=True)
async def test_every_table_and_key_of_the_model_has_a_form(box: Box) -> None:
    await box.pair()
    status, told = await box.get("settings/form")
    async with asyncio.timeout(PATIENCE_S):
        while status == 202:
            status, told = await box.get("settings/form")
    tables = {".".join(table["path"]): table for table in told["tables"]}
    assert tables["link"]["many"]
    (found,) = [key for key in tables["azimuth"]["keys"] if key["key"] == "tolerance_deg"]
    assert found == {
        "key": "tolerance_deg", "kind": "number", "unit": "°", "above": 0, "most": 45, "needed": False,
        "meaning": "The pointing error on the sky at which a motor starts.",
    }  # fmt: skip
    assert all(key["meaning"] for table in told["tables"] for key in table["keys"])


@with_box(file=True)
async def test_a_stop_and_a_hold_outlive_the_new_start(box: Box) -> None:
    me = await box.pair()
    await box.post("take")
    await box.post("stop")
    await box.until(lambda: bool(box.status.latched and box.status.held_by))
    anew = Anew()
    anew.ask(box.status)
    browser = Source("page", me["number"])
    assert (anew.holder, anew.latch) == (browser, Latch(str(browser)))
