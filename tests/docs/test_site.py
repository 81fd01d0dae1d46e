"""The site of the pages: every page has its place in the margin."""

from __future__ import annotations

import runpy
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


def test_every_page_has_one_place_in_the_margin() -> None:
    listed = runpy.run_path(str(DOCS / "site" / "conf.py"))["listed"]()
    places = [page for pages in listed.values() for page in pages]
    assert sorted(places) == sorted(
        path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md") if path.name != "index.md"
    )
