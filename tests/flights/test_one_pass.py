"""The picture of one pass in the README is what the box and the emulated sketch fly: ticks, errors and all."""

from __future__ import annotations

from pathlib import Path

from benchmarks.one_pass import closings, draw, flown

IMAGE = Path(__file__).parents[2] / "docs" / "img" / "one-pass.svg"


def test_the_picture_in_the_documents_is_what_is_flown() -> None:
    """If this fails: python -m benchmarks.one_pass docs/img/one-pass.svg."""
    box, sketch = flown()
    assert IMAGE.read_text(encoding="utf-8") == draw(box, sketch)
    for trace, starts, _ in (box, sketch):
        assert len(closings(trace)) == starts, "a tick is a start"
