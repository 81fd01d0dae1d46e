"""What only a person at the antenna may order: a counted axis is homed from the page, after a question."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station, pair
from tests.page.test_dashboard import waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page


def test_a_counted_axis_is_homed_after_a_question(start: Callable[..., Station], visit: Callable[..., Page]) -> None:
    station = start(kind="relay-pulse")
    page = visit(station)
    pair(page)
    home = page.get_by_role("button", name="Home the azimuth")
    home.click()
    page.get_by_text("watch the antenna. Home the azimuth?").wait_for()
    page.get_by_role("button", name="No", exact=True).click()
    home.click()
    assert station.world().relay_starts == 0
    page.get_by_role("button", name="Home it").click()
    page.get_by_text("The azimuth looks for its low end stop.").wait_for()
    waits_for(page, lambda: bool(station.world().relay_starts))
    home.wait_for()


def test_an_angle_that_is_reckoned_by_time_says_so_and_its_axis_is_homed(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    page = visit(start(kind="relay-timed"))
    page.get_by_text(re.compile(r"^≈ [\d.]+° ± [?]$")).first.wait_for()
    pair(page)
    page.get_by_role("button", name="Home the azimuth").wait_for()


def test_an_axis_that_is_measured_is_not_homed(start: Callable[..., Station], visit: Callable[..., Page]) -> None:
    page = visit(start())
    pair(page)
    assert page.get_by_role("button", name="Home the azimuth").count() == 0
