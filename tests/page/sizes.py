"""Whether a view can be used in every window, with larger text: what a person would see is measured.

Knows sizes and geometry. Knows nothing of what a view says, or of how one gets there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.page.conftest import violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

WINDOWS = ((320, 568), (390, 844), (844, 390), (820, 1180), (1366, 768), (1440, 900), (2560, 1440))
TEXT_PERCENT = (100, 200)
"""Of the size that a browser has from its maker, as a person sets it there."""
READ_BY_AXE = 390, 1366
PATIENCE_LOOKS, LOOK_MS = 12, 50
MEASURED = r"""() => {
    const found = [], width = document.documentElement.clientWidth, stop = document.getElementById("stop");
    if (stop) {
        const { left, width: own, top, bottom } = stop.getBoundingClientRect(), seen = visualViewport.width;
        const whole = left === 0 && own === innerWidth && top > innerHeight / 2 && Math.abs(bottom - innerHeight) < 1;
        if (!whole || seen !== innerWidth) found.push("STOP is not whole");
    }
    if (document.documentElement.scrollWidth > innerWidth) found.push("it scrolls sideways");
    const panels = ".panel, .headline, .asks, .log, .guide, .emergency, details, main";
    const text = "a, button, dd, dt, h1, h2, h3, label, li, p, summary, td, th";
    for (const one of document.querySelectorAll("body *:not(svg *)")) {
        const { left, right, width: own, height } = one.getBoundingClientRect(), style = getComputedStyle(one);
        if (!own || !one.checkVisibility() || style.clipPath !== "none") continue;
        if (one.parentElement.closest("pre, .scroller")) continue;
        const panel = style.position !== "fixed" && one.parentElement.closest(panels)?.getBoundingClientRect();
        const cut = one.matches(text) && style.display !== "inline" && one.scrollWidth > one.clientWidth + 1;
        const small = one.matches("button, input, nav a, select, summary, textarea") && height < 43.9;
        const says = (what) => found.push(`${what}: ${one.localName}.${one.className} ${one.innerText}`);
        if (right > width + 1 || left < -1) says("beyond the window");
        else if (panel && (right > panel.right + 1 || left < panel.left - 1)) says("beyond its panel");
        else if (cut) says("cut off");
        if (small) says("too small for a thumb");
    }
    // Words of a language. Paths, keys and addresses may break anywhere.
    const words = /(?<![\/_.=&\p{L}\d])\p{L}[\p{L}’]+(?![\/_.]?[\p{L}\d\/_])/gu;
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), range = document.createRange();
    for (let node; (node = walker.nextNode()); ) {
        const within = node.parentElement, none = "code, noscript, option, pre, svg, .bytes, .only-read";
        if (within.closest(none) || !within.checkVisibility()) continue;
        for (const { 0: word, index } of node.data.matchAll(words)) {
            range.setStart(node, index);
            range.setEnd(node, index + word.length);
            const tops = [...range.getClientRects()].filter((part) => part.width > 0).map(({ top }) => Math.round(top));
            if (new Set(tops).size > 1) found.push(`broken: ${word}, in ${within.localName}.${within.className}`);
        }
    }
    return [...new Set(found)].map((each) => each.slice(0, 120));
}"""
"""What is beyond the window or its panel, cut off, too small for a thumb; and words that are broken inside."""


def misfits(page: Page, name: str) -> list[str]:
    """What does not fit in some window, of the view as it stands; it stands in its first window afterwards.

    Firefox's own size of text cannot be set from here: there it is measured as it is.
    """
    before, browser, found = page.viewport_size, page.context.browser, list[str]()
    assert before is not None
    assert browser is not None
    fonts = page.context.new_cdp_session(page) if browser.browser_type.name == "chromium" else None

    def text(percent: int) -> None:
        if fonts:
            sizes = {"standard": 16 * percent // 100, "fixed": 13 * percent // 100}
            fonts.send("Page.setFontSizes", {"fontSizes": sizes})

    for width, height in WINDOWS:
        page.set_viewport_size({"width": width, "height": height})
        for percent in TEXT_PERCENT if fonts else (100,):
            text(percent)
            found += [f"{name}, {width} px, {percent} %: {each}" for each in _settled(page)]
        if width in READ_BY_AXE:
            text(100)
            found += [f"{name}, {width} px, axe: {each}" for each in violations(page)]
    text(100)
    if fonts:
        fonts.detach()
    page.set_viewport_size(before)
    return found


def _settled(page: Page) -> list[str]:
    """The page draws itself anew after a change of its window: what is still wrong then."""
    for _ in range(PATIENCE_LOOKS):
        wrong = [str(each) for each in page.evaluate(MEASURED)]
        if not wrong:
            break
        page.wait_for_timeout(LOOK_MS)
    return wrong
