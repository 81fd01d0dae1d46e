"""The buttons of the favourites in Chromium: made, renamed, ordered, pressed, and there again after a restart."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from rotator.orbits.locator import distance_and_bearing, from_locator
from tests.page.conftest import Station, pair, violations
from tests.page.test_dashboard import waits_for
from tests.page.test_sky import LOCATOR

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
PRAGUE = "JO70fc"


def buttons(page: Page) -> list[str]:
    return page.locator("button.favourite").all_inner_texts()


def edited(page: Page) -> list[str]:
    names = page.locator(".favourites input[aria-label^='Name of']")
    return [str(name) for name in names.evaluate_all("names => names.map(name => name.value)")]


def add(page: Page, target: str, name: str) -> None:
    page.get_by_label("Satellite, place, direction or park").fill(target)
    page.get_by_label("Name of the button").fill(name)
    page.get_by_role("button", name="Add", exact=True).click()


def test_a_favourite_is_made_renamed_ordered_pressed_and_lasts(start: Start, visit: Visit, tmp_path: Path) -> None:
    place = f'[station]\nlocator = "{LOCATOR}"\n'
    station = start(place)
    page, other = visit(station), visit(station)
    pair(page)
    pair(other, "other")
    page.get_by_role("button", name="Edit favourites").click()
    add(page, "Nowhere", "lost")
    page.locator(".said", has_text='"Nowhere"').wait_for()
    add(page, PRAGUE, "Praha")
    page.get_by_role("button", name="Remove Praha", exact=True).wait_for()
    add(page, "143 5", "praha")
    page.locator(".said", has_text="there is a favourite praha already").wait_for()
    add(page, "Park", "home")
    page.get_by_role("button", name="Remove home", exact=True).wait_for()
    name = page.get_by_label("Name of Praha")
    name.fill("Prague")
    name.press("Enter")
    page.get_by_role("button", name="Remove Prague", exact=True).wait_for()
    for _ in range(len(edited(page)) - 2):
        up = page.get_by_role("button", name="Prague up")
        before = edited(page).index("Prague")
        up.click()
        waits_for(page, lambda before=before: edited(page).index("Prague") == before - 1)  # type: ignore[misc]
    page.get_by_role("button", name="Remove West").click()
    waits_for(page, lambda: "West" not in edited(page))
    page.get_by_role("button", name="Undo", exact=True).click()
    waits_for(page, lambda: "West" in edited(page))
    assert violations(page) == []
    page.get_by_role("button", name="Done").click()
    other.get_by_role("button", name="Prague", exact=True).click()
    _, bearing_deg = distance_and_bearing(from_locator(LOCATOR), from_locator(PRAGUE))
    waits_for(page, lambda: station.points(bearing_deg, 0.0))
    page.locator("button.favourite:disabled[title*='other holds the antenna']", has_text="East").wait_for()
    other.get_by_role("button", name="East", exact=True).click()
    waits_for(page, lambda: station.points(90.0, 0.0))
    other.get_by_role("button", name="home", exact=True).click()
    other.get_by_role("button", name="Let it move again").wait_for()
    waits_for(page, lambda: station.points(0.0, 0.0))
    station.process.terminate()
    assert station.process.wait(timeout=60.0) == 0
    again = visit(start(place))
    pair(again, "again")
    again.get_by_role("button", name="Prague", exact=True).wait_for()
    assert buttons(again)[0] == "Prague"
