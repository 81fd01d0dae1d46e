"""Nothing can be pressed that must fail: what cannot be ordered now is disabled, with the reason beside it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from playwright.sync_api import expect

from tests.page.conftest import Station, headline, pair, violations
from tests.page.test_setup import in_sight

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
JOG, POINT = "Hold to turn CW", "Point there"


def may(page: Page, *, jog: bool, point: bool) -> None:
    """Wait until these buttons can be pressed, or cannot."""
    for name, can in ((JOG, jog), (POINT, point), ("To the park position", point)):
        button = page.get_by_role("button", name=name, exact=True)
        expect(button).to_be_enabled() if can else expect(button).to_be_disabled()


def test_what_cannot_be_ordered_now_says_why(start: Start, visit: Visit) -> None:
    station = start()
    page, other = visit(station), visit(station)
    pair(page, "mine")
    pair(other, "other")
    hand = page.get_by_label("By hand")
    may(page, jog=True, point=True)
    page.get_by_role("button", name="Mode JOG").click()
    hand.get_by_text("only the buttons that you hold turn it").wait_for()
    may(page, jog=True, point=False)
    may(other, jog=False, point=False)
    page.get_by_role("button", name="Mode PARK").click()
    hand.get_by_text("The mode is PARK: choose AUTO first.").wait_for()
    may(page, jog=False, point=False)
    assert violations(page) == []
    page.get_by_role("button", name="Mode AUTO").click()
    may(page, jog=True, point=True)
    other.get_by_role("button", name="Take the antenna").click()
    hand.get_by_text("other holds the antenna: take it over first.").wait_for()
    may(page, jog=False, point=False)
    may(other, jog=True, point=True)
    page.get_by_role("button", name="Take over from other").click()
    may(page, jog=True, point=True)
    page.locator("#stop").click()
    headline(page, "STOPPED by")
    may(page, jog=False, point=False)
    page.get_by_role("button", name="Let it move again").click()
    may(page, jog=True, point=True)


def test_a_box_without_a_place_offers_no_target_in_the_sky(start: Start, visit: Visit) -> None:
    page = visit(start())
    pair(page)
    page.get_by_role("link", name="Plan", exact=True).click()
    expect(page.get_by_role("button", name="Track Moon")).to_be_disabled()
    page.get_by_text("Directions alone, because the box does not know where it stands").wait_for()
    assert page.get_by_role("button", name="Follow the plan").count() == 0
    assert page.get_by_role("button", name="Track nothing").count() == 0
    page.get_by_role("link", name="Setup, step 8").click()
    in_sight(page, page.locator(".step[open] > summary", has_text="8. Place and time"))
