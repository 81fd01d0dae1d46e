"""docs/safety.md prints the table of who may do what in which state."""

from __future__ import annotations

from pathlib import Path

from rotator.control.rights import table

PAGE = Path(__file__).parents[2] / "docs" / "safety.md"
BEGIN, END = "<!-- rights: begin -->", "<!-- rights: end -->"
AGAIN = (
    "stale: put the output of `.venv/bin/python -c 'from rotator.control.rights import table; print(table())'` there"
)


def test_the_page_has_the_table_as_the_code_has_it() -> None:
    printed = PAGE.read_text(encoding="utf-8").split(BEGIN)[1].split(END)[0]
    assert printed.strip() == table(), AGAIN
