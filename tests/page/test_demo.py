"""The demonstration in Chromium: one press by a browser that nothing has been set up for, and a picture to keep."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station
from tests.page.sizes import misfits
from tests.page.test_dashboard import waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

FLOWN_MS = 180_000
"""The pass lasts a minute; before it the antenna turns to where it rises."""
COUNT = "window.presses = 0; addEventListener('pointerdown', () => (window.presses += 1), true)"


def test_from_a_new_box_to_the_picture_of_a_flown_pass_is_one_press(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    station = start()
    page = visit(station, timezone_id="Australia/Perth")
    page.evaluate(COUNT)
    page.get_by_role("button", name="Fly a demo pass").click()
    card = page.get_by_label("Demonstration")
    card.get_by_text("ISS over Australia").wait_for()
    other = visit(station, locale="de", color_scheme="dark")
    other.locator(".demo").get_by_text("ISS over Australia").wait_for()
    card.get_by_text("the antenna is off by").wait_for(timeout=FLOWN_MS)
    waits_for(page, lambda: station.world().antenna_deg[0] > 200.0)  # it is the antenna that flies it
    found = misfits(other, "a demo pass")
    keep = card.get_by_role("link", name="Keep the picture")
    keep.wait_for(timeout=FLOWN_MS)
    image = card.get_by_role("img")
    waits_for(page, lambda: bool(image.evaluate("image => image.complete && image.naturalWidth > 0")))
    assert page.evaluate("window.presses") == 1
    assert page.get_by_role("button", name="Pair this browser").is_visible(), "nobody is paired, and nobody need be"
    found += misfits(page, "a flown demo pass")
    with page.expect_download() as kept:
        keep.click()
    assert "ISS over Australia" in kept.value.path().read_text(encoding="utf-8")
    with page.expect_download() as figures:
        card.get_by_role("link", name="Keep the figures").click()
    rows = figures.value.path().read_text(encoding="utf-8").splitlines()
    assert rows[0].startswith("utc,t,target_az,")
    assert len(rows) > 60
    page.get_by_role("link", name="Plan").click()
    page.locator(".flown .week", has_text="passes: 1").wait_for()
    found += misfits(page, "the plan with a flown pass")
    assert not found, "\n".join(found)
