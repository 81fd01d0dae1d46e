"""A box is set up on the page alone: its settings, its links, its relays one by one."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import pytest

from tests.page.conftest import Station, pair
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page


Start = Callable[..., Station]
Visit = Callable[..., "Page"]
REMARK = "[mount]\npark_azimuth_deg = 90   # away from the trees\n"


def values(station: Station) -> dict[str, Any]:
    return tomllib.loads((station.folder / "r.toml").read_text(encoding="utf-8"))


def in_sight(page: Page, what: Locator) -> None:
    """Wait until it is between the strip above and STOP below, whole."""
    what.wait_for()

    def whole() -> bool:
        box, top, stop = (each.bounding_box() for each in (what, page.locator(".strip"), page.locator("#stop")))
        assert box is not None
        assert stop is not None
        above = top["y"] + top["height"] if top else 0.0
        return above <= box["y"] + 1.0 and box["y"] + box["height"] <= stop["y"] + 1.0

    waits_for(page, whole)


def open_step(page: Page, title: str) -> None:
    page.locator(".step > summary", has_text=title).click()


def at_setup(page: Page) -> None:
    pair(page)
    page.get_by_role("link", name="Setup", exact=True).click()
    page.get_by_role("heading", name="Setup").wait_for()


def write_it(page: Page) -> None:
    """Write what is proposed, and wait until the box has started anew with it."""
    page.get_by_role("button", name="Write it and start anew").click()
    page.get_by_text("The box starts anew …").first.wait_for()
    page.get_by_text("The box starts anew …").first.wait_for(state="detached")


@pytest.mark.parametrize("how", [{}, PHONE], ids=["wide", "phone"])
def test_a_setting_is_changed_in_the_file_and_its_remark_stays(
    start: Start, visit: Visit, how: dict[str, object]
) -> None:
    station = start(REMARK)
    page = visit(station, **how)
    at_setup(page)
    open_step(page, "All settings")
    page.get_by_label("Find a setting").fill("park_azimuth_deg")
    page.get_by_label("park_azimuth_deg").fill("95")
    page.get_by_role("button", name="See the change").click()
    row = page.locator(".changes tr", has_text="mount.park_azimuth_deg")
    row.get_by_text("The park position").wait_for()
    assert row.locator("td").all_text_contents() == ["now 90°", "then 95°"]
    in_sight(page, page.get_by_role("button", name="Write it and start anew"))
    page.get_by_text("The lines of the file").click()
    page.locator(".diff .new", has_text="+park_azimuth_deg = 95   # away from the trees").wait_for()
    rows = page.locator(".diff span").evaluate_all("rows => rows.map((row) => row.getBoundingClientRect().top)")
    assert len(rows) > 3
    assert rows == sorted(set(rows)), "each on a line of its own"
    write_it(page)
    in_sight(page, page.get_by_text(f"Written to {station.folder / 'r.toml'}. The box runs with it now."))
    assert "park_azimuth_deg = 95   # away from the trees" in (station.folder / "r.toml").read_text()
    assert "park_azimuth_deg = 90 " in (station.folder / "r.toml.bak").read_text()
    page.get_by_role("link", name="Antenna").click()
    page.get_by_role("button", name="To the park position").click()
    page.get_by_text("The antenna turns to 95°").wait_for()


def test_a_mistake_is_named_beside_its_field_and_in_sight(start: Start, visit: Visit) -> None:
    page = visit(start(), **PHONE)
    at_setup(page)
    open_step(page, "Limits")
    last = page.locator(".step[open] .field", has=page.get_by_label("park_elevation_deg"))
    last.locator("input").fill("500")
    page.get_by_role("button", name="See the change").click()
    mistake = last.locator(".mistake", has_text="park_elevation_deg = 500")
    in_sight(page, mistake)
    in_sight(page, last.locator("input"))
    assert page.get_by_role("button", name="Write it and start anew").count() == 0
    last.locator("input").fill("5")
    mistake.wait_for(state="detached")


def test_links_come_and_go(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "All settings")
    page.get_by_label("Find a setting").fill("link")
    page.get_by_role("button", name="One more: [[link]]").click()
    new = page.locator("details.one", has_text="link[2]")
    new.get_by_label("protocol", exact=True).select_option("easycomm2")
    new.get_by_label("pty", exact=True).fill("ec2")
    page.get_by_role("button", name="See the change").click()
    write_it(page)
    assert [link["protocol"] for link in values(station)["link"]] == ["gs232b", "easycomm2"]
    first = page.locator("details.one", has_text="link[1]")
    first.locator("summary").click()
    first.get_by_role("button", name="Take link[1] out").click()
    page.get_by_role("button", name="See the change").click()
    write_it(page)
    assert [link["protocol"] for link in values(station)["link"]] == ["easycomm2"]


def test_a_pulse_moves_the_chosen_relay_alone(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Try each relay")
    pulse = page.get_by_role("button", name="Pulse elevation up")
    assert pulse.is_disabled()
    page.get_by_role("button", name="Take the antenna").click()
    pulse.click()
    waits_for(page, lambda: station.world().antenna_deg[1] > 1.0)
    waits_for(page, lambda: station.world().drives == (0, 0))
    assert abs(station.world().antenna_deg[0]) < 0.5
    assert station.world().antenna_deg[1] < 45.0


def test_a_program_is_heard_and_its_settings_are_told(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Your tracking program")
    page.get_by_label("Your tracking program").select_option("PstRotator")
    page.get_by_text("Yaesu GS-232 with the same letter, 9600 8N1").wait_for()
    page.locator(".heard", has_text="nothing heard yet").wait_for()
    with (station.folder / "gs232").open("r+b", buffering=0) as port:
        port.write(b"C2\r")
        page.locator(".heard", has_text="has just asked for the position: C2").wait_for()
