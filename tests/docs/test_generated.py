"""What the program itself knows stands on the pages as the program says it."""

from __future__ import annotations

from docs.generate import DOCS, PARTS, renewed
from tests.tables import every_row


@every_row("page", PARTS)
def test_the_page_is_what_the_program_makes(page: str) -> None:
    """If this fails: make reference."""
    text = (DOCS / page).read_text(encoding="utf-8")
    assert text == renewed(text, PARTS[page])


def test_no_value_of_the_program_leaks_its_own_name_into_the_pages() -> None:
    for page in PARTS:
        assert "Undefined" not in (DOCS / page).read_text(encoding="utf-8")
