"""The film of the README is what its source makes, small, and an image that runs without a script."""

from __future__ import annotations

from xml.etree import ElementTree as ET

from docs.film import FILE, film

MOST_BYTES = 200 * 1024


def test_the_film_in_the_readme_is_what_is_flown() -> None:
    """If this fails: make picture-demo."""
    made = film()
    assert FILE.read_text(encoding="utf-8") == made
    assert len(made.encode()) <= MOST_BYTES
    names = {each.tag.rpartition("}")[2] for each in ET.fromstring(made).iter()}
    assert "animate" in names
    assert "script" not in names
    assert "docs/img/demo.svg" in (FILE.parents[2] / "README.md").read_text(encoding="utf-8")
