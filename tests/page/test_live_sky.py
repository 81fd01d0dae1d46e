"""The live sky in Chromium: what is up stands where skyfield sees it, two presses track it, no name lies on another."""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from benchmarks.sky_now import as_json, crowd, rises_in, satellite, sets_in
from rotator.orbits.elements import Elements
from rotator.orbits.sight import Sight
from tests.orbits import skyfield_oracle
from tests.page.conftest import Station, pair, violations
from tests.page.test_dashboard import PHONE, waits_for
from tests.page.test_sky import COMPUTED_MS, LOCATOR, SITE

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
HOWS: list[dict[str, Any]] = [{"viewport": {"width": 1366, "height": 768}}, PHONE]
NEAR_DEG = 1.5
"""What a satellite moves while a slow machine draws the next picture."""
DOT = """name => {
    const all = [...document.querySelectorAll(".up")];
    const dot = all.find((each) => each.textContent === name)?.querySelector("circle");
    const [x, y] = dot ? [+dot.getAttribute("cx"), +dot.getAttribute("cy")] : [0, 0];
    const box = dot?.getBoundingClientRect();
    return dot && { az: (Math.atan2(x, -y) * 180 / Math.PI + 360) % 360, el: 90 - 0.9 * Math.hypot(x, y),
        at: Date.now() / 1000, x: box.x + box.width / 2, y: box.y + box.height / 2 };
}"""


def file_of(folder: Path, sets: list[Elements], *, follow: str = "") -> str:
    (folder / "made.json").write_text(as_json(sets), encoding="utf-8")
    table = f'[[sky.follow]]\nname = "{follow}"\n' if follow else ""
    return f'[station]\nlocator = "{LOCATOR}"\n[sky]\nelements = ["{folder}/made.json"]\n{table}'


def above_stop(page: Page, shown: Locator) -> bool:
    """Whole on the screen without scrolling. A busy machine may tell of a late sensor for a moment, above all else."""
    box, stop = shown.bounding_box(), page.locator("#stop").bounding_box()
    assert box is not None
    assert stop is not None
    return box["y"] >= 0 and box["y"] + box["height"] <= stop["y"]


@pytest.mark.parametrize("how", HOWS, ids=["laptop", "phone"])
def test_what_is_up_stands_where_skyfield_sees_it_and_two_presses_track_it(
    start: Start, visit: Visit, tmp_path: Path, how: dict[str, Any]
) -> None:
    now_s = time.time()
    up = satellite("GOING (AO-1)", 90_001, now_s, SITE, sets_in(now_s, 300.0))
    later = satellite("LATER", 90_002, now_s, SITE, rises_in(now_s, 1200.0))
    page = visit(start(file_of(tmp_path, [up, later])), **how)
    pair(page)
    page.evaluate("scrollTo(0, 0)")
    page.locator(".up.amateur circle").wait_for(timeout=COMPUTED_MS)
    dot = page.evaluate(DOT, "GOING (AO-1)")
    there = skyfield_oracle.of_elements(up, SITE, dot["at"])
    assert there.apart_deg(Sight(dot["az"], dot["el"], 0.0)) < NEAR_DEG
    assert page.locator(".flying .name", has_text="AO-1").count() == 1
    assert page.locator(".up", has_text="LATER").count() == 0
    page.mouse.click(dot["x"], dot["y"])
    card = page.get_by_role("region", name="GOING (AO-1)")
    card.get_by_text("LOS in").wait_for()
    assert page.locator(".arc polyline").count() == 2
    track = card.get_by_role("button", name="Track")
    waits_for(page, lambda: above_stop(page, track))
    track.click()
    card.get_by_role("button", name="End AO-1").wait_for(timeout=COMPUTED_MS)
    page.locator(".headline .facts", has_text="GOING (AO-1) LOS").wait_for()
    page.evaluate("scrollTo(0, 0)")
    # Beside it a press still means a direction.
    sky = page.locator(".skyview svg").bounding_box()
    assert sky is not None
    sign = -1 if dot["x"] > sky["x"] + sky["width"] / 2 else 1
    page.mouse.click(sky["x"] + sky["width"] / 2 + sign * sky["height"] / 4, sky["y"] + sky["height"] / 2)
    page.get_by_role("button", name="Point to").wait_for()


