"""The planted bugs fit the source of today: each goes in, leaves files that Python can read, and comes out again."""

from __future__ import annotations

import ast
import shutil
from pathlib import Path

import pytest

from benchmarks.drills.accusations import TABLE
from benchmarks.drills.planted.patch import FOLDER, Bug, bugs, plant
from benchmarks.drills.script import Drill

ROOT = Path(__file__).parents[2]
BUGS = bugs()


def copied(bug: Bug, tmp_path: Path) -> Path:
    for path in bug.paths:
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / path, tmp_path / path)
    return tmp_path


@pytest.mark.parametrize("bug", BUGS.values(), ids=BUGS.keys())
def test_a_planted_bug_fits_the_source_and_comes_out_again(bug: Bug, tmp_path: Path) -> None:
    tree = copied(bug, tmp_path)
    before = {path: (tree / path).read_bytes() for path in bug.paths}
    plant(bug, tree)
    for path in bug.paths:
        assert (tree / path).read_bytes() != before[path]
        ast.parse((tree / path).read_text(), path)
    plant(bug, tree, back=True)
    assert {path: (tree / path).read_bytes() for path in bug.paths} == before


def test_no_planted_bug_changes_the_simulated_world_or_its_judges() -> None:
    assert not [
        path for bug in BUGS.values() for path in bug.paths if path.startswith(("firmware_sim/", "benchmarks/"))
    ]


@pytest.mark.parametrize("bug", BUGS.values(), ids=BUGS.keys())
def test_a_planted_bug_has_its_judges_and_a_script_that_shows_it(bug: Bug) -> None:
    assert set(bug.judges) <= set(TABLE)
    assert Drill.from_json((FOLDER / f"{bug.name}.json").read_text()).events


def test_the_table_of_what_was_found_names_planted_bugs_in_their_order() -> None:
    table = (ROOT / "docs" / "drills.md").read_text().partition("<!-- planted: begin -->")[2]
    names = [line.split(" | ")[0] for line in table.splitlines() if " | " in line][1:]
    assert names
    assert names == [name for name in BUGS if name in names]
