"""The page for everybody: axe finds nothing, no size scrolls sideways, every control has a name and a key."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import Station, headline, pair, violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
SIZES = {"phone": (360, 740), "phone on its side": (844, 390), "tablet": (820, 1180), "wide": (1600, 900)}
BUSY = """
[station]
locator = "JO62qm"
[mount]
horizon = [[0, 5], [60, 12], [180, 3], [250, 15]]
[[mount.forbidden]]
name = "chimney"
azimuth_deg = [290, 320]
elevation_deg = [0, 35]
"""


ELEMENTS = Path(__file__).parents[1] / "orbits" / "elements-2025.tle"
SEES_SKY = f"""{BUSY}
[sky]
elements = ["{ELEMENTS}"]
[[sky.follow]]
name = "moon"
"""


@pytest.mark.parametrize("light", ["light", "dark"])
def test_axe_finds_nothing(start: Start, visit: Visit, light: str) -> None:
    station = start(BUSY)
    page = visit(station, color_scheme=light)
    assert violations(page) == [], "looking on"
    pair(page)
    assert violations(page) == [], "paired"
    page.get_by_role("button", name="To the park position").click()
    assert violations(page) == [], "a question"
    page.keyboard.press("Escape")
    headline(page, "STOPPED by")
    assert violations(page) == [], "stopped"
    page.get_by_role("link", name="Help").click()
    page.locator(".doctor li").first.wait_for()
    assert violations(page) == [], "doctor"
    page.get_by_role("link", name="Wires").click()
    page.get_by_role("region", name="Bytes of the links").wait_for()
    assert violations(page) == [], "wires"
    page.get_by_role("link", name="Files").click()
    page.get_by_role("link", name="Save a backup").wait_for()
    assert violations(page) == [], "files"
    page.get_by_role("link", name="Log").click()
    page.locator(".log td", has_text="stopped by").first.wait_for()
    assert violations(page) == [], "log"
    page.locator(".connection a").click()
    page.get_by_text("Paired browsers").wait_for()
    assert violations(page) == [], "browsers"
    page.get_by_role("link", name="the API").click()
    page.locator("summary", has_text="/api/point").click()
    page.get_by_text("clockwise from true north").wait_for()
    assert violations(page) == [], "the API"
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the API"


@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_wider_than_the_screen_and_stop_is_on_it(start: Start, visit: Visit, size: str) -> None:
    station = start(BUSY)
    width, height = SIZES[size]
    page = visit(station, viewport={"width": width, "height": height}, is_mobile="phone" in size, has_touch=True)
    pair(page)
    for view in ("Antenna", "Help", "Wires", "Log", "Files", "test"):
        page.get_by_role("link", name=view).click()
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        stop = page.locator("#stop").bounding_box()
        assert stop is not None
        assert stop["width"] == width
        assert stop["y"] + stop["height"] == height


# By the letters of the view's link. Of the Plan the table of passes is waited for, of Setup every step is opened.
VIEWS = {
    "Antenna": ".board",
    "Plan": ".passes td",
    "Setup": ".step",
    "Help": ".doctor li",
    "Log": ".log td",
    "Pass": ".passmode",
}
COMPUTED_MS = 150_000
"""Passes and checks take their time on a busy machine."""
BEYOND = """() => {
    const width = document.documentElement.clientWidth, seen = [];
    for (const one of document.querySelectorAll("body *:not(svg *)")) {
        const { left, right, width: own } = one.getBoundingClientRect(), style = getComputedStyle(one);
        if (!own || style.clipPath !== "none" || one.parentElement.closest("pre, .strip, .scroller")) continue;
        const cut = one.matches("button, a, dd, dt, h1, h2, h3, p, td") && style.display !== "inline"
            && one.scrollWidth > one.clientWidth + 1;
        if (right > width + 1 || left < -1 || cut) seen.push(`${one.tagName}.${one.className}: ${one.textContent}`);
    }
    return seen;
}"""
"""What is beyond the window's sides, or cut at its own."""
SMALL = """() => [...document.querySelectorAll("button, nav a")].filter((one) => one.checkVisibility()
    && one.getBoundingClientRect().height < 43.9).map((one) => one.textContent)"""
"""What a thumb misses."""


@pytest.mark.parametrize(("width", "height"), [(320, 568), (390, 844)])
def test_larger_text_leaves_stop_on_the_screen(start: Start, visit: Visit, width: int, height: int) -> None:
    """As a person sets it in the phone; with a fault, which has the longest texts."""
    station = start(SEES_SKY, "--fault", "azimuth-pot-open@1")
    page = visit(station, viewport={"width": width, "height": height}, is_mobile=True, has_touch=True)
    pair(page)
    headline(page, "FAULT")
    for view, shows in VIEWS.items():
        page.get_by_role("link", name=view, exact=True).first.evaluate("link => link.click()")
        page.locator(shows).first.wait_for(timeout=COMPUTED_MS)
        for step in page.locator(".step > summary").all():
            step.evaluate("summary => summary.click()")
        assert page.evaluate(SMALL) == [], view
        for percent in (100, 130, 200):
            page.evaluate(f"document.documentElement.style.fontSize = '{percent}%'")
            assert page.evaluate(BEYOND) == [], (view, percent)
            stop = page.locator("#stop").bounding_box()
            assert stop is not None
            placed = stop["x"], stop["width"], round(stop["y"] + stop["height"])
            assert placed == (0, width, height), (view, percent)
            assert page.evaluate("visualViewport.width") == width, (view, percent)
        page.evaluate("document.documentElement.style.fontSize = ''")


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
