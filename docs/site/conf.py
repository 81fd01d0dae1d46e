"""How Sphinx makes a site of the pages: `make docs`. The pages themselves stay plain Markdown.

Knows the order of the pages in the margin. A broken link or anchor, and a page that is in no list, end the build.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parents[1]

project = "gs232-rotator"
copyright = "its authors, MIT licence"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
root_doc = "index"
exclude_patterns = ["drawings", "site", "img"]
html_theme = "furo"
html_title = "gs232-rotator"
html_show_sphinx = False
html_copy_source = False
html_static_path = ["static"]
html_css_files = ["pages.css"]
smartquotes = False
"""Values of the file keep their straight quotes, and three dots stay three dots."""
myst_heading_anchors = 4
"""Headings get the anchors that forges give them: links work there and here."""
myst_links_external_new_tab = True
suppress_warnings = ["myst.header"]

SECTIONS = ("Build it", "Your program", "Something is wrong", "For reading", "Reference")
"""Headings of the map, whose links are the lists in the margin."""


def listed() -> dict[str, list[str]]:
    """Section of the map to its pages, each page once."""
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    seen: set[str] = set()
    lists: dict[str, list[str]] = {}
    for section in SECTIONS:
        body = text.split(f"## {section}\n")[1].split("\n## ")[0]
        pages = [page for page in re.findall(r"\]\(([\w/-]+)\.md\)", body) if page not in seen]
        lists[section] = pages
        seen.update(pages)
    # Reference pages are named in passing above; they belong to their own list.
    for section in SECTIONS[:-1]:
        lists[section] = [page for page in lists[section] if not page.startswith("reference/")]
    lists["Reference"] = sorted(
        path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.glob("reference/*.md")
    )
    return lists


def add_lists(_app: Any, page: str, source: list[str]) -> None:
    """The lists of the margin, put below the map, where a forge need not show them."""
    if page == root_doc:
        for section, pages in listed().items():
            body = "\n".join(pages)
            source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {section}\n\n{body}\n```\n"


def setup(app: Any) -> None:
    app.connect("source-read", add_lists)
