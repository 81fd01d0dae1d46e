"""Reads the finished site: nothing in it may need the network. `python -m docs.site.check FOLDER`.

Knows HTML and CSS as far as they name files that a browser loads by itself: scripts, styles, pictures, fonts.
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path

LOADED = {"script": "src", "img": "src", "link": "href", "source": "src", "iframe": "src"}
_ELSEWHERE = re.compile(r"^(?:https?:)?//")
_IN_STYLES = re.compile(r"(?:url\(|@import\s)[\s\"']*((?:https?:)?//[^\s\"')]+)")


class _Loads(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.elsewhere: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = dict(attrs).get(LOADED.get(tag, "")) or ""
        if _ELSEWHERE.match(named):
            self.elsewhere.append(f"<{tag}> {named}")


def from_elsewhere(folder: Path) -> list[str]:
    """What a browser would fetch from the network while a person reads."""
    found = []
    for page in sorted(folder.rglob("*.html")):
        loads = _Loads()
        loads.feed(page.read_text(encoding="utf-8"))
        found += [f"{page.relative_to(folder)}: {each}" for each in loads.elsewhere]
    for styles in sorted(folder.rglob("*.css")):
        names = _IN_STYLES.findall(styles.read_text(encoding="utf-8"))
        found += [f"{styles.relative_to(folder)}: {name}" for name in names]
    return found


def main() -> None:
    folder = Path(sys.argv[1])
    pages = len(list(folder.rglob("*.html")))
    if found := from_elsewhere(folder):
        sys.exit("\n".join(found))
    print(f"{pages} pages in {folder}/index.html; none needs the network, and the search is in searchindex.js")


if __name__ == "__main__":
    main()
