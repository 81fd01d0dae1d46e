"""docs/words.md: one thing has one word, and no text of the page, the terminal or the documents has another one."""

from __future__ import annotations

import re

from docs.languages.__main__ import texts
from docs.languages.sentences import ROOT, files, messages

TERMINAL = "rotator/cli", "rotator/views", "rotator/setup"
DOCUMENTS = "docs", "docs/paths"


def rows() -> list[list[str]]:
    lines = (ROOT / "docs/words.md").read_text(encoding="utf-8").splitlines()
    table = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| ")]
    return table[1:]


def unwanted() -> re.Pattern[str]:
    words = [word.strip() for row in rows() for word in row[5].split(",") if word.strip()]
    assert len(words) > 10
    return re.compile(rf"\b(?:{'|'.join(map(re.escape, words))})\b", re.IGNORECASE)


def test_no_text_has_another_word_for_the_same_thing() -> None:
    said = {text: where for (text, _), where in texts().items()}
    said |= {text: path.name for room in TERMINAL for path in files(room) for text in messages(path)}
    pages = [page for folder in DOCUMENTS for page in sorted((ROOT / folder).glob("*.md")) if page.stem != "words"]
    said |= {line: page.name for page in pages for line in page.read_text(encoding="utf-8").splitlines()}
    word = unwanted()
    assert [(where, text) for text, where in said.items() if word.search(text)] == []


def test_what_the_list_says_of_the_page_stands_there() -> None:
    sources = [*(ROOT / "rotator/web/static").glob("*.*"), ROOT / "rotator/views/words.py"]
    said = " ".join(path.read_text(encoding="utf-8") for path in sources if path.suffix in (".js", ".html", ".py"))
    for row in rows():
        for words in re.split(r", (?=[A-Z])", re.sub(r"[●◇]|\d+\.?\d*°", "", row[2])):
            assert words.strip() in said, row
