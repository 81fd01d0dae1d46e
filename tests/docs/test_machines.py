"""The record of the five machines: each test, target and command that it names is there, and each item has one."""

from __future__ import annotations

import re
from pathlib import Path

from tests.tables import every_row

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "machines.md").read_text(encoding="utf-8")
ROWS = [line.split(" | ") for line in PAGE.splitlines() if line.count(" | ") == 2 and not line.startswith("asked")]
NAMED = re.compile(r"`([^`]+)`")


def test_every_item_says_what_shows_it() -> None:
    assert len(ROWS) > 90
    for asked, here, shown in ROWS:
        assert re.match(r"[DTW]\b", shown), asked
        assert here
        assert "T" not in re.findall(r"\b[DTW]\b", shown) or NAMED.search(shown) or "Panel" in shown, asked


@every_row("name", sorted(set(NAMED.findall(PAGE))))
def test_what_it_names_is_there(name: str) -> None:
    if name.startswith("tests/"):
        assert (ROOT / name).exists()
    elif name.startswith("test_"):
        [row] = [line for line in PAGE.splitlines() if f"`{name}`" in line]
        files = [ROOT / path for path in NAMED.findall(row) if path.endswith(".py")]
        assert any(f"def {name}(" in path.read_text(encoding="utf-8") for path in files)
    elif name.startswith("python -m "):
        assert (ROOT / (name.removeprefix("python -m ").replace(".", "/") + ".py")).exists()
    elif name.startswith("make "):
        assert f"\n{name.split()[1]}:" in (ROOT / "Makefile").read_text(encoding="utf-8")
