"""The pointing plot: what the kept figures make is what the README shows, and its labels can be read."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

from benchmarks.picture import PEERS, PLOT, Point, kept, labels

IMAGE = Path(__file__).parents[2] / "docs" / "img" / "passes.svg"
CLOSE: dict[str, Point] = {"sketch": (190, 4.7), "4°": (35, 2.0), "3°": (36, 2.1), "at the edge": (990, 7.8)}


def test_the_picture_in_the_documents_is_what_the_kept_figures_make() -> None:
    """If this fails: python -m benchmarks.picture docs/img/passes.svg."""
    assert IMAGE.read_text(encoding="utf-8") == kept()


def test_labels_stay_inside_and_apart() -> None:
    points = {**CLOSE, **PEERS}
    placed = labels(points, dict.fromkeys(points, "black"))
    assert len(placed) == len(points)
    assert all(label.box.inside(PLOT) for label in placed)
    assert not [(a.text, b.text) for a, b in combinations(placed, 2) if a.box.hits(b.box)]
