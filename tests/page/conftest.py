"""The real program on a simulated rotor, and Debian's Chromium before it: `make test-page`.

Where the browser is missing the tests skip; on the build machine they fail. Nothing here waits for a time to pass, only
for what must come.
"""

from __future__ import annotations

import fcntl
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from firmware_sim import world_file
from firmware_sim.world_file import WorldState
from tests.boxes import FAST_ROTOR, file_with_page, free_port

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

START_S = 60.0
PATIENCE_MS, LOOK_MS = 30_000, 50
BROWSERS = {"chromium": "/usr/bin/chromium", "firefox": "/usr/bin/firefox-esr"}
OVER_IT: dict[str, str | float | bool] = {"widget.gtk.overlay-scrollbars.enabled": True, "ui.useOverlayScrollbars": 1}
"""Firefox: a scrollbar lies over the page, as on a phone and as in Chromium without a window, and takes no width."""
QUIET = (
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--host-resolver-rules=MAP rotator.lan 127.0.0.1"),
)


@pytest.fixture(scope="session")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Chromium; another that ROTATOR_BROWSER names."""
    name = os.environ.get("ROTATOR_BROWSER", "chromium")
    program = BROWSERS[name]
    if not Path(program).exists():
        reason = f"{name} is missing: sudo apt install {Path(program).name}"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    from playwright.sync_api import sync_playwright

    # A browser runs on another machine than the box: it may not take the box's time.
    behind = tmp_path_factory.mktemp("browser") / name
    behind.write_text(f'#!/bin/sh\nexec nice -n 15 {program} "$@"\n', encoding="utf-8")
    behind.chmod(0o755)
    with sync_playwright() as playwright:
        if name == "firefox":
            opened = playwright.firefox.launch(
                executable_path=behind, channel="moz-firefox", firefox_user_prefs=OVER_IT
            )
        else:
            opened = playwright.chromium.launch(executable_path=behind, args=list(QUIET))
        yield opened
        opened.close()


@pytest.fixture
def usual_port() -> Iterator[None]:
    """For boxes that take rotctld's usual port, as the page writes it: one of them at a time."""
    with (Path(tempfile.gettempdir()) / "rotator-test-4533.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


@dataclass
class Station:
    """The program as a process, with the file of its simulated world."""

    folder: Path
    url: str
    process: subprocess.Popen[bytes]
    named: tuple[str, ...] = ("--config", "r.toml")
    """How its commands name its file; empty: it was started without one."""

    def tell(self, *words: str) -> str:
        """`rotator tell WORDS`, as a person at the box types it."""
        command = (sys.executable, "-m", "rotator", "tell", *self.named, *words)
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def world(self) -> WorldState:
        """Where the simulated antenna really is, and which relays are closed."""
        state = world_file.read(self.folder / "world")
        assert state is not None
        return state

    def points(self, azimuth_deg: float, elevation_deg: float) -> bool:
        antenna_deg = self.world().antenna_deg
        return abs(antenna_deg[0] - azimuth_deg) < 5.0 and abs(antenna_deg[1] - elevation_deg) < 5.0


STATIONS: dict[str, Station] = {}
"""By the address of the page."""


def code_at_the_box(page: Page) -> str:
    """A code for this page, by `rotator pair`: no page shows it."""
    station = next(station for url, station in STATIONS.items() if page.url.startswith(f"{url}/"))
    found = re.search(r"\d{6}", station.tell("pair"))
    assert found is not None
    return found[0]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Station]]:
    """Starts the program. `more`: text for the end of its file; `words`: of the command line.

    `kind`: another rotor, of its usual speed. `page`: further keys of its page.
    """
    started: list[subprocess.Popen[bytes]] = []

    def run(more: str = "", *words: str, kind: str = "", page: str = "", azimuth_alone: bool = False) -> Station:
        port = free_port()
        text = file_with_page(tmp_path, port, f'[sim]\nworld = "{tmp_path}/world"\n{more}', page)
        if kind:
            text = text.replace("[rotor]", f'[rotor]\ntype = "{kind}"').replace(FAST_ROTOR, "")
        if azimuth_alone:
            text = text.replace("[elevation]\n", "[elevation]\nfitted = false\n")
        (tmp_path / "r.toml").write_text(text, encoding="utf-8")
        command = (sys.executable, "-m", "rotator", "run", "--plain", "--config", str(tmp_path / "r.toml"), *words)
        with (tmp_path / "log").open("wb") as log:
            process = subprocess.Popen(command, cwd=tmp_path, stdout=log, stderr=subprocess.STDOUT)
        started.append(process)
        station = STATIONS[f"http://127.0.0.1:{port}"] = Station(tmp_path, f"http://127.0.0.1:{port}", process)
        until_it_answers(station)
        return station

    yield run
    for process in started:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        assert process.wait(timeout=START_S) == 0


def until_it_answers(station: Station) -> None:
    deadline_s = time.monotonic() + START_S
    while time.monotonic() < deadline_s:
        try:
            with urllib.request.urlopen(f"{station.url}/api/me", timeout=5.0) as answer:
                assert answer.status == 200
                return
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            assert station.process.poll() is None, (station.folder / "log").read_text()
            time.sleep(0.1)
    pytest.fail((station.folder / "log").read_text())


@pytest.fixture
def visit(browser: Browser) -> Iterator[Callable[..., Page]]:
    """Opens the page in a browser of its own, until it `shows` this. A mistake of the page's own scripts fails."""
    contexts = []
    mistakes: list[str] = []

    def go(station: Station, shows: str = ".headline", **how: object) -> Page:
        context = browser.new_context(**how)  # type: ignore[arg-type]
        context.set_default_timeout(PATIENCE_MS)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda mistake: mistakes.append(str(mistake)))
        page.on("console", lambda said: mistakes.append(said.text) if "Content Security Policy" in said.text else None)
        foreign: list[str] = []
        page.on("request", lambda request: foreign.append(request.url) if station.url not in request.url else None)
        page.goto(station.url)
        page.locator(shows).first.wait_for()
        assert foreign == []
        return page

    yield go
    for context in contexts:
        context.close()
    assert mistakes == []


def headline(page: Page, text: str) -> None:
    """Wait until the page says this of the box in its largest words."""
    said: list[str] = []
    for _ in range(PATIENCE_MS // LOOK_MS):
        now = page.locator(".headline h2").inner_text()
        if text in now:
            return
        said += [now] if said[-1:] != [now] else []
        page.wait_for_timeout(LOOK_MS)
    pytest.fail(f"the page never says {text!r}, but {said}: {page.locator('main').inner_text()}")


def pair(page: Page, name: str = "test") -> None:
    """As a person does: ask, read the six digits at the box, type them."""
    page.get_by_role("button", name="Pair this browser").click()
    page.get_by_text("PAIR CODE").wait_for()
    page.get_by_label("Code").fill(code_at_the_box(page))
    page.get_by_label("Name").fill(name)
    page.get_by_role("button", name="Pair", exact=True).click()
    page.get_by_role("button", name="Point there").wait_for()


def violations(page: Page) -> list[Any]:
    """What axe finds that some people cannot read."""
    from axe_playwright_python.sync_playwright import Axe

    found = Axe().run(page).response["violations"]
    return [(each["id"], [node["target"] for node in each["nodes"]]) for each in found]
