"""What a person sees and does on the page, in Chromium, before the real program on a simulated rotor."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import PATIENCE_MS, Station, headline, pair

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
PHONE = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
STATION = '[station]\nlocator = "JO62qm"\n'


def waits_for(page: Page, met: Callable[[], bool]) -> None:
    for _ in range(PATIENCE_MS // 50):
        if met():
            return
        page.wait_for_timeout(50)
    raise AssertionError("it does not come")


@pytest.mark.parametrize("how", [{}, PHONE], ids=["wide", "phone"])
def test_a_press_on_the_sky_names_a_target_and_the_antenna_arrives(
    start: Start, visit: Visit, how: dict[str, object]
) -> None:
    station = start()
    page = visit(station, **how)
    pair(page)
    sky = page.locator(".skyview svg")
    sky.scroll_into_view_if_needed()
    box = sky.bounding_box()
    assert box is not None
    # East, at a third of the way from the horizon to the zenith.
    reach = min(box["width"], box["height"]) / 224
    page.mouse.click(box["x"] + box["width"] / 2 + 66.7 * reach, box["y"] + box["height"] / 2)
    page.get_by_role("button", name="Point there").click()
    headline(page, "ON TARGET")
    waits_for(page, lambda: station.points(90.0, 30.0))
    page.get_by_text("Moved and held by this browser").wait_for()


def test_a_held_button_turns_and_a_lost_connection_stops(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page)
    button = page.get_by_role("button", name="Hold to turn CW", exact=True)
    page.evaluate("document.querySelector('.jogpad').scrollIntoView({block: 'center'})")  # from behind STOP
    box = button.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 20, box["y"] + 20)

    def turns_beyond(angle_deg: float) -> bool:
        """On a busy machine the box may end the hold: then it is pressed again."""
        if not page.locator(".jog.held").count():
            page.mouse.up()
            page.mouse.down()
        return station.world().antenna_deg[0] > angle_deg

    waits_for(page, lambda: turns_beyond(5.0))
    page.mouse.up()
    headline(page, "AT REST")
    stood_deg = station.world().antenna_deg[0]
    waits_for(page, lambda: turns_beyond(stood_deg + 5.0))
    page.context.set_offline(True)
    waits_for(page, lambda: station.world().drives == (0, 0))


def test_stop_works_by_key_while_a_question_is_open(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page)
    page.get_by_label("Azimuth", exact=True).fill("300")
    page.get_by_label("Elevation", exact=True).fill("60")
    page.get_by_role("button", name="Point there").click()
    headline(page, "TURNING")
    page.get_by_role("button", name="To the park position").click()
    page.get_by_role("alertdialog").wait_for()
    stop = page.locator("#stop").bounding_box()
    assert stop is not None
    for share in (0.05, 0.5, 0.95):
        there = [stop["x"] + stop["width"] * share, stop["y"] + stop["height"] / 2]
        assert page.evaluate("([x, y]) => document.elementFromPoint(x, y).closest('#stop') !== null", there)
    page.keyboard.press("Escape")
    headline(page, "STOPPED by test")
    page.get_by_role("button", name="Let it move again").click()
    headline(page, "AT REST")


@pytest.mark.parametrize("how", [{}, PHONE], ids=["wide", "phone"])
def test_a_fault_that_needs_a_person_is_cleared_and_the_antenna_moves_again(
    start: Start, visit: Visit, how: dict[str, object]
) -> None:
    station = start("", "--fault", "azimuth-motor-stalled@0")
    page = visit(station, **how)
    looks_on = visit(station)
    pair(page)
    page.get_by_label("Azimuth", exact=True).fill("90")
    page.get_by_label("Elevation", exact=True).fill("40")
    page.get_by_role("button", name="Point there").click()
    headline(page, "FAULT")
    page.locator(".troubles", has_text="azimuth").wait_for()
    assert looks_on.get_by_role("button", name="Repaired: go on").is_disabled()
    page.get_by_role("button", name="Repaired: go on").click()
    page.locator(".troubles").wait_for(state="detached")
    headline(page, "ELEVATION ON TARGET, AZIMUTH AT REST")
    page.get_by_label("Azimuth", exact=True).fill("0")
    page.get_by_role("button", name="Point there").click()
    headline(page, "ON TARGET")
    assert station.points(0.0, 40.0)


def test_two_people_take_the_antenna_from_each_other_by_name(start: Start, visit: Visit) -> None:
    station = start()
    anna, bert = visit(station), visit(station)
    pair(anna, "Anna")
    pair(bert, "Bert")
    anna.get_by_role("button", name="Take the antenna").click()
    bert.get_by_text("held by Anna").wait_for()
    bert.get_by_text("Anna holds the antenna: take it over first").wait_for()
    assert bert.get_by_role("button", name="North").is_disabled()
    bert.get_by_role("button", name="Take over from Anna").click()
    anna.get_by_text("held by Bert").wait_for()
    bert.get_by_role("button", name="Give it back to the programs").click()
    anna.get_by_role("button", name="Take the antenna").wait_for()


def test_the_page_is_the_mode_switch_of_a_box_that_has_none(start: Start, visit: Visit) -> None:
    station = start()
    anna, bert = visit(station), visit(station)
    pair(anna, "Anna")
    pair(bert, "Bert")
    anna.get_by_role("button", name="Mode MANUAL").click()
    bert.get_by_text("Only Anna points and turns it. Chosen by Anna.").wait_for()
    assert bert.get_by_role("button", name="East").is_disabled()
    anna.get_by_role("button", name="East").click()
    headline(anna, "ON TARGET")
    anna.get_by_role("button", name="Mode JOG").click()
    anna.get_by_text("Only buttons that this browser holds turn it.").wait_for()
    assert anna.get_by_role("button", name="East").is_disabled()
    bert.get_by_role("button", name="Mode PARK").click()
    headline(anna, "Bert has set the mode PARK")
    anna.get_by_role("button", name="Mode AUTO").click()
    headline(bert, "AT REST")
