"""The page in Debian's Chromium: how soon it paints, and how long a STOP takes from the finger to the relay.

Knows one browser and the box's relays. Judges nothing.
"""

from __future__ import annotations

import asyncio
import time
from pathlib import Path

from benchmarks.page.box import PATIENCE_S, MeasuredBox

CHROMIUM = Path("/usr/bin/chromium")
PAINTS = 5
TIMED = "addEventListener('pointerdown', each => { window.pressed = performance.timeOrigin + each.timeStamp }, true)"
PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"


async def in_chromium(box: MeasuredBox) -> tuple[list[float], list[float]]:
    """The first paints and the stops, in milliseconds."""
    from playwright.async_api import async_playwright  # noqa: PLC0415 - it is put in for this and the tests of the page

    paints_ms, touches_ms = [], []
    async with async_playwright() as playwright:
        browser = await playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        for _ in range(PAINTS):
            page = await (await browser.new_context()).new_page()
            await page.goto(box.url)
            await page.locator(".headline").wait_for()
            paints_ms.append(float(await page.evaluate(PAINTED)))
            await page.evaluate(TIMED)
            await box.turns()
            opened = box.opens()
            await page.locator("#stop").click()
            opened_utc_s = await asyncio.wait_for(opened, PATIENCE_S) - time.monotonic() + time.time()
            touches_ms.append(1000.0 * opened_utc_s - float(await page.evaluate("window.pressed")))
            await page.context.close()
        await browser.close()
    return paints_ms, touches_ms
