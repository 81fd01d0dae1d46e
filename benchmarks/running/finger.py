"""The page in Debian's Chromium, in milliseconds: `python -m benchmarks.running.finger`.

How soon it paints, and how long a STOP takes from the finger to the relay. The exit code is 1 where it paints too late.
"""

from __future__ import annotations

import argparse
import asyncio
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.running.box import PATIENCE_S, Box
from benchmarks.running.busy import JOG_S, tables, told
from benchmarks.running.words import ALL

CHROMIUM = Path("/usr/bin/chromium")
PAINTS, PAINT_MS = 5, 500.0
TIMED = "addEventListener('pointerdown', each => { window.pressed = performance.timeOrigin + each.timeStamp }, true)"
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"


async def in_chromium(box: Box) -> tuple[list[float], list[float]]:
    """The first paints, and the stops."""
    from playwright.async_api import async_playwright  # noqa: PLC0415 - it is put in for this and the tests of the page

    paints_ms, touches_ms = [], []
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        for _ in range(PAINTS):
            page = await (await browser.new_context()).new_page()
            await page.goto(f"http://127.0.0.1:{box.page_port}")
            await page.locator(".headline").wait_for()
            paints_ms.append(float(await page.evaluate(PAINTED)))
            await page.evaluate(TIMED)
            await box.says("resume", "jog ccw 5")
            await asyncio.sleep(JOG_S)
            await box.asked("seen")
            await page.locator("#stop").click()
            async with asyncio.timeout(PATIENCE_S):
                while not (edges := (await box.asked("seen"))["edges"]):
                    await asyncio.sleep(0.1)
            opened_utc_s = edges[0][0] - time.monotonic() + time.time()
            touches_ms.append(1000.0 * opened_utc_s - float(await page.evaluate("window.pressed")))
            await page.context.close()
        await browser.close()
    return paints_ms, touches_ms


async def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        box = Box(Path(folder), tables("relay-pot"), ALL[:1])
        try:
            await box.answers()
            paints_ms, touches_ms = await in_chromium(box)
        finally:
            await box.stop()
    print(f"median, p99, worst\nfirst paint: {told(paints_ms)} ms\nfinger to relay: {told(touches_ms)} ms")
    return int(max(paints_ms) > PAINT_MS)


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__).parse_args()
    sys.exit(asyncio.run(main()))
