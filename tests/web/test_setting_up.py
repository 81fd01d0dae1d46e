"""Setting up by the page's API: the questions, the new file, the wiring, a calibration; strangers get none of it."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from tests.web.conftest import Box, with_box


async def questions(box: Box, **answers: object) -> dict[str, Any]:
    status, told = await box.post("setup/questions", {"answers": answers})
    assert status == 200, told
    return {each["name"]: each for each in told["questions"]}


@with_box("[station]\nlocator = 'JO62qm'\n", file=True)
async def test_the_questions_follow_the_answers(box: Box, file: Path) -> None:
    await box.pair()
    first = await questions(box)
    assert first["place"]["answer"] == "JO62qm", "as the file has it"
    assert "port" not in first
    assert "azimuth" not in await questions(box, rotor="isel")
    later = await questions(box, rotor="G-450", program="gs232b", azimuth="9000", place="nowhere at all")
    assert later["rotor"]["answer"] == "g450"
    assert "port" in later
    assert later["azimuth"]["mistake"] == "9000° cannot be: from 90 to 720"
    assert later["place"]["mistake"]


@with_box(file=True)
async def test_a_new_file_for_another_rotor_leaves_the_page_where_it_is(box: Box, file: Path) -> None:
    await box.pair()
    _, told = await box.get("settings")
    before = tomllib.loads(file.read_text())
    answers = {"rotor": "u100", "hardware": "sim", "program": "rotctld", "place": "JN58td"}
    status, _ = await box.post("settings/write", {"digest": told["digest"], "answers": answers})
    assert status == 200
    after = tomllib.loads(file.read_text())
    assert after["rotor"]["type"] == "relay-pulse"
    assert after["station"]["locator"] == "JN58td"
    assert (after["page"], after["state"]) == (before["page"], before["state"])


@pytest.mark.long
@pytest.mark.parametrize(
    "answers", [{"rotor": "toaster"}, {"azimuth": "-1"}, {"place": "x" * 500}, {"rotor": 7}], ids=str
)
@with_box(file=True)
async def test_an_answer_that_is_none_writes_nothing_wrong(box: Box, answers: dict[str, object]) -> None:
    await box.pair()
    _, told = await box.get("settings")
    status, told = await box.post("settings/check", {"digest": told["digest"], "answers": answers})
    assert status in (200, 400)
    assert status == 400 or not told["mistakes"]


@with_box(file=True)
async def test_rotctld_is_opened_to_one_network(box: Box, file: Path) -> None:
    await box.pair()
    _, told = await box.get("settings")
    for wrong in ("everybody", "", "300.1.1.1/24"):
        status, refused = await box.post("settings/check", {"digest": told["digest"], "open_to": wrong})
        assert (status, "is no network" in refused["error"]) == (400, True)
    status, _ = await box.post("settings/write", {"digest": told["digest"], "open_to": "192.168.7.9/24"})
    assert status == 200
    (link,) = [link for link in tomllib.loads(file.read_text())["link"] if link["protocol"] == "rotctld"]
    assert link["allow"] == ["127.0.0.1", "192.168.7.0/24"]


@with_box(file=True)
async def test_the_wiring_names_each_pin_and_chip(box: Box) -> None:
    await box.pair()
    _, told = await box.get("setup/wiring")
    keys = {each["key"] for each in told["pins"]}
    assert {"relays.azimuth_cw", "relays.azimuth_ccw", "relays.elevation_up", "relays.elevation_down"} <= keys
    assert told["chips"] == [{"bus": 1, "address": 0x48, "name": "ADS1115"}]


@with_box(file=True)
async def test_a_calibration_begins_with_a_new_start_and_its_keys_are_checked(box: Box, file: Path) -> None:
    await box.pair()
    assert (await box.post("calibration/press", {"keys": "r"}))[0] == 409
    for body in ({}, {"axis": "both"}, {"axis": "azimuth", "file": "/etc/passwd"}):
        assert (await box.post("calibrate", body))[0] == 400
    assert not box.anew.asked
    assert (await box.post("calibrate", {"axis": "elevation"}))[0] == 200
    await box.until(lambda: box.anew.asked)
    assert box.anew.sets_up is Axis.ELEVATION
