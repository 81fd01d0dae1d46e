"""Notices of the browser: a switch, what is told once it is on, and what needs HTTPS; the way to the calendar."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from tests.page.conftest import Station, pair, violations
from tests.page.test_pass import NAME, until

if TYPE_CHECKING:
    from playwright.sync_api import Page

SHOWN = """async () => {
    const worker = await navigator.serviceWorker.getRegistration();
    return worker ? (await worker.getNotifications()).map(({title, body}) => `${title}: ${body}`) : [];
}"""


def test_a_stop_and_a_fault_are_told_on_every_view_once_it_is_switched_on(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    station = start()
    page = visit(station, permissions=["notifications"])
    pair(page)
    page.get_by_role("link", name="Plan", exact=True).click()
    switch = page.get_by_role("switch", name="Notices in this browser")
    assert switch.get_attribute("aria-checked") == "false"
    station.tell("stop")
    page.get_by_role("button", name="Let it move again").click()
    switch.click()
    page.get_by_text("A phone that sleeps hears nothing").wait_for()
    assert violations(page) == []
    page.get_by_role("link", name="Antenna", exact=True).click()
    station.tell("stop")
    until(page, lambda: bool(page.evaluate(SHOWN)))
    (told,) = page.evaluate(SHOWN)
    assert told.startswith("Stopped by ")
    assert told.endswith(": Nothing moves until a person lets it.")


def test_a_page_without_https_says_so_and_leads_to_the_calendar(
    start: Callable[..., Station], visit: Callable[..., Page]
) -> None:
    station = start(page=f'names = ["{NAME}"]')
    page = visit(station)
    page.goto(station.url.replace("127.0.0.1", NAME) + "/#sky")
    page.get_by_text("This browser shows notices only of a page with HTTPS").wait_for()
    assert page.get_by_role("switch").count() == 0
    port = station.url.rpartition(":")[2]
    subscribe = page.get_by_role("link", name="subscribe to it")
    assert subscribe.get_attribute("href") == f"webcal://{NAME}:{port}/api/passes.ics"
