"""The page for everybody: axe finds nothing, no size scrolls sideways, every control has a name and a key."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from benchmarks.sky_now import as_json, rises_in, satellite, sets_in
from tests.page.conftest import Station, code_at_the_box, headline, pair
from tests.page.sizes import misfits
from tests.page.test_sky import COMPUTED_MS, LOCATOR, SITE

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
BUSY = f"""
[station]
locator = "{LOCATOR}"
[mount]
horizon = [[0, 5], [60, 12], [180, 3], [250, 15]]
[[mount.forbidden]]
name = "chimney"
azimuth_deg = [290, 320]
elevation_deg = [0, 35]
[sky]
elements = ["FOLDER/made.json"]
[[sky.follow]]
name = "COMING"
[[sky.follow]]
name = "moon"
"""
UP_S, SOON_S = 480.0, 1500.0
PAIR = """code => fetch("/api/pair", { method: "POST", headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ code, name: "Handy" }) })"""
PARK = "[id^=step-][id$=park_azimuth_deg]"
HELP = {"doctor": ".doctor li", "wires": ".bytes", "log": ".log td", "files": ".files", "paired": ".paired li"}
"""By the name in the address."""


def busy(folder: Path) -> str:
    """A station with a satellite that is up now, one that is planned, a horizon and a forbidden sector."""
    now_s = time.time()
    made = (
        satellite("GOING (AO-1)", 90_001, now_s, SITE, sets_in(now_s, UP_S)),
        satellite("COMING", 90_002, now_s, SITE, rises_in(now_s, SOON_S)),
    )
    (folder / "made.json").write_text(as_json(made), encoding="utf-8")
    return BUSY.replace("FOLDER", str(folder))


def pair_unasked(page: Page) -> None:
    """In any language: only the words of the form are left out."""
    page.evaluate(PAIR, code_at_the_box(page))
    page.reload()
    page.locator(".jogpad").wait_for()


def show(page: Page, view: str, shows: str) -> None:
    page.evaluate("view => (location.hash = view)", view)
    page.locator(shows).first.wait_for(timeout=COMPUTED_MS)


def first_view(page: Page, tell: Callable[..., str]) -> Iterator[str]:
    """By the class names of its parts: it is walked in two languages."""
    page.locator(".up circle").first.wait_for(timeout=COMPUTED_MS)
    yield "looking on"
    page.locator(".pair .go").click()
    page.locator(".pair .code").fill("000000")
    page.locator(".pair form .go").click()
    page.locator(".pair .said").filter(has_text=re.compile(".")).wait_for()
    yield "a wrong code"
    pair_unasked(page)
    page.locator(".favourites .quiet").click()
    page.locator(".favourites li").first.wait_for()
    yield "the favourites are changed"
    page.locator(".favourites .quiet").first.click()
    page.locator(".upnow button").last.click(timeout=COMPUTED_MS)
    page.locator(".picked").wait_for()
    page.locator(".hand .orders > button").first.click()
    page.locator(".hand .asks").wait_for()
    yield "the first view, a satellite, a question"
    page.keyboard.press("Escape")
    page.locator(".troubles button").wait_for()
    yield "stopped"
    tell("resume")
    page.locator(".troubles").wait_for(state="detached")


def other_views(page: Page, tell: Callable[..., str]) -> Iterator[str]:
    show(page, "sky", ".passes td")
    page.locator(".timeline .bar").first.press("Enter")
    page.locator(".timeline .chosen").wait_for()
    yield "plan"
    show(page, "pass", ".passmode")
    tell("point", "180", "40")
    page.locator(".nudge button:enabled").first.wait_for()
    yield "pass"
    tell("track", "off")
    show(page, "setup", ".step")
    yield "setup"
    for step in page.locator(".step > summary").all():
        step.press("Enter")
    page.locator(".wiring svg").wait_for()
    page.locator(PARK).fill("95")
    page.locator(f".settings:has({PARK}) .actions .go").click()
    page.locator(".proposed summary").press("Enter")
    yield "all steps of setup, a change"
    for view, shows in HELP.items():
        show(page, view, shows)
        yield view
    show(page, "setup", ".step")
    page.locator(".step > summary").nth(6).press("Enter")
    page.locator(".step > summary").nth(7).press("Enter")
    page.locator(PARK).fill("5000")
    page.locator(f".settings:has({PARK}) .actions .go").click()
    page.locator(".field .mistake").first.wait_for()
    page.locator("#elements-from").fill("https://celestrak.org/NORAD/elements/gp.php?GROUP=amateur&FORMAT=json")
    page.locator(".place .go").click()
    page.locator(".place .proposed").wait_for()
    yield "a mistake, and a change with long addresses"
    page.locator(".step > summary").nth(6).press("Enter")
    page.locator(".step > summary").nth(7).press("Enter")
    page.locator(".step > summary").nth(4).press("Enter")
    page.locator(".step[open] .go").last.click()
    page.locator(".guide .jog").first.wait_for(timeout=COMPUTED_MS)
    page.locator(".guide-top button").click()
    page.locator(".guide .asks").wait_for()
    yield "a calibration, and its end"
    page.goto(f"{page.url.partition('#')[0]}api/")
    page.locator("summary", has_text="/api/point").click()
    page.get_by_text("clockwise from true north").wait_for()
    yield "the API"


@pytest.mark.parametrize(("language", "light"), [("en", "light"), ("de", "dark")])
def test_every_view_fits_every_window(start: Start, visit: Visit, tmp_path: Path, language: str, light: str) -> None:
    station = start(busy(tmp_path))
    how = {"viewport": {"width": 1366, "height": 768}, "has_touch": True}
    page = visit(station, locale=language, color_scheme=light, **how)
    found = [
        each
        for views in (first_view, other_views)
        for view in views(page, station.tell)
        for each in misfits(page, view)
    ]
    assert not found, "\n".join(found)


def test_a_fault_fits_every_window(start: Start, visit: Visit) -> None:
    """It has the longest texts."""
    page = visit(start("", "--fault", "azimuth-pot-open@1"), locale="de")
    page.locator(".troubles").wait_for()
    pair_unasked(page)
    found = misfits(page, "a fault")
    page.evaluate("location.hash = 'pass'")
    page.locator(".passmode").wait_for()
    found += misfits(page, "a fault, at the antenna")
    assert not found, "\n".join(found)


def test_the_keyboard_alone_points_and_turns(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page)
    page.get_by_label("Azimuth", exact=True).focus()
    page.keyboard.type("45")
    page.keyboard.press("Tab")
    page.keyboard.type("20")
    page.keyboard.press("Enter")
    headline(page, "ON TARGET")
    page.get_by_role("button", name="Hold to turn CW", exact=True).focus()
    page.keyboard.down("Space")
    page.locator(".front .lamps .on", has_text="CW").wait_for()
    page.keyboard.up("Space")
    page.locator(".front .lamps .on").wait_for(state="detached")


def test_a_question_takes_the_keys_and_gives_them_back(start: Start, visit: Visit) -> None:
    page = visit(start())
    pair(page)
    page.get_by_role("button", name="To the park position").press("Enter")
    page.locator(".asks button:focus", has_text="No").press("Enter")
    page.locator("button:focus", has_text="To the park position").wait_for()


def test_what_changes_each_second_is_not_read_out(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    station.process.terminate()
    station.process.wait()
    page.get_by_text("no connection: this is").wait_for()
    assert page.locator(".connection").get_by_role("status").inner_text() == "no connection"
