"""The file of explained survivors: each entry still names a line of its file, and has a reason."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("cosmic_ray", reason="cosmic-ray is missing: make mutants puts it in")

from benchmarks.mutants.explained import Explained, read, stale
from benchmarks.mutants.places import Mutant

CHECKOUT = Path(__file__).parents[2]
FILE = Path(__file__).with_name("survivors.toml")
MUTANT = Mutant(7, 0, "AddNot", "if a:", "if not a:", "")


def test_each_entry_is_of_today_and_has_a_reason() -> None:
    explained = read(FILE)
    assert stale(explained, CHECKOUT) == []
    assert all(each.why.endswith(".") for each in explained)


def test_an_entry_is_for_one_change_or_for_every_change_of_a_line() -> None:
    assert Explained("a.py", "if a:", "Why.", "if not a:").covers("a.py", MUTANT)
    assert Explained("a.py", "if a:", "Why.").covers("a.py", MUTANT)
    assert not Explained("a.py", "if a:", "Why.", "if b:").covers("a.py", MUTANT)
    assert not Explained("b.py", "if a:", "Why.").covers("a.py", MUTANT)
    assert not Explained("a.py", "if b:", "Why.").covers("a.py", MUTANT)


def test_an_entry_whose_line_or_file_is_gone_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text("    if a:\n")
    there, gone, nowhere = (Explained(*each) for each in (("a.py", "if a:", ""), ("a.py", "if", ""), ("b.py", "", "")))
    assert stale([there, gone, nowhere], tmp_path) == ["a.py: if", "b.py: "]
