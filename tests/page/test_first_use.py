"""From the first start of an installed image to a pass tracked to its end: a browser alone, each press counted.

The box begins with the file that the installer writes, on simulated chips and a rotor as slow as a G-5500. No editor,
no terminal, no `rotator tell`: what a person reads at the box stands on its simulated display.
`pytest -s tests/page/test_first_use.py` prints the sentence that docs/page.md tells.
"""

from __future__ import annotations

import json
import math
import re
import signal
import subprocess
import sys
import time
import tomllib
import urllib.request
from collections import deque
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from benchmarks.sky_now import as_json, satellite, sets_in
from rotator.orbits.earth import Site
from rotator.orbits.locator import from_locator
from tests.boxes import free_port
from tests.page.conftest import START_S, Station, until_it_answers
from tests.page.test_calibrate import turn, turned
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

PlaywrightTimeout = pytest.importorskip("playwright.sync_api").TimeoutError
Visit = Callable[..., "Page"]
ROOT = Path(__file__).parents[2]
LOCATOR = "JO62qm"
LONGITUDE_DEG, LATITUDE_DEG = from_locator(LOCATOR)
SITE = Site(LATITUDE_DEG, LONGITUDE_DEG, 0.0)
PASS_S = 75.0
"""So long the satellite is still up when its elements are sent: a short pass, in honest time."""
COMPUTED_MS = 150_000
LONGEST_S = 1800.0
STANDS_DEG, STANDS_LOOKS = 0.5, 40
TOLD = re.compile(r"(\d+) presses, (\d+) fields typed or\s+chosen, (\d+) presses that\s+turn the rotor")


@pytest.fixture
def installed(tmp_path: Path, usual_port: None) -> Iterator[Station]:
    """The service's first start: its own file, its folders here, and a window into the simulated world."""
    state, port = tmp_path / "lib", free_port()
    state.mkdir()
    program = tmp_path / "rotator"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m rotator "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    command = ("sh", str(ROOT / "install" / "first-config.sh"), str(program), "simulated")
    text = subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout
    text = text.replace("/var/lib/rotator", str(state)).replace("/run/rotator", str(tmp_path))
    text = text.replace("0.0.0.0:8232", f"127.0.0.1:{port}")
    (tmp_path / "r.toml").write_text(f'{text}\n[sim]\nworld = "{tmp_path}/world"\n', encoding="utf-8")
    run = (str(program), "run", "--plain", "--config", str(tmp_path / "r.toml"))
    with (tmp_path / "log").open("wb") as log:
        process = subprocess.Popen(run, cwd=state, stdout=log, stderr=subprocess.STDOUT)
    station = Station(tmp_path, f"http://127.0.0.1:{port}", process)
    until_it_answers(station)
    yield station
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=START_S) == 0


