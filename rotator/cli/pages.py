"""`rotator help WORDS`: prints the section of the documentation to which a message points, as plain text.

Knows where the pages are and how a heading becomes a name. Knows no command, and nothing of what the pages say.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import rotator

_PACKAGE = Path(rotator.__file__).parent
FOLDERS = (_PACKAGE / "docs", _PACKAGE.parent / "docs")
"""In the installed package; in a clone."""
FIRST = ("troubleshooting", "paths/pot", "wiring")
"""Where two pages have the same heading, these come first."""
_LINK = re.compile(r"\[([^\[\]]*)\]\(([^()\s]+)\)")


@dataclass(frozen=True, slots=True)
class Section:
    name: str
    """As in a link: `pot-open-or-shorted`; of a whole page `wiring`."""
    page: str
    text: str


def found(words: Sequence[str]) -> Section | None:
    """The section that the words name: a heading or its beginning, a page, or a page and a heading of it or that one's
    beginning."""
    names = [_name(part) for word in words for part in re.split(r"#", re.sub(r"^.*/|\.md\b", "", word)) if part]
    whole, page = "-".join(names), "-".join(names[:1])
    everything = list(_sections())
    there = [each for each in everything if each.page.rpartition("/")[2] == page]
    heading = "-".join(names[1:])
    ways = (
        [each for each in everything if each.name == whole],
        [each for each in there if each.name == heading],
        [each for each in everything if whole and each.name.startswith(whole)],
        [each for each in there if heading and each.name.startswith(heading)],
    )
    return next((way[0] for way in ways if way), None)


def near(words: Sequence[str]) -> list[str]:
    """Names like these words."""
    names = dict.fromkeys(each.name for each in _sections())
    return difflib.get_close_matches("-".join(map(_name, words)), list(names), n=3, cutoff=0.5)


def plain(text: str) -> str:
    """Without pictures; a link to another page is the command that prints it."""
    text = re.sub(r"^!\[.*\n\n?", "", text, flags=re.MULTILINE)
    return _LINK.sub(_link_text, text)


def _link_text(link: re.Match[str]) -> str:
    label, to = link.groups()
    page, _, heading = to.partition("#")
    if "://" in to or not (page.endswith(".md") or heading):
        return f"{label} ({to})" if "://" in to else label
    words = [part for part in (re.sub(r"^.*/|\.md$", "", page), heading) if part]
    return f"{label} (rotator help {' '.join(words)})"


def _sections() -> Iterator[Section]:
    """Whole pages, and each heading with what stands below it, up to the next of its rank."""
    folder = next((each for each in FOLDERS if each.is_dir()), FOLDERS[0])
    paths = {str(path.relative_to(folder).with_suffix("")): path for path in sorted(folder.rglob("*.md"))}
    pages = [*(name for name in FIRST if name in paths), *(name for name in paths if name not in FIRST)]
    texts = {name: paths[name].read_text(encoding="utf-8") for name in pages}
    yield from (Section(name.rpartition("/")[2], name, text) for name, text in texts.items())
    for name, text in texts.items():
        for heading in re.finditer(r"^(#{2,4}) (.+)$", text, re.MULTILINE):
            end = re.compile(rf"^#{{1,{len(heading[1])}}} ", re.MULTILINE).search(text, heading.end())
            yield Section(_name(heading[2]), name, text[heading.start() : end.start() if end else len(text)])


def _name(heading: str) -> str:
    """As a link to it is written."""
    return re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", heading.strip().lower()))
