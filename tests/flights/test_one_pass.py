"""The picture of one pass in the README is what the box and the emulated sketch fly: ticks, errors and all."""

from __future__ import annotations

from pathlib import Path

from benchmarks.one_pass import TARGET, flown
from rotator.views.pass_svg import DRIVES, closings, draw

IMAGE = Path(__file__).parents[2] / "docs" / "img" / "one-pass.svg"


def test_the_picture_in_the_documents_is_what_is_flown() -> None:
    """If this fails: python -m benchmarks.one_pass docs/img/one-pass.svg."""
    flights = flown()
    assert IMAGE.read_text(encoding="utf-8") == draw(TARGET, flights)
    for flight in flights:
        ticks = [t for drive in DRIVES.values() for t in closings(flight.trace, drive)]
        assert len(ticks) == flight.summary.relay_starts, "a tick is a start"
