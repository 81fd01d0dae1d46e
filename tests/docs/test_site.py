"""The site of the pages: every page has its place in the margin, and nothing is fetched from the network."""

from __future__ import annotations

import runpy
from pathlib import Path

from docs.site.check import from_elsewhere

DOCS = Path(__file__).parents[2] / "docs"


def test_every_page_has_one_place_in_the_margin() -> None:
    listed = runpy.run_path(str(DOCS / "site" / "conf.py"))["listed"]()
    places = [page for pages in listed.values() for page in pages]
    assert sorted(places) == sorted(
        path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md") if path.name != "index.md"
    )


def test_what_a_browser_would_fetch_from_elsewhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "own.html").write_text('<script src="_static/a.js"></script><a href="https://example.org">a link</a>')
    (tmp_path / "own.css").write_text("a { background: url(data:image/png;base64,AA) }")
    assert from_elsewhere(tmp_path) == []
    (tmp_path / "far.html").write_text(
        '<script src="https://cdn.example/a.js"></script><img src="//cdn.example/a.png">'
    )
    (tmp_path / "far.css").write_text("@import 'https://fonts.example/a.css'; a { src: url(https://fonts.example/b) }")
    assert from_elsewhere(tmp_path) == [
        "far.html: <script> https://cdn.example/a.js",
        "far.html: <img> //cdn.example/a.png",
        "far.css: https://fonts.example/a.css",
        "far.css: https://fonts.example/b",
    ]
