"""An axis is calibrated on the page of a phone, from the first question to the file: what stands above STOP, what turns
while a button is held, and whether the antenna points right afterwards."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import pytest

from tests.page.conftest import LOOK_MS, PATIENCE_MS, Station, pair, violations
from tests.page.test_dashboard import PHONE, waits_for
from tests.page.test_setup import open_step

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
SMALLEST = {"width": 320, "height": 568}
HIDDEN = """() => {
    const stop = document.getElementById("stop").getBoundingClientRect().top, wrong = [];
    for (const one of document.querySelectorAll(".guide h2, .guide button, .guide input")) {
        const { top, bottom, left, right, height } = one.getBoundingClientRect();
        if (top < 0 || bottom > stop + 1 || left < 0 || right > innerWidth + 1) wrong.push(one.textContent);
        if (one.matches("button") && height < 43.9) wrong.push(`small: ${one.textContent}`);
    }
    return wrong;
}"""
RUNS = "Press when it stands at its stop."
KEYS = re.compile(r"\b(press|type) (Enter|[a-z])\b|Ctrl|y or n|\bEnter\b")


def asks(page: Page, text: str) -> None:
    """Wait for this question. All of it is above STOP, on the smallest phone too, and names no key."""
    page.locator(".guide h2", has_text=text).wait_for()
    assert not KEYS.search(page.locator(".guide").inner_text())
    for size in (SMALLEST, PHONE["viewport"]):
        page.set_viewport_size(size)  # type: ignore[arg-type]
        page.wait_for_function("() => visualViewport.height === innerHeight")
        page.wait_for_function(f"() => !({HIDDEN})().length")


def answer(page: Page, words: str) -> None:
    page.locator(".guide-answers").get_by_role("button", name=words, exact=True).click()


def enter(page: Page, angle_deg: float) -> None:
    page.get_by_label("Degrees").fill(f"{angle_deg:.1f}")
    answer(page, "Take this angle")


def read_there(page: Page) -> None:
    """Where the box refuses it, because the antenna still moves or its sensor was late, a person presses again."""
    from playwright.sync_api import TimeoutError as NotYet

    angle = page.locator(".guide h2", has_text="Which angle is that")
    for _ in range(4):
        answer(page, "It stands there: read it")
        with suppress(NotYet):
            angle.wait_for(timeout=PATIENCE_MS / 2)
            break
    asks(page, "Which angle is that")


def turn(page: Page, name: str, met: Callable[[], bool], most_ms: int = PATIENCE_MS) -> None:
    """Hold the button until it is `met`. On a busy machine the box may end the hold: then it is pressed again."""
    button = page.get_by_role("button", name=f"Hold to turn {name}", exact=True)
    for _ in range(most_ms // LOOK_MS):
        if met():
            break
        if button.count() and not page.locator(".jog.held").count():
            page.mouse.up()
            button.hover()
            page.mouse.down()
        page.wait_for_timeout(LOOK_MS)
    page.mouse.up()
    assert met()


def is_away(station: Station, axis: int, from_deg: float) -> bool:
    return abs(station.world().antenna_deg[axis] - from_deg) > 15.0


def turned(page: Page, station: Station, name: str, axis: int) -> None:
    """By some degrees, until the box has seen it and asks the next question."""
    before = page.locator(".guide h2").inner_text()

    def goes_on() -> bool:
        return page.locator(".guide h2").inner_text() != before

    for _ in range(5):
        far = partial(is_away, station, axis, station.world().antenna_deg[axis])
        turn(page, name, lambda far=far: goes_on() or far())  # type: ignore[misc]
        for _ in range(100):
            if goes_on():
                return
            page.wait_for_timeout(LOOK_MS)
    raise AssertionError(page.locator(".guide").inner_text())


def begin(page: Page, axis: str) -> None:
    pair(page)
    page.get_by_role("navigation").get_by_role("link", name="Setup").click()
    open_step(page, f"Calibrate the {axis}")
    page.get_by_role("button", name=f"Calibrate the {axis}").click()
    page.locator(".guide").wait_for()


def kept(station: Station) -> Any:
    return tomllib.loads((station.folder / "r.toml").read_text(encoding="utf-8"))


def arrived(page: Page, station: Station, end_deg: float) -> bool:
    return page.locator(".guide h2").inner_text() != RUNS or abs(station.world().antenna_deg[0] - end_deg) < 0.5


@pytest.mark.parametrize("light", ["light", "dark"])
def test_a_pot_is_calibrated_on_a_phone_and_the_antenna_points_right(start: Start, visit: Visit, light: str) -> None:
    station = start()
    page = visit(station, **PHONE, color_scheme=light)
    begin(page, "azimuth")
    asks(page, "Turn it clockwise")
    page.get_by_text("step 1 of 6").wait_for()
    assert violations(page) == []
    turned(page, station, "CW", 0)
    asks(page, "Did the antenna turn clockwise")
    assert violations(page) == []
    answer(page, "Yes")
    asks(page, "Now turn it back")
    turned(page, station, "CCW", 0)
    for end, name, there in (
        ("low end", "CCW", lambda: station.world().antenna_deg[0] < 1.0),
        ("high end", "CW", lambda: station.world().antenna_deg[0] > 440.0),
        ("Another point between", "CCW", lambda: station.world().antenna_deg[0] < 250.0),
    ):
        asks(page, end)
        turn(page, name, there)
        read_there(page)
        enter(page, station.world().antenna_deg[0])
    asks(page, "Another point between")
    assert page.locator(".gauge .taken").count() == 3
    assert violations(page) == []
    answer(page, "No more points")
    asks(page, "The lowest angle")
    assert violations(page) == []
    answer(page, "Take this angle")
    asks(page, "The highest angle")
    answer(page, "Take this angle")
    asks(page, "Save this?")
    answer(page, "Save it")
    asks(page, "The azimuth is calibrated")
    page.locator(".guide", has_text="off a straight line").get_by_text("Saved in").wait_for()
    assert violations(page) == []
    answer(page, "Done")
    assert len(kept(station)["azimuth"]["calibration"]) == 3
    page.get_by_role("link", name="Antenna").click()
    page.get_by_label("Azimuth", exact=True).fill("123")
    page.get_by_label("Elevation", exact=True).fill("0")
    page.get_by_role("button", name="Point there").click()
    waits_for(page, lambda: abs(station.world().antenna_deg[0] - 123.0) < 3.0 and station.world().drives == (0, 0))


def test_a_rotor_without_a_sensor_is_timed_on_a_phone(start: Start, visit: Visit) -> None:
    station = start("[sim.azimuth]\nspeed_dps = 40\n[azimuth]\nspeed_dps = 30\n", kind="relay-timed")
    page = visit(station, **PHONE)
    begin(page, "azimuth")
    for question, name in (("Turn it clockwise", "CW"), ("Now turn it back", "CCW")):
        asks(page, question)
        turned(page, station, name, 0)
        answer(page, "Yes")
    asks(page, "Measure the times now?")
    answer(page, "Measure them")
    asks(page, "First counter-clockwise")
    title = page.locator(".guide h2")
    # A browser that a busy machine keeps waiting stops the motor, and then the box begins with these ways again.
    for _ in range(12):
        way = title.inner_text()
        if way.startswith("Save"):
            break
        answer(page, "Start the motor")
        waits_for(page, lambda way=way: title.inner_text() != way)  # type: ignore[misc]
        end_deg = 360.0 if way.startswith("Now") else 0.0
        waits_for(page, lambda: page.locator(".watch").count() > 0 or title.inner_text() != RUNS)
        waits_for(page, partial(arrived, page, station, end_deg))
        if title.inner_text() == RUNS:
            answer(page, "It stands at its stop")
        waits_for(page, lambda: title.inner_text() != RUNS)
    asks(page, "Save this?")
    page.get_by_text("From stop to stop it takes").wait_for()
    answer(page, "Save it")
    asks(page, "The azimuth is calibrated")
    assert 8.0 < kept(station)["timed"]["azimuth"]["to_high_s"] < 20.0


def test_a_motor_stops_when_the_browser_goes_and_a_calibration_that_is_left_saves_nothing(
    start: Start, visit: Visit
) -> None:
    station = start()
    before = kept(station)
    page = visit(station, **PHONE)
    begin(page, "azimuth")
    asks(page, "Turn it clockwise")
    turn(page, "CW", lambda: station.world().drives == (1, 0))
    waits_for(page, lambda: station.world().drives == (0, 0))
    page.get_by_role("button", name="Hold to turn CW").hover()
    page.mouse.down()
    waits_for(page, lambda: station.world().drives == (1, 0))
    page.context.set_offline(True)
    waits_for(page, lambda: station.world().drives == (0, 0))
    page.context.set_offline(False)
    page.mouse.up()
    page.get_by_role("button", name="Leave", exact=True).click()
    page.locator(".asks").get_by_role("button", name="Leave", exact=True).click()
    asks(page, "The azimuth is as it was before")
    page.get_by_text("Left: nothing is saved.").wait_for()
    assert kept(station) == before
