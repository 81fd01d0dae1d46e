"""Fifty browsers at once: run `python -m benchmarks.page`, with `--seconds` and `--browsers`.

The box runs as in `rotator run`, in real time, and tracks a satellite made for this moment. First alone, then with the
browsers, each of which takes ten pictures a second, in a process of their own; then alone again. Tells how late the
control loop was, how much of one core the box took, how long a stop took from the request to the open relay, and the
memory. At last, where Chromium is: how soon the page paints, and how long a STOP takes from the finger to the relay.
"""

from __future__ import annotations

import argparse
import asyncio
import resource
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import aiohttp

from benchmarks.sky_now import as_json, satellite, sets_in
from rotator.app import App
from rotator.config.load import load
from rotator.orbits.earth import Site
from rotator.orders import Aim, Release, Source
from rotator.web import assets

ROTOR = """
[state]
path = "{folder}/state.json"
[page]
listen = "127.0.0.1:{port}"
[station]
locator = "JO62qm"
[sky]
elements = ["{folder}/made.json"]
"""
SITE = Site(52.52, 13.375, 0.0)
NAME = "MADE"
CHROMIUM = "/usr/bin/chromium"
PAINTS = 5
TIMED = "addEventListener('pointerdown', each => { window.pressed = performance.timeOrigin + each.timeStamp }, true)"
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"
CROWD = """
import asyncio, sys, time, aiohttp
url, browsers, lasts_s = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
async def look(http):
    seen, until_s = 0, time.monotonic() + lasts_s
    async with http.ws_connect(url) as socket:
        while time.monotonic() < until_s:
            await socket.receive_str()
            seen += 1
    return seen
async def main():
    async with aiohttp.ClientSession() as http:
        seen = await asyncio.gather(*(look(http) for _ in range(browsers)))
        print(min(seen) / lasts_s, flush=True)
asyncio.run(main())
"""
STOPS = 10


@dataclass(frozen=True, slots=True)
class Figures:
    late_p99_ms: float
    core_percent: float
    stop_ms: float
    memory_mib: float

    def __str__(self) -> str:
        return (
            f"control loop late p99 {self.late_p99_ms:.1f} ms, {self.core_percent:.0f} % of a core, "
            f"STOP to relay {self.stop_ms:.0f} ms, {self.memory_mib:.1f} MiB"
        )


async def measured(app: App, config: Path, url: str, lasts_s: float) -> Figures:
    """The box for so long beside a pass; then some stops."""
    late_ms: list[float] = []
    app.loop.post(Source("console"), Release())
    command = (sys.executable, "-m", "rotator", "tell", "--config", str(config), "track", NAME)
    asked = await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.DEVNULL)
    assert await asked.wait() == 0, "the box tracks it"
    while app.loop.status.flown is None:
        await asyncio.sleep(0.1)
    begin_s, used_s = time.monotonic(), time.process_time()
    while time.monotonic() < begin_s + lasts_s:
        at_s = app.loop.status.at_s
        for _ in range(20):
            await asyncio.sleep(0.04)
            if app.loop.status.at_s != at_s:
                at_s = app.loop.status.at_s
                late_ms.append(1000.0 * app.loop.status.cycle_late_s)
    core_percent = 100.0 * (time.process_time() - used_s) / (time.monotonic() - begin_s)
    stops_ms = [await stop_ms(app, url) for _ in range(STOPS)]
    return Figures(statistics.quantiles(late_ms, n=100)[98], core_percent, statistics.median(stops_ms), memory_mib())


async def stop_ms(app: App, url: str) -> float:
    world = app.station.world
    assert world is not None, "it is simulated"
    await turns(app)
    opened = opens(app)
    async with aiohttp.ClientSession() as http:
        asked_s = time.monotonic()
        async with http.post(f"{url}/api/stop"):
            pass
    return 1000.0 * (await asyncio.wait_for(opened, 10.0) - asked_s)


async def turns(app: App) -> None:
    """The antenna turns, far from any target."""
    world = app.station.world
    assert world is not None, "it is simulated"
    app.loop.post(Source("console"), Release())
    far_deg = 50.0 if (app.loop.status.azimuth.angle_deg or 0.0) > 150.0 else 250.0
    app.loop.post(Source("console"), Aim(far_deg, 20.0))
    while world.drives() == (0, 0):
        await asyncio.sleep(0.01)


def opens(app: App) -> asyncio.Future[float]:
    """The moment at which no relay is closed any more, on the clock of the loop."""
    world = app.station.world
    assert world is not None, "it is simulated"
    loop = asyncio.get_running_loop()
    opened: asyncio.Future[float] = loop.create_future()

    def see(now_s: float, _changes: object) -> None:
        if world.drives() == (0, 0):
            loop.call_soon_threadsafe(lambda: None if opened.done() else opened.set_result(now_s))

    world.gpio.on_edges.append(see)
    opened.add_done_callback(lambda _: world.gpio.on_edges.remove(see))
    return opened


async def in_chromium(app: App, url: str) -> str:
    from playwright.async_api import async_playwright  # noqa: PLC0415 - it is put in for this and the tests of the page

    paints_ms, touches_ms = [], []
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        for _ in range(PAINTS):
            page = await (await browser.new_context()).new_page()
            await page.goto(url)
            await page.locator(".headline").wait_for()
            paints_ms.append(float(await page.evaluate(PAINTED)))
            await page.evaluate(TIMED)
            await turns(app)
            opened = opens(app)
            await page.locator("#stop").click()
            opened_utc_s = await asyncio.wait_for(opened, 10.0) - time.monotonic() + time.time()
            touches_ms.append(1000.0 * opened_utc_s - float(await page.evaluate("window.pressed")))
            await page.context.close()
        await browser.close()
    paint_ms, touch_ms = statistics.median(paints_ms), statistics.median(touches_ms)
    return f"in Chromium: first paint after {paint_ms:.0f} ms, from the finger on STOP to the relay {touch_ms:.0f} ms"


def memory_mib() -> float:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 2**20


async def main(browsers: int, lasts_s: float) -> None:
    with tempfile.TemporaryDirectory() as folder:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        up = satellite(NAME, 90_001, time.time(), SITE, sets_in(time.time(), 3.0 * lasts_s + 60.0))
        Path(folder, "made.json").write_text(as_json([up]), encoding="utf-8")
        config = Path(folder, "r.toml")
        config.write_text(ROTOR.format(folder=folder, port=port), encoding="utf-8")
        app, url = App(load(config), config), f"http://127.0.0.1:{port}"
        stop = asyncio.Event()
        box = asyncio.create_task(app.run(stop))
        await asyncio.sleep(5.0)
        print("alone:", await measured(app, config, url, lasts_s))
        command = (sys.executable, "-c", CROWD, f"ws://127.0.0.1:{port}/api/live", str(browsers), str(lasts_s))
        crowd = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        print(f"{browsers} browsers:", await measured(app, config, url, lasts_s))
        told, _ = await asyncio.to_thread(crowd.communicate)
        print(f"each got at least {float(told):.1f} pictures a second")
        print("alone again:", await measured(app, config, url, lasts_s))
        packed = sum(len(asset.packed) for path, asset in assets.load().items() if path != "/")
        print(f"the whole page: {packed / 1024:.1f} KiB compressed")
        if Path(CHROMIUM).exists():
            print(await in_chromium(app, url))
        stop.set()
        await box


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--browsers", type=int, default=50)
    parser.add_argument("--seconds", type=float, default=60.0)
    given = parser.parse_args()
    asyncio.run(main(given.browsers, given.seconds))
