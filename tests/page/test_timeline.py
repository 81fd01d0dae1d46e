"""The timeline in Chromium: it shows the plan; a drag, or a key, changes it, and the change is taken back.

The plan is computed behind all other work: each wait has the patience for that.
"""

from __future__ import annotations

import json
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.page.conftest import Station, pair, violations
from tests.page.test_dashboard import PHONE
from tests.page.test_sky import COMPUTED_MS, place

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
LOOK_MS = 100


def comes(page: Page, met: Callable[[], bool]) -> None:
    for _ in range(COMPUTED_MS // LOOK_MS):
        if met():
            return
        page.wait_for_timeout(LOOK_MS)
    raise AssertionError(f"it does not come: {page.locator('.timeline').inner_text()}")


def planned(station: Station) -> list[dict[str, Any]]:
    """What the API tells of the plan; empty: it is being computed."""
    with urllib.request.urlopen(f"{station.url}/api/passes", timeout=30.0) as answer:
        told = json.load(answer) if answer.status == 200 else {"passes": []}
    return [each for each in told["passes"] if each["plan"]]


def of_the_api(station: Station) -> dict[str, bool]:
    """Which passes are flown, by name and highest moment."""
    return {each["name"] + each["tca"]: each["plan"]["flown"] for each in planned(station)}


def of_the_page(page: Page) -> dict[str, bool]:
    bars = page.locator(".timeline .bar:not([class='bar '])")
    return dict(bars.evaluate_all("bars => bars.map(bar => [bar.dataset.key, bar.classList.contains('flown')])"))


def first_rival(page: Page) -> str:
    """What is said of RIVAL's first pass, which begins in the middle of COMING's."""
    return (
        page.locator(".timeline .bar", has_text="°")
        .and_(page.locator("[data-key^=RIVAL]"))
        .first.get_attribute("title")
        or ""
    )


def rows(page: Page) -> list[str]:
    return page.locator(".timeline .name span:last-child").all_inner_texts()


def test_the_timeline_is_the_plan_and_a_drag_changes_it_until_it_is_taken_back(
    start: Start, visit: Visit, tmp_path: Path
) -> None:
    station = start(place(tmp_path, follow=("COMING", "RIVAL")))
    before = (tmp_path / "r.toml").read_text(encoding="utf-8")
    page = visit(station)
    pair(page)
    comes(page, lambda: bool(of_the_page(page)))
    assert of_the_page(page) == of_the_api(station)
    assert rows(page) == ["COMING", "RIVAL"]
    first = first_rival(page)
    assert "COMING" in first
    page.locator(".timeline").evaluate("timeline => timeline.scrollIntoView()")  # from behind STOP
    lower = page.get_by_role("button", name="RIVAL, place 2 of 2").bounding_box()
    upper = page.get_by_role("button", name="COMING, place 1 of 2").bounding_box()
    assert lower is not None
    assert upper is not None
    page.mouse.move(lower["x"] + 5, lower["y"] + 5)
    page.mouse.down()
    page.mouse.move(upper["x"] + 5, upper["y"] + 5, steps=4)
    page.mouse.up()
    page.get_by_role("button", name="Undo: RIVAL is now 1 of 2").wait_for()
    comes(page, lambda: first_rival(page) != first)
    assert rows(page) == ["RIVAL", "COMING"]
    assert of_the_page(page) == of_the_api(station)
    assert (tmp_path / "r.toml").read_text(encoding="utf-8") == before
    page.get_by_role("button", name="Undo: RIVAL is now 1 of 2").click()
    comes(page, lambda: first_rival(page) == first)
    assert rows(page) == ["COMING", "RIVAL"]
    page.get_by_role("button", name="RIVAL, place 2 of 2").focus()
    page.keyboard.press("ArrowUp")
    page.locator("button.handle:focus", has_text="RIVAL").wait_for()
    comes(page, lambda: rows(page) == ["RIVAL", "COMING"] and first_rival(page) != first)
    page.reload()
    page.get_by_role("button", name="The file's order again").click()
    comes(page, lambda: rows(page) == ["COMING", "RIVAL"])


def test_a_pass_is_told_by_a_finger_and_by_keys_and_is_tracked(start: Start, visit: Visit, tmp_path: Path) -> None:
    station = start(place(tmp_path, follow=("COMING", "RIVAL")))
    page = visit(station, **PHONE)
    pair(page)
    bar = page.locator(".timeline [data-key^=RIVAL]").first
    bar.wait_for(timeout=COMPUTED_MS)
    bar.tap()
    page.locator(".chosen", has_text="In the plan: ").or_(page.locator(".chosen", has_text="Left out: ")).wait_for()
    bar.press("ArrowUp")
    page.locator(".chosen b", has_text="COMING").wait_for()
    page.keyboard.press("ArrowRight")
    page.locator(".bar:focus").and_(page.locator("[data-key^=COMING]")).wait_for()
    wide = page.locator(".scroller").evaluate("area => [area.scrollWidth > area.clientWidth, innerWidth]")
    assert wide[0], "the day is wider than a phone"
    assert page.evaluate("document.documentElement.scrollWidth") <= wide[1], "and the page is not"
    page.get_by_role("button", name="Track COMING").click()
    page.get_by_role("button", name="COMING is tracked").wait_for(timeout=COMPUTED_MS)
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        assert violations(page) == []
