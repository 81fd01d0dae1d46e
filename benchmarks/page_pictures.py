"""The pictures of the page: `make picture-page`, or `python -m benchmarks.page_pictures docs/img`.

Starts the box on the simulated rotor with satellites made for this moment, pairs a browser as a person does, tracks
one, and takes each view wide and on a phone, in the light and in the dark. Knows Debian's Chromium, and what the page
says.
"""

from __future__ import annotations

import argparse
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

from benchmarks.sky_now import as_json, rises_in, satellite, sets_in
from rotator.orbits.earth import Site
from rotator.orbits.satellite import Satellite

PORT, ROTCTLD = 18_232, 14_533
URL = f"http://127.0.0.1:{PORT}"
CONFIG = f"""
[rotor]
hardware = "sim"
[station]
locator = "JO62qm"
beam_deg = 30
[mount]
horizon = [[0, 5], [60, 12], [110, 8], [180, 3], [250, 15], [300, 6]]
[[mount.forbidden]]
name = "chimney"
azimuth_deg = [290, 320]
elevation_deg = [0, 35]
[sky]
elements = ["satellites.json"]
[[sky.follow]]
name = "SIM-2"
[[sky.follow]]
name = "SIM-3"
min_culmination_deg = 15
[sim.azimuth]
start_deg = {{azimuth_deg:.0f}}
[sim.elevation]
start_deg = {{elevation_deg:.0f}}
[[link]]
protocol = "gs232b"
pty = "run/gs232"
[[link]]
protocol = "rotctld"
tcp = "127.0.0.1:{ROTCTLD}"
[page]
listen = "127.0.0.1:{PORT}"
"""
PHONE: dict[str, Any] = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
WIDE: dict[str, Any] = {"viewport": {"width": 1440, "height": 900}}
QUIET = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
START_S, PATIENCE_MS = 60.0, 120_000
UP_S, BEFORE_S = 240.0, 12.0
"""So long the tracked satellite is up, and so long it takes until it is tracked."""
SITE = Site(52.52, 13.375, 0.0)
VIEWS = {"sky": 1400, "setup": 0, "doctor": 1100, "wires": 900, "log": 900, "files": 900, "paired": 900, "api": 900}
"""By the name in the address: how high the window is; 0: as high as the screen."""
WHOLE = 1260
"""So high is the Antenna view with its chart in a wide window."""


def sky(now_s: float) -> tuple[str, str]:
    """The file of elements and the configuration: the antenna begins where the satellite will be."""
    up = satellite("SIM-1", 90_001, now_s, SITE, sets_in(now_s, UP_S))
    later = [
        satellite(name, number, now_s, SITE, rises_in(now_s, wait_s))
        for name, number, wait_s in (("SIM-2", 90_002, 1260.0), ("SIM-3", 90_003, 1380.0), ("SIM-4", 90_004, 2400.0))
    ]
    there = Satellite(up, SITE).sight(now_s + BEFORE_S)
    config = CONFIG.format(azimuth_deg=there.azimuth_deg, elevation_deg=there.elevation_deg)
    return as_json([up, *later]), config


def take(into: Path, code: str) -> None:
    """`code`: a new one, of `rotator pair`."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - it is put in for this and the tests of the page

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=QUIET)
        page = browser.new_context(**WIDE).new_page()
        page.set_default_timeout(PATIENCE_MS)
        page.goto(URL)
        page.get_by_role("button", name="Pair this browser").click()
        page.get_by_text("PAIR CODE").wait_for()
        page.get_by_label("Code").fill(code)
        page.get_by_label("Name").fill("Shack PC")
        page.get_by_role("button", name="Pair", exact=True).click()
        page.get_by_label("Track").fill("SIM-1")
        page.get_by_role("button", name="Track", exact=True).click()
        page.locator(".key.next").wait_for()
        page.wait_for_timeout(12_000)
        paired = page.context.storage_state()
        _each(browser, into, paired, "", 0)
        for view, high in VIEWS.items():
            _each(browser, into, paired, view, high)
        browser.close()


def _each(browser: Any, into: Path, paired: Any, view: str, high: int) -> None:
    for light in ("light", "dark"):
        for name, size in {"wide": WIDE, "phone": PHONE}.items():
            height = WHOLE if name == "wide" and not view else high
            viewport = {**size["viewport"], **({"height": height} if height else {})}
            shown: Any = {"color_scheme": light, "storage_state": paired, **size, "viewport": viewport}
            page = browser.new_context(**shown).new_page()
            page.set_default_timeout(PATIENCE_MS)
            page.goto(f"{URL}/api/" if view == "api" else f"{URL}/#{view}")
            match view:
                case "":
                    page.locator(".plot .turned").wait_for(state="attached")
                    page.locator(".key.next").wait_for()
                case "sky":
                    page.locator(".timeline .flown").first.wait_for()
                    page.locator(".passes td").first.wait_for()
                case "setup":
                    _unfold(page)
                case "doctor":
                    page.locator(".doctor li").first.wait_for()
                case "wires":
                    _ask_on_a_link(page)
                case "api":
                    page.locator("summary", has_text="POST /api/point").click()
                    page.locator("summary", has_text="POST /api/point").scroll_into_view_if_needed()
            page.wait_for_timeout(1500)
            page.locator(".troubles").wait_for(state="detached")  # a busy machine is late with a reading
            page.screenshot(path=into / f"page-{f'{view}-' if view else ''}{name}-{light}.png")
            page.context.close()


def _unfold(page: Any) -> None:
    for step in ("Wiring", "Try each relay", "Limits"):
        page.locator(".step > summary", has_text=step).click()
    page.get_by_label("park_azimuth_deg").wait_for()
    page.locator(".wiring svg").wait_for()
    page.locator(".step > summary", has_text="Which rotor").scroll_into_view_if_needed()


def _ask_on_a_link(page: Any) -> None:
    """As a tracking program does: without that the wires have nothing to show."""
    page.get_by_role("region", name="Bytes of the links").wait_for()
    with socket.create_connection(("127.0.0.1", ROTCTLD)) as program:
        for line in (b"_\n", b"p\n", b"p\n"):
            program.sendall(line)
            program.recv(200)


def main(into: Path) -> None:
    into = into.resolve()
    with tempfile.TemporaryDirectory() as folder:
        elements, config = sky(time.time())
        Path(folder, "satellites.json").write_text(elements, encoding="utf-8")
        Path(folder, "r.toml").write_text(config, encoding="utf-8")
        command = (sys.executable, "-m", "rotator", "run", "--plain", "--config", "r.toml")
        with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL) as box:
            try:
                _until_it_answers()
                tell = (sys.executable, "-m", "rotator", "tell", "--config", "r.toml", "pair")
                said = subprocess.run(tell, cwd=folder, capture_output=True, text=True, check=True).stdout
                take(into, said.split()[0])
            finally:
                box.terminate()


def _until_it_answers() -> None:
    until_s = time.monotonic() + START_S
    while time.monotonic() < until_s:
        try:
            urllib.request.urlopen(f"{URL}/api/status", timeout=5.0).close()
            return
        except (urllib.error.URLError, ConnectionError):
            time.sleep(0.2)
    raise TimeoutError(f"there is no page at {URL}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    main(parser.parse_args().folder)
