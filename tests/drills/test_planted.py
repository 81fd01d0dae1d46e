"""The planted bugs fit the source of today: each goes in, leaves files that Python can read, and comes out again."""

from __future__ import annotations

import ast
import shutil
from pathlib import Path

import pytest

from benchmarks.drills.accusations import TABLE
from benchmarks.drills.planted.patch import FOLDER, Bug, Misfit, bugs, parse, plant, take_back
from benchmarks.drills.script import Drill

ROOT = Path(__file__).parents[2]
BUGS = bugs()
PATCH = """\
Wrong: the sign is lost,
  so it turns the other way.
Seen by: away from the target; driven against a stop, or beyond

--- a/motor.py
+++ b/motor.py
@@ -1,2 +1,2 @@
 def speed(way):
-    return way * 6
+    return 6
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    (tmp_path / "motor.py").write_text("# a motor\ndef speed(way):\n    return way * 6\n")
    return tmp_path


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
    take_back(bug, tree)
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


def test_a_patch_names_what_is_wrong_and_who_should_see_it() -> None:
    bug = parse("sign", PATCH)
    assert bug.wrong == "the sign is lost, so it turns the other way."
    assert bug.judges == ("away from the target", "driven against a stop, or beyond")
    assert bug.paths == ("motor.py",)


def test_a_patch_fits_at_any_place_of_its_lines(tree: Path) -> None:
    (tree / "motor.py").write_text("# new\n" * 40 + "def speed(way):\n    return way * 6\n")
    plant(parse("sign", PATCH), tree)
    assert (tree / "motor.py").read_text().endswith("def speed(way):\n    return 6\n")


@pytest.mark.parametrize(
    ("text", "why"),
    [("def speed(way):\n    return way * 5\n", "nowhere"), (2 * "def speed(way):\n    return way * 6\n", "2 times")],
)
def test_a_patch_that_does_not_fit_changes_nothing(tree: Path, text: str, why: str) -> None:
    (tree / "motor.py").write_text(text)
    with pytest.raises(Misfit, match=why):
        plant(parse("sign", PATCH), tree)
    assert (tree / "motor.py").read_text() == text