class Finger:
    """A person at the page. Counts what is pressed, and what is typed or chosen."""

    def __init__(self, station: Station, page: Page) -> None:
        self.station, self.page = station, page
        self.presses = self.fields = self.turns = 0

    def press(self, name: str, *, exact: bool = False) -> None:
        self._press(self.page.get_by_role("button", name=name, exact=exact).first)

    def view(self, name: str) -> None:
        self._press(self.page.get_by_role("link", name=name, exact=True))

    def step(self, title: str) -> None:
        self._press(self.page.locator(".step > summary", has_text=re.compile(rf"\d\. {title}")))

    def fill(self, label: str, text: str) -> None:
        self.page.get_by_label(label).first.fill(text)
        self.fields += 1

    def choose(self, label: str, answer: str) -> None:
        self.page.get_by_label(label).first.select_option(answer)
        self.fields += 1

    def write(self) -> None:
        """Agree to the lines that change, and wait for the box to be back."""
        anew = self.page.get_by_text("The box starts anew …").first
        self.press("Write it and start anew")
        anew.wait_for()
        anew.wait_for(state="detached")

    def code(self) -> str | None:
        """The six digits on the display, once they are all there."""
        shown = re.search(r"PAIR CODE (\d{6})", "".join(self.station.world().lcd))
        return shown[1] if shown else None

    def pulse(self, name: str) -> None:
        self._closes_a_relay(name, lambda: self.press(name))
        waits_for(self.page, lambda: not self.moves())

    def turn(self, axis: int, name: str) -> None:
        """Hold the button in the guide of a calibration, until it has seen enough."""
        self.turns += 1
        turned(self.page, self.station, name, axis)

    def _closes_a_relay(self, name: str, press: Callable[[], None]) -> None:
        before = self.station.world().relay_starts
        press()
        try:
            waits_for(self.page, lambda: self.station.world().relay_starts != before)
        except AssertionError:
            shown = self.page.locator(".step[open]").inner_text()
            raise AssertionError(f"{name!r} closes no relay: {self.station.world()}\n{shown}") from None

    def moves(self) -> bool:
        """Whether the box says that the antenna turns, or coasts."""
        with urllib.request.urlopen(f"{self.station.url}/api/status", timeout=5.0) as answer:
            return bool(json.load(answer)["moving"])

    def turn_to_the_end(self, axis: int, name: str) -> int:
        """Until the antenna stands though the motor runs: the whole degree that a person reads off the mast there."""
        seen_deg: deque[float] = deque(maxlen=STANDS_LOOKS)

        def stands() -> bool:
            world = self.station.world()
            seen_deg.append(world.antenna_deg[axis] if world.drives[axis] else math.nan)
            return len(seen_deg) == STANDS_LOOKS and max(seen_deg) - min(seen_deg) < STANDS_DEG

        self.turns += 1
        turn(self.page, name, stands, COMPUTED_MS)
        return round(seen_deg[0])  # the last look may be after the motor stopped

    def _press(self, what: Locator) -> None:
        what.click(timeout=COMPUTED_MS)  # waits until it is there, can be pressed, and stands still
        self.presses += 1


def pairs(finger: Finger) -> None:
    finger.press("Pair this browser")
    waits_for(finger.page, lambda: finger.code() is not None)
    finger.fill("Code", str(finger.code()))
    finger.press("Pair", exact=True)
    finger.page.get_by_role("button", name="Point there").wait_for()


def tells_the_rotor(finger: Finger) -> None:
    finger.step("Which rotor")
    finger.choose("Which rotor?", "g5500")
    finger.choose("Which program turns", "gs232b")
    finger.choose("How is the PC", "pty")
    finger.choose("display on the box", "gpio")
    finger.fill("Where does the antenna stand?", LOCATOR)
    finger.press("See the new file")
    finger.write()
    finger.step("Which rotor")


def looks_at_wires_and_relays(finger: Finger) -> None:
    finger.step("Wiring")
    finger.page.locator(".wiring svg").wait_for()
    finger.step("Wiring")
    finger.step("Try each relay")
    finger.press("Take the antenna")
    for relay in ("azimuth CW", "azimuth CCW", "elevation up", "elevation up", "elevation down"):
        finger.pulse(f"Pulse {relay}")
    finger.press("Give it back to the programs")
    finger.step("Try each relay")
    finger.step("Read the sensors")
    finger.page.locator(".reading", has_text="azimuth: reads").wait_for()
    finger.step("Read the sensors")