@pytest.mark.parametrize("how", HOWS, ids=["laptop", "phone"])
def test_nothing_moves_under_the_finger_when_the_next_pass_comes(
    start: Start, visit: Visit, tmp_path: Path, how: dict[str, Any]
) -> None:
    """It is named below the sky and in the headline, seconds after the satellites can be pressed."""
    now_s = time.time()
    later = satellite("LATER (AO-91)", 90_002, now_s, SITE, rises_in(now_s, 1200.0))
    page = visit(start(file_of(tmp_path, [later])), locale="de-DE", **how)
    page.locator(".key.next").wait_for(timeout=COMPUTED_MS)
    page.locator(".facts", has_text="LATER").wait_for()
    heights_px = page.evaluate(
        """() => [[".skyview figcaption", ".next"], [".facts", "span"]].map(([around, next]) => {
            const whole = document.querySelector(around), copy = whole.cloneNode(true);
            [...copy.querySelectorAll(next)].find((each) => each.textContent.includes("LATER")).remove();
            whole.after(copy);
            return [whole.offsetHeight, copy.offsetHeight];
        })"""
    )
    for with_it_px, without_px in heights_px:
        assert with_it_px == without_px


@pytest.mark.parametrize("light", ["light", "dark"])
def test_names_touch_no_other_and_what_is_followed_has_one(
    start: Start, visit: Visit, tmp_path: Path, light: str
) -> None:
    sets = crowd(time.time(), 70, SITE)
    station = start(file_of(tmp_path, sets, follow="CROWD 41"))
    for how in HOWS:
        page = visit(station, color_scheme=light, **how)
        page.locator(".flying .name.followed").wait_for(timeout=COMPUTED_MS)
        found = page.evaluate(
            """() => {
                const dots = [...document.querySelectorAll(".up")].length;
                const shown = [...document.querySelectorAll(".flying .name")];
                const names = shown.map((each) => [each.textContent, each.getBBox()]);
                return [dots, names.map(([name, { x, y, width, height }]) => [name, x, y, x + width, y + height])];
            }"""
        )
        dots, names = found
        assert dots > 60
        assert len(names) >= 6
        for (one, *a), (other, *b) in combinations(names, 2):
            apart = a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] - 1 or b[1] >= a[3] - 1
            assert apart, (one, other)
        page.locator(".old").first.wait_for(state="detached", timeout=COMPUTED_MS)
        assert violations(page) == []


@pytest.mark.parametrize(
    ("width", "height", "share"), [(390, 844, 0.8), (820, 1180, 0.75), (1366, 768, 0.6), (2560, 1440, 0.7)]
)
def test_the_sky_is_large_in_every_window(start: Start, visit: Visit, width: int, height: int, share: float) -> None:
    """It is the first thing on the page: whole on the screen, above STOP."""
    page = visit(start(), viewport={"width": width, "height": height})

    def is_whole() -> bool:
        sky = page.locator(".skyview .sky")
        circle = sky.bounding_box()
        assert circle is not None
        return circle["width"] >= share * min(width, height) and above_stop(page, sky)

    waits_for(page, is_whole)


def test_the_list_is_for_the_keyboard(start: Start, visit: Visit, tmp_path: Path) -> None:
    now_s = time.time()
    page = visit(start(file_of(tmp_path, [satellite("GOING", 90_001, now_s, SITE, sets_in(now_s, 300.0))])))
    pair(page)
    row = page.get_by_role("region", name="Up now").get_by_role("button", name="GOING")
    row.press("Enter", timeout=COMPUTED_MS)
    page.get_by_role("region", name="GOING").get_by_role("button", name="Track GOING").press("Enter")
    page.get_by_role("region", name="GOING").get_by_role("button", name="End GOING").wait_for(timeout=COMPUTED_MS)
    page.get_by_role("button", name="Close GOING").press("Enter")
    waits_for(page, lambda: row.get_attribute("aria-pressed") == "false")


@pytest.mark.parametrize(
    ("tables", "said", "link"),
    [
        ("", "The box does not know where it stands", "tell it"),
        (f'[station]\nlocator = "{LOCATOR}"\n', "No satellites are known", "Setup, step 8"),
    ],
    ids=["no place", "no elements"],
)
def test_a_box_without_a_place_or_satellites_says_what_to_do(
    start: Start, visit: Visit, tables: str, said: str, link: str
) -> None:
    up = visit(start(tables)).get_by_role("region", name="Up now")
    up.get_by_text(said).wait_for(timeout=COMPUTED_MS)
    up.get_by_role("link", name=link).wait_for()
