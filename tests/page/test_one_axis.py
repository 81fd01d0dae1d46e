"""The page of an azimuth rotor alone: a compass rose in place of the sky, one dial, one angle, no word of elevation."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station, headline, pair, violations
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
PLACE = "[station]\nlocator = 'JN79gx'\n"


def test_a_press_on_the_rose_names_a_bearing_and_a_locator_has_two_ways(start: Start, visit: Visit) -> None:
    station = start(PLACE, azimuth_alone=True)
    page = visit(station, **PHONE)
    pair(page)
    page.get_by_role("img", name="Compass.").wait_for()
    assert "elevation" not in page.locator("main").inner_text().lower()
    assert page.get_by_role("button", name="Hold to turn Up").count() == 0
    rose = page.locator(".skyview svg")
    rose.scroll_into_view_if_needed()
    box = rose.bounding_box()
    assert box is not None
    reach = min(box["width"] / 244, box["height"] / 240)
    page.mouse.click(box["x"] + box["width"] / 2 + 70 * reach, box["y"] + box["height"] / 2)
    page.get_by_role("button", name=re.compile("^Point to (89|90|91)°$")).wait_for()
    page.get_by_role("button", name="Point there").click()
    headline(page, "ON TARGET")
    waits_for(page, lambda: abs(station.world().antenna_deg[0] - 90.0) < 5.0)
    assert station.world().antenna_deg[1] == 0.0

    # JN58td lies in the southwest of JN79gx, at 227°; by the long path it is at 47°.
    page.get_by_label("Track").fill("JN58td")
    page.get_by_role("button", name="Long path").click()
    waits_for(page, lambda: abs(station.world().antenna_deg[0] - 47.0) < 5.0)
    page.get_by_label("Track").fill("JN58td")
    page.get_by_role("button", name="Short path").click()
    waits_for(page, lambda: abs(station.world().antenna_deg[0] - 227.0) < 5.0)
    # New Zealand by a callsign: 66° or 246°.
    page.get_by_label("Track").fill("ZL2ABC")
    page.get_by_text("New Zealand, 180").wait_for()
    page.get_by_role("button", name=re.compile("^Long path 2[0-9]{2}°$")).click()
    waits_for(page, lambda: 200.0 < station.world().antenna_deg[0] < 300.0)
    page.get_by_label("Track").fill("Moon")
    page.get_by_role("button", name="Track", exact=True).wait_for()
    assert violations(page) == []


def test_setup_asks_for_one_axis(start: Start, visit: Visit) -> None:
    page = visit(start(PLACE, azimuth_alone=True))
    pair(page)
    page.get_by_role("link", name="Setup").first.click()
    page.get_by_text("4. Read the sensors").click()
    page.get_by_text("azimuth: reads").wait_for()
    assert page.get_by_text("elevation: reads").count() == 0
    page.get_by_text("6. Calibrate the elevation").click()
    page.get_by_text("This rotor has no elevation.").wait_for()
