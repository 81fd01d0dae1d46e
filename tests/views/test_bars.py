"""An axis as a bar: every eighth of a cell counts, and what lies in the way is marked."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from rotator.views.axis_rows import FORBIDDEN, OVERLAP, PARTS, Bar, forbidden, overlap
from tests.tables import every_row


@every_row(
    ("angle_deg", "shown"),
    [
        (None, "        "),
        (0.0, "▏       "),
        (1.25, "▏       "),
        (10.0, "█       "),
        (13.75, "█▍      "),
        (40.0, "████    "),
        (80.0, "████████"),
        (95.0, "████████"),
        (-9.0, "▏       "),
    ],
)
def test_a_bar_of_ten_degrees_a_cell(angle_deg: float | None, shown: str) -> None:
    assert Bar(0.0, 80.0, 8).filled_to(angle_deg, "").plain == shown


@given(st.floats(0.0, 450.0), st.floats(0.0, 450.0), st.integers(8, 200))
def test_of_two_angles_the_larger_one_is_never_shorter(one_deg: float, other_deg: float, cells: int) -> None:
    def eighths(angle_deg: float) -> int:
        text = Bar(0.0, 450.0, cells).filled_to(angle_deg, "").plain
        assert len(text) == cells
        return sum(PARTS.index(cell) + 1 for cell in text.rstrip())

    low_deg, high_deg = sorted((one_deg, other_deg))
    assert eighths(low_deg) <= eighths(high_deg)
    assert high_deg - low_deg < 450.0 / cells / 4 or eighths(low_deg) < eighths(high_deg)


def test_the_overlap_is_what_lies_beyond_a_whole_turn() -> None:
    bar = Bar(0.0, 450.0, 45, overlap(0.0, 450.0))
    assert bar.filled_to(None, "").plain == " " * 36 + OVERLAP * 9
    assert bar.filled_to(None, "", names=True).plain == " " * 36 + "░overlap░"
    assert bar.filled_to(400.0, "", names=True).plain == "█" * 40 + OVERLAP * 5
    assert not overlap(0.0, 360.0)


def test_a_narrow_sector_is_marked_and_a_wide_one_has_its_name() -> None:
    narrow = Bar(0.0, 360.0, 36, [forbidden("the chimney", 101.0, 102.0)])
    assert narrow.filled_to(None, "", names=True).plain.index(FORBIDDEN) == 10
    wide = Bar(0.0, 360.0, 36, [forbidden("the chimney", 100.0, 240.0)])
    assert "▒the chimney▒" in wide.filled_to(None, "", names=True).plain


@every_row(
    ("low_deg", "high_deg", "cells", "labels"),
    [
        (0.0, 450.0, 48, ["0", "90", "180", "270", "360", "450"]),
        (0.0, 180.0, 46, ["0", "45", "90", "135", "180"]),
        (-180.0, 180.0, 30, ["-180", "0", "180"]),
        (2.5, 87.5, 60, ["2.5", "15", "30", "45", "60", "75", "87.5"]),
        (0.0, 450.0, 8, ["0", "450"]),
    ],
)
def test_the_scale_has_both_limits_and_round_angles(
    low_deg: float, high_deg: float, cells: int, labels: list[str]
) -> None:
    scale = Bar(low_deg, high_deg, cells).scale().plain
    assert len(scale) == cells
    assert scale.split() == labels


def test_a_label_stands_at_its_angle() -> None:
    scale = Bar(0.0, 450.0, 90).scale().plain
    bar = Bar(0.0, 450.0, 90)
    for label in ("90", "180", "270", "360"):
        end = len(bar.filled_to(float(label), "").plain.rstrip())
        assert abs(scale.index(label) + len(label) / 2 - end) <= 1.0
    assert all(one != other for one, other in itertools.pairwise(scale.split()))
