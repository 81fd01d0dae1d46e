"""The favourites on the page's API: replaced whole, kept, known to `track` by their names; what is wrong is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rotator.store.favourites import LONGEST_NAME, MOST
from tests.web.conftest import Box, Start, with_box

SOUTH = {"name": "beacon", "target": "143 5"}
PLACE = '[station]\nlocator = "JN18eu"\n'


async def listed(box: Box) -> Any:
    return (await box.get("favourites"))[1]["favourites"]


async def test_a_favourite_is_kept_and_moves_the_antenna_by_its_name(page_box: Start, tmp_path: Path) -> None:
    async with page_box(PLACE) as box:
        assert (await box.get("favourites"))[0] == 401
        await box.pair()
        first = await listed(box)
        assert [each["name"] for each in first] == ["Moon", "Sun", "North", "East", "South", "West"]
        change = {"favourites": [SOUTH, *first], "before": first}
        assert await box.post("favourites", change) == (200, {"favourites": change["favourites"]})
        assert (await box.post("favourites", change))[0] == 412, "another browser was quicker"
        assert await box.post("track", {"target": "Beacon"}) == (200, {"ok": True})
        await box.until(lambda: box.status.azimuth.target_deg == 143.0)
    async with page_box(PLACE) as box:
        await box.pair("the same")
        assert (await listed(box))[0] == SOUTH


@with_box(PLACE)
async def test_what_cannot_be_a_favourite_is_refused_in_words(box: Box) -> None:
    await box.pair()
    first = await listed(box)
    many = [{"name": str(number), "target": "Moon"} for number in range(MOST + 1)]
    for favourites, told in (
        ([{"name": " ", "target": "Moon"}], f"a favourite needs a name of 1 to {LONGEST_NAME} characters"),
        ([{"name": "x" * 31, "target": "Moon"}], f"a favourite needs a name of 1 to {LONGEST_NAME} characters"),
        ([{"name": "x", "target": ""}], "what the favourite x points at must be a text of 1 to 100 characters"),
        ([{"name": "x", "target": "Nowhere"}], '"Nowhere"'),
        ([{"name": "x", "target": "400 5"}], "azimuth is from 0 to 360"),
        ([SOUTH, {"name": "BEACON", "target": "Sun"}], "there is a favourite BEACON already"),
        (many, f"there is room for {MOST} favourites"),
        ([{"name": "x", "target": 5}], "favourites.0.target must be a valid string"),
        ("Moon", "favourites must be"),
    ):
        status, answer = await box.post("favourites", {"favourites": favourites, "before": first})
        assert status == 400, answer
        assert told in answer["error"]
    assert await listed(box) == first
