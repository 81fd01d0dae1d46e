"""The plan as a calendar: another library reads it, whatever a satellite is called."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime
from typing import Any

import icalendar

from rotator.web.calendar import LINE_BYTES, calendar
from tests.web.conftest import PATIENCE_S, Box, with_box
from tests.web.test_sky import FOLLOWS, TLE, send

NAMES = ("ISS", "AO-7, old; but \\ alive", "Чебурашка на орбите и очень длинное имя спутника №1 🛰🛰🛰")


def planned(name: str, *, top: str = "2026-11-28T12:04:00Z", **more: Any) -> dict[str, Any]:
    times = {"from": "2026-11-28T12:05:00Z", "until": "2026-11-28T12:15:00Z", "set_off": "2026-11-28T12:03:30Z"}
    return {"name": name, "tca": top, "max_el_deg": 77.4, "flown": True, "reason": None, **times, **more}


def events(text: str) -> list[Any]:
    return icalendar.Calendar.from_ical(text).walk("VEVENT")


def test_another_library_reads_every_name_and_moment_in_utc() -> None:
    text = calendar([planned(name) for name in NAMES], 1.8e9)
    found = events(text)
    assert [str(each["SUMMARY"]) for each in found] == [f"{name}, 77° high" for name in NAMES]
    assert {each["DTSTART"].dt for each in found} == {datetime(2026, 11, 28, 12, 5, tzinfo=UTC)}
    assert {each["DTEND"].dt for each in found} == {datetime(2026, 11, 28, 12, 15, tzinfo=UTC)}
    assert {each["DTSTAMP"].dt.timestamp() for each in found} == {1.8e9}
    assert str(found[0]["DESCRIPTION"]) == "The antenna sets off at 12:03 UTC."
    assert all(len(line) <= LINE_BYTES for line in text.encode().split(b"\r\n"))
    assert "\n" not in text.replace("\r\n", "")


def test_a_pass_keeps_its_name_when_new_elements_shift_it_and_each_part_of_it_has_its_own() -> None:
    first = events(calendar([planned("ISS"), planned("ISS"), planned("SO-50", flown=False)], 1.8e9))
    later = events(calendar([planned("ISS", top="2026-11-28T12:04:40Z"), planned("ISS")], 1.9e9))
    assert [each["UID"] for each in first] == [each["UID"] for each in later]
    assert len({each["UID"] for each in first}) == 2


@with_box(FOLLOWS, file=True)
async def test_the_box_serves_its_plan_to_all_who_may_read(box: Box) -> None:
    await box.pair()
    await send(box, "mine.tle", TLE)
    async with asyncio.timeout(PATIENCE_S):
        while (await box.get("elements"))[1]["satellites"] != 3:
            await asyncio.sleep(0.05)
    box.http.cookie_jar.clear()
    async with asyncio.timeout(PATIENCE_S):
        while True:
            async with box.http.get(f"{box.url}/api/passes.ics") as answer:
                text = await answer.text()
            if answer.status == 200:
                break
            assert answer.status == 503, text
    assert answer.content_type == "text/calendar"
    found = events(text)
    assert found
    assert {str(each["SUMMARY"]).partition(",")[0] for each in found} <= {"ISS", "SO-50"}


@with_box()
async def test_without_a_plan_it_says_what_that_needs(box: Box) -> None:
    status, told = await box.get("passes.ics")
    assert status == 409
    assert "the box does not know where it stands" in told["error"]
