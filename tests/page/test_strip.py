"""What a person on a phone sees wherever the page is scrolled: the angles, a stop, why an order is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station, pair
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
STOP_FILLS_THE_FOOT = """() => {
    const seen = visualViewport, stop = document.getElementById("stop").getBoundingClientRect();
    const near = (one, other) => Math.abs(one - other) < 1;
    return near(stop.left, seen.offsetLeft) && near(stop.right, seen.offsetLeft + seen.width)
        && near(stop.bottom, seen.offsetTop + seen.height) && stop.height > 0;
}"""


def in_sight(page: Page, what: Locator) -> bool:
    """Whether all of it is on the screen, and above STOP."""
    box, stop = what.bounding_box(), page.locator("#stop").bounding_box()
    return box is not None and stop is not None and box["y"] >= 0 and box["y"] + box["height"] <= stop["y"]


def test_a_stop_and_its_end_are_in_sight_on_every_view_also_at_its_end(start: Start, visit: Visit) -> None:
    page = visit(start(), **PHONE)
    pair(page)
    for view in ("Antenna", "Plan", "Setup", "Help", "test"):
        page.get_by_role("link", name=view).first.click()
        page.evaluate("scrollTo(0, document.body.scrollHeight)")
        page.keyboard.press("Escape")
        again = page.get_by_role("button", name="Let it move again")
        again.wait_for()
        assert in_sight(page, again), view
        assert in_sight(page, page.locator(".troubles", has_text="Stopped by")), view
        again.click()
        again.wait_for(state="detached")


def test_while_a_button_is_held_the_angles_are_in_sight(start: Start, visit: Visit) -> None:
    page = visit(start(), **PHONE)
    pair(page)
    button = page.get_by_role("button", name="Hold to turn CW")
    button.scroll_into_view_if_needed()
    page.evaluate("document.querySelector('.jogpad').scrollIntoView({block: 'center'})")
    before = page.locator(".glance span").inner_text()
    button.hover()
    page.mouse.down()
    waits_for(page, lambda: page.locator(".glance span").inner_text() != before)
    assert in_sight(page, page.locator(".glance"))
    page.mouse.up()


def test_why_a_held_button_turns_nothing_is_in_sight(start: Start, visit: Visit) -> None:
    page = visit(start(), **PHONE)
    pair(page)
    page.get_by_role("button", name="Mode PARK").click()
    page.locator(".mode", has_text="It stays where it is").wait_for()
    page.evaluate("document.querySelector('.jogpad').scrollIntoView({block: 'center'})")
    page.get_by_role("button", name="Hold to turn CW").hover()
    page.mouse.down()
    said = page.locator(".strip .said", has_text="has set the mode PARK")
    said.wait_for()
    page.mouse.up()
    assert in_sight(page, said)
    assert "page#" not in said.inner_text()


def test_stop_stays_in_sight_on_a_page_that_fingers_have_spread(start: Start, visit: Visit) -> None:
    """As it does above the keyboard of a phone: that, too, leaves less of the page to be seen."""
    page = visit(start(), **PHONE)
    whole = page.locator("#stop").bounding_box()
    fingers = page.context.new_cdp_session(page)
    for scale in (2.0, 3.0, 1.0):
        fingers.send("Emulation.setPageScaleFactor", {"pageScaleFactor": scale})
        for corner in ("0, 0", "0, document.body.scrollHeight"):
            page.evaluate(f"scrollTo({corner})")
            waits_for(page, lambda: page.evaluate(STOP_FILLS_THE_FOOT))
    assert page.locator("#stop").bounding_box() == whole
