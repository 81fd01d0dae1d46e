"""A timed table that is sent to the page is tracked, or refused with its line, as the console does it."""

from __future__ import annotations

import asyncio
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest

from rotator.protocols.table_text import TableError, read_table
from rotator.web.tables import MOST_BYTES
from tests.web.conftest import OFF, PATIENCE_S, Box
from tests.web.test_orders import at_the_console

GOOD = b"t,az,el\n20,30,5\n40,50,20\n"


async def send(box: Box, content: bytes, name: str = "my pass.csv") -> tuple[int, dict[str, Any]]:
    async with box.http.post(f"{box.url}/api/track-table", params={"name": name}, data=content) as answer:
        return answer.status, await answer.json()


async def test_a_table_is_tracked_and_who_sent_it_holds_the_antenna(box: Box) -> None:
    assert (await send(box, GOOD))[0] == 401
    await box.pair("Anna")
    assert await send(box, GOOD) == (200, {"ok": True})
    await box.until(lambda: box.status.flown is not None)
    assert box.status.flown is not None
    assert box.status.flown.name == "my-pass"
    assert box.status.flown.table
    assert box.status.held_by == "page#1"
    assert (await box.post("track", {"target": "off"}))[0] == 200
    await box.until(lambda: box.status.flown is None)


def utc(from_now_s: float) -> str:
    return datetime.fromtimestamp(time.time() + from_now_s, UTC).isoformat()


WRONG = {
    "empty": b"",
    "a picture": b"\x89PNG\xff",
    "another form": b"<html></html>",
    "back": b"t,az,el\n100,20,5\n40,60,30\n",
    "twice": b"t,az,el\n10,20,5\n10,20,5\n",
    "nan": b"t,az,el\n10,nan,5\n20,30,10\n",
    "endless": b"t,az,el\n10,20,5\n1e999,30,10\n",
    "one row": b"t,az,el\n10,20,5\n",
    "a jump": b"t,az,el\n10,20,5\n20,200,5\n",
    "no clock": b"t,az,el\n1970-01-01T00:00:20Z,20,5\n40,30,10\n",
}


async def test_a_table_with_a_mistake_moves_nothing(box: Box) -> None:
    await box.pair()
    for name, table in WRONG.items():
        status, told = await send(box, table, "bad.csv")
        assert (status, told["error"][:8]) == (400, "bad.csv:"), name
        assert box.world.drives() == OFF
        assert box.status.flown is None


async def test_what_no_antenna_can_follow_is_told_and_moves_nothing(box: Box, tmp_path: Path) -> None:
    await box.pair()
    assert (await send(box, b"", name=""))[0] == 400
    assert (await send(box, b"t" * (MOST_BYTES + 1)))[0] == 413
    over = f"t,az,el\n{utc(-500)},20,5\n{utc(-400)},30,10\n"
    early = "t,az,el\n1970-01-01T00:00:20Z,20,5\n1970-01-01T00:00:40Z,30,10\n"
    for name, table in (("over", over), ("early", early)):
        assert (await send(box, table.encode(), f"{name}.csv"))[0] == 200
        async with asyncio.timeout(PATIENCE_S):
            while await at_the_console(tmp_path, "track") != [f"ended: {name} is over"]:
                await asyncio.sleep(0.05)
    assert box.world.drives() == OFF


@pytest.mark.parametrize("moment", ["1970-01-01T00:00:20Z", "19700101 00:00:20", "1999-12-31T23:59:59+02:00"])
def test_a_moment_is_never_taken_for_seconds_from_now(moment: str) -> None:
    """As a computer writes it whose clock was never set."""
    later = "2001-09-09T01:46:41Z"
    with pytest.raises(TableError, match="write each t in seconds, or each in UTC"):
        read_table(f"t,az,el\n{moment},20,5\n946684900,21,5\n", "x", "x")
    with pytest.raises(TableError, match="a day is the most"):
        read_table(f"t,az,el\n{moment},20,5\n{later},21,5\n", "x", "x")
    minute = moment.replace("00:20", "00:50").replace("23:59:59", "23:59:59.9")
    assert read_table(f"t,az,el\n{moment},20,5\n{minute},21,5\n", "x", "x").utc
