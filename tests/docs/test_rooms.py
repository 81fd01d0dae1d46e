"""The picture of the rooms: it is what the imports make, each room is on it, and no box stands on another."""

from __future__ import annotations

import ast
import re
import shutil
from itertools import combinations
from pathlib import Path

import pytest

from docs.architecture import IMAGE, ROOT, figures
from docs.drawings.floors import GAP, plan
from docs.drawings.imports import circles, floors, room_arrows, sources, without_detours
from docs.drawings.rooms import CAPTIONS, rooms_svg

DIAMOND = {
    "a": frozenset({"b", "c", "d"}),
    "b": frozenset({"d"}),
    "c": frozenset({"d"}),
    "d": frozenset[str](),
    "alone": frozenset[str](),
}
CIRCLE = {"a": frozenset({"b"}), "b": frozenset({"c"}), "c": frozenset({"b"})}


def test_the_picture_in_the_documents_is_what_the_imports_make_and_every_room_says_what_it_is_for() -> None:
    """If this fails: make drawings."""
    arrows = room_arrows(ROOT)
    assert set(CAPTIONS) == set(arrows)
    assert IMAGE.read_text(encoding="utf-8") == rooms_svg(arrows)


@pytest.fixture
def small(tmp_path: Path) -> Path:
    """A source of four files."""
    for name in ("rotator/links", "rotator/views", "hw", "firmware_sim"):
        (tmp_path / name).mkdir(parents=True, exist_ok=True)
    (tmp_path / "rotator/__init__.py").write_text("")
    (tmp_path / "rotator/orders.py").write_text("import os\n")
    (tmp_path / "rotator/links/tcp.py").write_text("def f():\n    from rotator import orders, __version__\n")
    (tmp_path / "rotator/views/lcd.py").write_text("import hw.ports\nfrom rotator.links.tcp import f\n")
    (tmp_path / "hw/ports.py").write_text("")
    return tmp_path


def test_imports_as_they_are_written(small: Path) -> None:
    assert room_arrows(small) == {
        "hw.ports": frozenset(),
        "rotator.links": {"rotator.orders"},
        "rotator.orders": frozenset(),
        "rotator.views": {"hw.ports", "rotator.links"},
    }


def test_an_arrow_that_a_way_round_says_already_is_left_out() -> None:
    assert without_detours(DIAMOND) == {**DIAMOND, "a": {"b", "c"}}
    assert floors(DIAMOND) == [["d", "alone"], ["b", "c"], ["a"]]


def test_a_circle_is_found_and_not_drawn() -> None:
    assert circles(CIRCLE) == ["b", "c"]
    with pytest.raises(ValueError, match="in a circle: b, c"):
        plan(CIRCLE)


def test_boxes_of_a_floor_stand_apart_and_arrows_pass_between_them() -> None:
    drawn = plan(DIAMOND)
    assert [len(way) for way in drawn.ways] == [2, 2, 3, 2, 2]
    for level in drawn.levels:
        for one, other in combinations(level, 2):
            assert abs(one.x - other.x) >= (one.width + other.width) / 2 + GAP - 0.01


def test_the_figures_are_printed(small: Path) -> None:
    (small / "rotator/orders.py").write_text("class Order:\n    def __init__(self):\n        self.x = self.y = 1\n")
    shutil.copy(ROOT / "pyproject.toml", small)
    text = "\n".join(figures(small))
    for word in (
        "| rotator | 3 | 2 | 0 |",
        "the longest function: rotator/orders.py: __init__, 2 lines",
        "most attributes: Order (rotator/orders.py) 2",
        "import contracts: ",
    ):
        assert word in text


# --- the page


PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")


def members(classes: set[str]) -> set[str]:
    """Every `Class.method` and `Class.attribute` of these classes in the source."""
    found = set()
    texts = [path.read_text(encoding="utf-8") for path in sources(ROOT)]
    for text in [each for each in texts if not classes.isdisjoint(re.findall(r"class (\w+)", each))]:
        for each in ast.walk(ast.parse(text)):
            if isinstance(each, ast.ClassDef) and each.name in classes:
                for node in ast.walk(each):
                    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                        found.add(f"{each.name}.{node.name}")
                    elif isinstance(node, ast.Attribute):
                        found.add(f"{each.name}.{node.attr}")
    return found


def test_what_the_page_names_exists() -> None:
    """If this fails, something has moved: the page must say where to."""
    named = set(re.findall(r"`([A-Z]\w+\.\w+)`", PAGE))
    assert len(named) > 15
    assert named <= members({name.partition(".")[0] for name in named})
    files = set(re.findall(r"`([a-z_]+(?:/[a-z0-9_]+)*\.py)`", PAGE))
    assert len(files) > 8
    assert [name for name in files if not ((ROOT / name).exists() or (ROOT / "rotator" / name).exists())] == []


def test_the_page_names_every_thread_of_the_box() -> None:
    box = [path for path in sources(ROOT) if not path.is_relative_to(ROOT / "firmware_sim")]
    code = "\n".join(path.read_text(encoding="utf-8") for path in box)
    given = re.findall(r'Thread\([^\n]*name="([\w-]+)"', code) + re.findall(r'_THREAD = "([\w-]+)"', code)
    threads = set(given) - {"arduino"}
    assert {"control", "sensors", "guard", "display"} <= threads
    assert threads <= set(re.findall(r"`([\w-]+)`", PAGE))
