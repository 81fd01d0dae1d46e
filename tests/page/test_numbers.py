"""Numbers as people type them into the page, key by key, in browsers of more than one language."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import Station, pair
from tests.page.test_dashboard import waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]


@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
def test_a_comma_and_a_point_mean_the_same_in_every_language(start: Start, visit: Visit, locale: str) -> None:
    station = start(page='language = "en"')
    page = visit(station, locale=locale)
    pair(page)
    page.get_by_label("Azimuth", exact=True).press_sequentially("12,5")
    page.get_by_label("Elevation", exact=True).press_sequentially("40.25")
    page.get_by_role("button", name="Point there").click()
    waits_for(page, lambda: station.points(12.5, 40.25))
    targets = page.request.get(f"{station.url}/api/status").json()
    assert (targets["azimuth"]["target_deg"], targets["elevation"]["target_deg"]) == (12.5, 40.25)


def test_what_is_no_number_moves_nothing(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page)
    azimuth = page.get_by_label("Azimuth", exact=True)
    page.get_by_label("Elevation", exact=True).press_sequentially("40")
    for typed in ("1.2.5", "12,5,3", "1e2", "0x10", "twelve", "12 5", "Infinity", "-", ","):
        azimuth.fill("")
        azimuth.press_sequentially(typed)
        page.get_by_role("button", name="Point there").click()
        assert azimuth.evaluate("field => field.validity.patternMismatch"), typed
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Let it move again").wait_for()
    assert page.request.get(f"{station.url}/api/status").json()["azimuth"]["target_deg"] is None
    assert station.world().antenna_deg == (0.0, 0.0)


def test_a_phone_shows_a_minus_wherever_a_number_may_be_below_zero(start: Start, visit: Visit) -> None:
    """The keyboard for decimals has none on an iPhone: a longitude in America, an elevation below the horizon."""
    page = visit(start())
    pair(page)
    page.get_by_role("link", name="Setup", exact=True).click()
    page.get_by_text("Place and time").click()
    assert page.get_by_label("longitude_deg").first.get_attribute("inputmode") == "text"
    assert page.get_by_label("altitude_m").first.get_attribute("inputmode") == "text"
    assert page.get_by_label("beam_deg").first.get_attribute("inputmode") == "decimal"
