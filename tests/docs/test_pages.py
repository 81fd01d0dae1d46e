"""The pages for a person with a soldering iron: links lead somewhere, sums and pins are right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from docs.drawings.album import profile, sheets

DOCS = Path(__file__).parents[2] / "docs"
PAGES = ["wiring.md", "wiring-g5500.md", "wiring-ssr.md", "wiring-heartbeat.md", "parts.md", "commissioning.md"]


def text(name: str) -> str:
    return (DOCS / name).read_text(encoding="utf-8")


def anchors(name: str) -> set[str]:
    """Headings as the usual viewers make anchors of them."""
    headings = re.findall(r"^#+ (.+)$", re.sub(r"```.*?```", "", text(name), flags=re.DOTALL), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES)
def test_every_link_leads_somewhere(page: str) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", text(page)):
        path, _, anchor = target.replace("\n", "").partition("#")
        assert (DOCS / (path or page)).is_file(), target
        if anchor:
            assert anchor in anchors(path or page), target


def test_every_picture_is_shown_on_some_page() -> None:
    shown = {name for page in PAGES for name in re.findall(r"\(img/([\w-]+)\.svg\)", text(page))}
    assert shown == {sheet.file for sheet in sheets()}


@pytest.mark.parametrize("build", [0, 1, 2])
def test_the_prices_add_up(build: int) -> None:
    table = text("parts.md").split("## ")[0]
    rows = [line.strip("| ").split("|") for line in table.splitlines() if line.startswith("| ")]
    column = [row[1 + build].strip(" *") for row in rows if len(row) >= 4]
    prices = [int(price) for price in column if price.isdigit()]
    *single, total = prices
    assert len(single) > 10
    assert sum(single) == total


def test_the_g_5500s_table_names_the_gpios_of_its_profile() -> None:
    rows = dict(re.findall(r"\| relay \d, GPIO (\d+) \| `relays\.(\w+)` \|", text("wiring-g5500.md")))
    relays = profile("g5500").relays
    assert {key: int(gpio) for gpio, key in rows.items()} == {
        "azimuth_cw": relays.azimuth_cw,
        "azimuth_ccw": relays.azimuth_ccw,
        "elevation_up": relays.elevation_up,
        "elevation_down": relays.elevation_down,
    }
