"""The picture of the rooms: it is what the imports make, each room is on it, and no box stands on another."""

from __future__ import annotations

import ast
import re

from docs.architecture import IMAGE, ROOT
from docs.drawings.imports import room_arrows, sources
from docs.drawings.rooms import CAPTIONS, rooms_svg


def test_the_picture_in_the_documents_is_what_the_imports_make_and_every_room_says_what_it_is_for() -> None:
    """If this fails: make drawings."""
    arrows = room_arrows(ROOT)
    assert set(CAPTIONS) == set(arrows)
    assert IMAGE.read_text(encoding="utf-8") == rooms_svg(arrows)


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
