"""The pointing plot: what the kept figures make is what the README shows."""

from __future__ import annotations

from pathlib import Path

from benchmarks.picture import kept

IMAGE = Path(__file__).parents[2] / "docs" / "img" / "passes.svg"


def test_the_picture_in_the_documents_is_what_the_kept_figures_make() -> None:
    """If this fails: python -m benchmarks.picture docs/img/passes.svg."""
    assert IMAGE.read_text(encoding="utf-8") == kept()