def calibrates(finger: Finger, axis: int, plus: str, minus: str) -> None:
    """Direction, both end stops with their angles, and the limits that are offered."""
    name = ("azimuth", "elevation")[axis]

    def asked(question: str) -> None:
        try:
            finger.page.locator(".guide h2", has_text=question).wait_for()
        except PlaywrightTimeout:
            pytest.fail(f"never asked {question!r}: {finger.page.locator('.guide').inner_text()}")

    def angle(degrees: float) -> None:
        finger.fill("Degrees", f"{degrees:g}")
        finger.press("Take this angle")

    finger.step(f"Calibrate the {name}")
    finger.press(f"Calibrate the {name}")
    asked("Turn it")
    finger.turn(axis, plus)
    asked("Did the antenna turn")
    finger.press("Yes")
    asked("Now turn it back")
    finger.turn(axis, minus)
    asked("low end")
    low_deg = finger.turn_to_the_end(axis, minus)
    finger.press("It stands there: read it")
    asked("Which angle")
    angle(low_deg)
    asked("high end")
    high_deg = finger.turn_to_the_end(axis, plus)
    finger.press("It stands there: read it")
    asked("Which angle")
    angle(high_deg)
    asked("Another point between")
    finger.press("No more points")
    asked("The lowest angle")
    finger.press("Take this angle")
    asked("The highest angle")
    finger.press("Take this angle")
    asked("Save this?")
    finger.press("Save it")
    finger.page.locator(".guide", has_text="Saved in").wait_for()
    finger.press("Done")
    seen = finger.page.get_by_role("button", name=f"Both relays of the {name} are open")
    finger.page.get_by_role("button", name=f"Calibrate the {name}").wait_for()
    if seen.count():
        finger.press(f"Both relays of the {name} are open")
        finger.press("I have seen it")
    finger.step(f"Calibrate the {name}")


def sets_limits_place_and_program(finger: Finger) -> None:
    finger.step("Limits")
    finger.fill("park_azimuth_deg", "90")
    finger.press("See the change")
    finger.write()
    finger.step("Limits")
    finger.step("Place and time")
    finger.page.get_by_text("The clocks of the box and of this browser agree.").wait_for()
    finger.step("Place and time")
    finger.step("Your tracking program")
    finger.choose("Your tracking program", "PstRotator")
    port = next(finger.station.folder.rglob("gs232"))
    with port.open("r+b", buffering=0) as program:
        program.write(b"C2\r")
        finger.page.locator(".heard", has_text="PstRotator has just asked for the position: C2").wait_for()
    finger.step("Your tracking program")


def tracks_a_pass_to_its_end(finger: Finger) -> None:
    finger.view("Plan")
    now_s = time.time()
    made = as_json([satellite("FIRST", 90_001, now_s, SITE, sets_in(now_s, PASS_S))]).encode()
    send = finger.page.get_by_label("Send a file")
    send.set_input_files({"name": "first.json", "mimeType": "application/json", "buffer": made})
    finger.fields += 1
    finger.page.get_by_text("first.txt is kept.").wait_for()
    finger.press("Track FIRST")
    finger.page.get_by_text("Tracks FIRST").wait_for()
    finger.press("Picture of FIRST")
    picture = finger.page.locator(".flown img")
    picture.scroll_into_view_if_needed()
    waits_for(finger.page, lambda: bool(picture.evaluate("image => image.complete && image.naturalWidth > 0")))


def test_from_the_first_start_to_a_tracked_pass_with_a_browser_alone(installed: Station, visit: Visit) -> None:
    began_s = time.monotonic()
    finger = Finger(installed, visit(installed, **PHONE))
    pairs(finger)
    finger.view("Setup")
    tells_the_rotor(finger)
    looks_at_wires_and_relays(finger)
    calibrates(finger, 0, "CW", "CCW")
    calibrates(finger, 1, "Up", "Down")
    sets_limits_place_and_program(finger)
    tracks_a_pass_to_its_end(finger)
    lasted_s = time.monotonic() - began_s
    counted = f"{finger.presses} presses, {finger.fields} fields typed or chosen, {finger.turns} presses that turn"
    sys.stdout.write(f"\n{counted} the rotor to its ends; {lasted_s / 60:.1f} min without thinking\n")
    assert lasted_s < LONGEST_S
    written = tomllib.loads((installed.folder / "r.toml").read_text(encoding="utf-8"))
    assert written["station"]["locator"] == LOCATOR
    assert written["mount"]["park_azimuth_deg"] == 90
    assert all(written[axis]["direction_checked"] for axis in ("azimuth", "elevation"))
    told = TOLD.search((ROOT / "docs" / "page.md").read_text(encoding="utf-8"))
    assert told is not None, f"docs/page.md: {counted}"
    presses, fields, turns = map(int, told.groups())
    assert fields == finger.fields
    assert abs(presses - finger.presses) <= 4, "a relay that was not seen to open asks for two presses more"
    assert turns == finger.turns
