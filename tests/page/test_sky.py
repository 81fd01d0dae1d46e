"""The Plan view in Chromium: a pass is tracked and its picture kept, elements sent, good and bad."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.sky_now import as_json, rises_in, satellite, sets_in
from rotator.orbits.earth import Site
from rotator.orbits.locator import from_locator
from tests.page.conftest import Station, pair, violations
from tests.page.test_dashboard import waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
LOCATOR = "JO62qm"
LONGITUDE_DEG, LATITUDE_DEG = from_locator(LOCATOR)
SITE = Site(LATITUDE_DEG, LONGITUDE_DEG, 0.0)
COMPUTED_MS = 150_000
"""Passes and plan are computed by a process of the least priority."""
UP_S = 75.0
"""So long the satellite is still up when the box starts: time to pair, and for a part of its pass to be flown."""


def place(folder: Path, *, follow: tuple[str, ...] = ()) -> str:
    """A station's tables, with satellites made for this moment: GOING sets soon, COMING rises later."""
    now_s = time.time()
    sets = (
        satellite("GOING", 90_001, now_s, SITE, sets_in(now_s, UP_S)),
        satellite("COMING", 90_002, now_s, SITE, rises_in(now_s, 900.0)),
        satellite("RIVAL", 90_003, now_s, SITE, rises_in(now_s, 930.0)),
    )
    (folder / "made.json").write_text(as_json(sets), encoding="utf-8")
    tables = "".join(f'[[sky.follow]]\nname = "{name}" # mine\n' for name in follow)
    return f'[station]\nlocator = "{LOCATOR}"\n[sky]\nelements = ["{folder}/made.json"]\n{tables}'


def test_a_press_tracks_a_satellite_and_its_pass_leaves_a_picture(start: Start, visit: Visit, tmp_path: Path) -> None:
    page = visit(start(place(tmp_path)))
    pair(page)
    page.locator(".headline", has_text="next COMING").wait_for(timeout=COMPUTED_MS)
    page.locator(".key.next", has_text="COMING").wait_for()
    page.get_by_role("link", name="Plan").click()
    page.get_by_label("Passes that reach, in degrees").fill("0")
    page.get_by_role("button", name="Track GOING").first.click(timeout=COMPUTED_MS)
    page.get_by_text("Tracks GOING").wait_for()
    picture = page.get_by_role("button", name="Picture of GOING")
    picture.wait_for(timeout=150_000)
    picture.click()
    image = page.locator(".flown img")
    image.scroll_into_view_if_needed()
    waits_for(page, lambda: bool(image.evaluate("image => image.complete && image.naturalWidth > 0")))
    assert violations(page) == []
    with page.expect_download() as kept:
        page.get_by_role("link", name="Keep the picture").click()
    text = kept.value.path().read_text(encoding="utf-8")
    assert ">GOING</text>" in text
    assert "rms off" in text


def test_a_table_of_directions_is_sent_and_tracked_and_a_mistake_in_it_is_told(
    start: Start, visit: Visit, tmp_path: Path
) -> None:
    """The box needs no place for it."""
    good, bad = tmp_path / "good.csv", tmp_path / "bad.csv"
    good.write_text("t,az,el\n60,20,5\n100,50,25\n", encoding="utf-8")
    bad.write_text("t,az,el\n60,20,5\n50,50,25\n", encoding="utf-8")
    page = visit(start())
    pair(page)
    page.get_by_role("link", name="Plan").click()
    page.get_by_label("Track a table of directions").set_input_files(bad)
    page.get_by_text("bad.csv:3: t must rise from row to row: 50 comes after 60").wait_for()
    page.get_by_label("Track a table of directions").set_input_files(good)
    page.get_by_text("Tracks good").wait_for(timeout=COMPUTED_MS)
    assert violations(page) == []


def test_elements_are_sent_whole_or_not_at_all(start: Start, visit: Visit, tmp_path: Path) -> None:
    page = visit(start(f'[station]\nlocator = "{LOCATOR}"\n'))
    pair(page)
    page.get_by_role("link", name="Plan").click()
    page.get_by_text("No satellite is known yet.").wait_for()
    now_s = time.time()
    good = as_json([satellite("MINE", 90_004, now_s, SITE, rises_in(now_s, 1800.0))])
    bad = json.dumps([*json.loads(good), {"OBJECT_NAME": "BROKEN", "NORAD_CAT_ID": 5}])
    send = page.get_by_label("Send a file")
    send.set_input_files({"name": "mine.json", "mimeType": "application/json", "buffer": bad.encode()})
    page.get_by_text("mine.txt is not taken: message 2 (BROKEN)").wait_for()
    assert list((tmp_path / "uploaded").iterdir()) == []
    send.set_input_files({"name": "mine.json", "mimeType": "application/json", "buffer": good.encode()})
    page.get_by_text("mine.txt is kept.").wait_for()
    page.get_by_text("1 satellite, ").wait_for()
    page.get_by_role("button", name="Track MINE").first.click(timeout=COMPUTED_MS)
    page.get_by_text("Tracks MINE").wait_for()
    page.get_by_role("button", name="Remove mine.txt").click()
    page.get_by_text("mine.txt is removed.").wait_for()
    page.get_by_text("No satellite is known yet.").wait_for()
