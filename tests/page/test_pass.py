"""Pass mode: a phone in the hand of a person at the antenna, in the sun and in the dark, with HTTPS and without."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import LOOK_MS, PATIENCE_MS, Station, pair, violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
PHONE = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
NAME = "rotator.lan"
"""A name of this machine to the browser under test, which takes no page there for a secure one."""
TURN_PHONE = (
    """way => dispatchEvent(new DeviceOrientationEvent("deviceorientationabsolute", {...way, absolute: true}))"""
)


def until(page: Page, seen: Callable[[], bool]) -> None:
    for _ in range(PATIENCE_MS // LOOK_MS):
        if seen():
            return
        page.wait_for_timeout(LOOK_MS)
    pytest.fail(page.locator("main").inner_text())


def enter(page: Page) -> None:
    page.get_by_role("link", name="Pass", exact=True).click()
    page.locator(".passmode").wait_for()


def test_a_thumb_nudges_what_is_tracked_and_a_stop_ends_it(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station, **PHONE)
    pair(page)
    station.tell("point", "180", "40")
    enter(page)
    up = page.get_by_role("button", name="Nudge elevation by 1° up")
    for _ in range(12):
        up.click()
    page.get_by_role("button", name="Nudge azimuth by 1° CCW").click()
    page.locator(".nudge .set", has_text="+12°").wait_for()
    page.locator(".nudge .set", has_text="−1°").wait_for()
    until(page, lambda: station.points(179, 52))
    page.get_by_role("button", name="End the nudge").click()
    page.get_by_text("A nudge rides on the tracking").wait_for()
    until(page, lambda: station.points(180, 40))
    page.get_by_role("button", name="STOP").click()
    page.get_by_text("Nothing is tracked, so there is nothing to nudge").wait_for()
    assert up.is_disabled()
    page.get_by_role("button", name="Let it move again").click()
    page.get_by_role("link", name="Leave").click()
    page.locator(".board").wait_for()


@pytest.mark.parametrize(
    ("way", "points"),
    [
        ({"alpha": 300, "beta": 20, "gamma": 0}, "60° / 20°"),  # flat in the hand: by its upper edge
        ({"alpha": 300, "beta": 110, "gamma": 0}, "60° / 20°"),  # held up as a camera: by its back
        ({"alpha": 0, "beta": 0, "gamma": 0}, "0° / 0°"),
    ],
)
def test_the_compass_turns_with_the_phone(start: Start, visit: Visit, way: dict[str, float], points: str) -> None:
    page = visit(start(), **PHONE)
    enter(page)
    page.evaluate(TURN_PHONE, way)
    page.locator("dl div", has_text="phone").get_by_text(points).wait_for()
    page.get_by_role("img", name=f"the phone at {points.partition(' ')[0]}").wait_for()
    page.get_by_text("Up is where the phone points").wait_for()


def test_all_can_read_it_by_day_and_by_night(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station, **PHONE)
    pair(page)
    station.tell("point", "180", "40")
    enter(page)
    for look in ("Sun", "Dark", "Night"):
        page.get_by_role("button", name=look).click()
        assert violations(page) == [], look
    page.reload()
    page.locator(".passmode.red").wait_for()


def test_it_says_what_needs_https(start: Start, visit: Visit) -> None:
    station = start(page=f'names = ["{NAME}"]')
    page = visit(station, **PHONE)
    page.goto(station.url.replace("127.0.0.1", NAME) + "/#pass")
    for said in (
        "the phone's own compass needs HTTPS",
        "keeping it on needs HTTPS",
        "Only a paired browser can nudge",
    ):
        page.get_by_text(said).wait_for()


def test_the_page_can_be_put_on_the_home_screen(start: Start, visit: Visit) -> None:
    page = visit(start(), **PHONE)
    found = page.evaluate("""async () => {
        const told = await (await fetch(document.querySelector("link[rel=manifest]").href)).json();
        const images = await Promise.all(told.icons.map(async ({src, sizes, type}) => {
            const answer = await fetch(src), image = new Image(); image.src = src; await image.decode();
            const right = sizes === "any" || `${image.width}x${image.height}` === sizes;
            return right && answer.headers.get("Content-Type") === type;
        }));
        return [told.start_url, told.display, images.every(Boolean)];
    }""")
    assert found == ["/", "standalone", True]
    session = page.context.new_cdp_session(page)
    errors = session.send("Page.getInstallabilityErrors")["installabilityErrors"]
    assert {each["errorId"] for each in errors} <= {"in-incognito"}, "the only hindrance is the test's own window"
