"""Counts the words of the pages: `python -m docs.words`.

A word holds a letter or a digit: the bars and dashes of a table are none. Reference pages, and what is generated on the
others, are counted apart from the text that a person reads. The last line has the plain count of `wc -w` beside it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
MOST = 34_000
"""Of README and docs together: 32,000 to read and to look up, and 2,000 for the record of the five machines."""
_GENERATED = re.compile(r"<!-- (\w+): begin -->.*?<!-- \1: end -->", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Count:
    page: str
    read: int
    reference: int


def pages() -> list[Path]:
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def words(text: str) -> int:
    return sum(1 for token in text.split() if any(sign.isalnum() for sign in token))


def count(page: Path) -> Count:
    text = page.read_text(encoding="utf-8")
    whole = words(text)
    looked_up = "reference" in page.parts
    generated = whole if looked_up else sum(words(part.group(0)) for part in _GENERATED.finditer(text))
    return Count(str(page.relative_to(ROOT)), whole - generated, generated)


def main() -> None:
    counts = [count(page) for page in pages()]
    for each in counts:
        print(f"{each.page:32} {each.read:6} {each.reference:6}")
    read, reference = sum(each.read for each in counts), sum(each.reference for each in counts)
    print(f"{'to read, reference':32} {read:6} {reference:6}")
    plain = sum(len(page.read_text(encoding="utf-8").split()) for page in pages())
    print(f"{read + reference} words, {MOST} at most; {plain} by wc -w, which counts bars and dashes too")


if __name__ == "__main__":
    main()
