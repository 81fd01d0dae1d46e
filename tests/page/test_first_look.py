"""The first minute before the page: looking on, STOP without a login, and pairing."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station, code_at_the_box, headline
from tests.page.test_dashboard import PHONE
from tests.page.test_setup import in_sight

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]


def test_a_visitor_sees_the_antenna_and_may_stop_it_alone(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    assert page.locator(".sim").is_visible()
    assert "SIM A:000" in page.locator(".lcd").inner_text()
    assert page.get_by_role("button", name="Point there").count() == 0
    page.locator("#stop").click()
    headline(page, "STOPPED by the page")
    assert page.get_by_role("button", name="Let it move again").is_disabled()


def test_pairing_by_the_code_that_the_box_shows_and_no_page(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station, **PHONE)
    page.get_by_role("button", name="Pair this browser").click()
    page.get_by_text("PAIR CODE").wait_for()
    in_sight(page, page.get_by_label("Code"))
    assert "PAIR CODE ******" in page.locator(".lcd").inner_text()
    code = code_at_the_box(page)
    page.get_by_label("Code").fill(f"{(int(code) + 1) % 1_000_000:06d}")
    page.get_by_role("button", name="Pair", exact=True).click()
    in_sight(page, page.get_by_text("that is not the code on the display; 4 tries left"))
    in_sight(page, page.get_by_label("Code"))
    page.get_by_label("Code").fill(code)
    page.get_by_role("button", name="Pair", exact=True).click()
    page.get_by_role("button", name="Point there").wait_for()
    page.reload()
    page.get_by_role("button", name="Point there").wait_for()
