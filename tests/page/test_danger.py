"""Danger on the page: a runaway fills the view, and what a stop or a jog ends goes on when a person asks."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import Station, headline, pair, violations
from tests.page.sizes import misfits
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
STATION = '[station]\nlocator = "JO62qm"\n'


def shown(page: Page, key: str) -> object:
    """What the box tells the page of itself."""
    return page.evaluate("async (key) => (await (await fetch('/api/status')).json())[key]", key)


@pytest.mark.parametrize("how", [{}, PHONE], ids=["wide", "phone"])
def test_a_runaway_fills_the_view_and_promises_nothing_before_it_stands(
    start: Start, visit: Visit, how: dict[str, object]
) -> None:
    """A slow motor: the page looks at it for a while before its end stop holds the antenna."""
    slow = "[sim.azimuth]\nspeed_dps = 3.0\n"
    station = start(slow, "--fault", "azimuth-relay-welded-cw@0", kind="relay-pot")
    page = visit(station, **how)
    pair(page)
    danger = page.locator(".emergency")
    danger.get_by_role("heading", name="CUT MOTOR POWER!").wait_for()
    danger.get_by_text("and the box cannot stop it").wait_for()
    danger.get_by_text("The azimuth still turns though its relays are off").wait_for()
    page.evaluate("scrollTo(0, document.body.scrollHeight)")
    waits_for(page, lambda: page.locator(".glance", has_text="CUT MOTOR POWER!").bounding_box()["y"] == 0)  # type: ignore[index]
    page.evaluate("scrollTo(0, 0)")
    first, stop = danger.locator("li").first.bounding_box(), page.locator("#stop").bounding_box()
    assert first is not None
    assert stop is not None
    assert 0 < first["y"] < stop["y"], "what to do first is in sight, over STOP"
    assert danger.get_by_role("button").count() == 0
    assert violations(page) == []
    refused = page.evaluate(
        "async () => await (await fetch('/api/resume', {method: 'POST', body: '{}',"
        " headers: {'Content-Type': 'application/json'}})).json()"
    )
    assert refused["error"].startswith("the cause is still there: CUT MOTOR POWER!")
    if how:
        other = visit(station, ".emergency", locale="de", color_scheme="dark")
        found = misfits(other, "a runaway")
        assert not found, "\n".join(found)


def test_after_a_stop_what_was_tracked_goes_on_at_a_press_of_its_own(start: Start, visit: Visit) -> None:
    page = visit(start(STATION))
    pair(page)
    page.get_by_label("Track", exact=True).fill("Moon")
    page.get_by_role("button", name="Track", exact=True).click()
    page.get_by_role("button", name="End Moon").wait_for()
    page.keyboard.press("Escape")
    headline(page, "STOPPED by test")
    page.locator(".troubles").get_by_role("button", name="Go on with Moon").wait_for()
    page.get_by_role("button", name="Let it move again").click()
    page.locator(".troubles").wait_for(state="detached")
    assert shown(page, "tracks") is None
    page.get_by_role("button", name="Go on with Moon").click()
    page.get_by_role("button", name="End Moon").wait_for()


def test_a_jog_leaves_the_other_axis_on_its_way(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page)
    page.get_by_label("Azimuth", exact=True).fill("60")
    page.get_by_label("Elevation", exact=True).fill("60")
    page.get_by_role("button", name="Point there").click()
    headline(page, "TURNING")
    button = page.get_by_role("button", name="Hold to turn CCW", exact=True)
    button.scroll_into_view_if_needed()
    box = button.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 20, box["y"] + 20)
    page.mouse.down()
    waits_for(page, lambda: station.world().drives[0] == -1 or station.world().antenna_deg[1] > 55.0)
    page.mouse.up()
    headline(page, "ELEVATION ON TARGET, AZIMUTH AT REST")
    assert abs(station.world().antenna_deg[1] - 60.0) < 5.0
