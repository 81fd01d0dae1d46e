"""docs/reference/wire.md lists the commands of telescope programs that the program knows, with its answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.protocols import lx200
from rotator.protocols.reference.telescopes import lx200_table, stellarium_table

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "wire.md"
TABLES = {"lx200": lx200_table(), "stellarium": stellarium_table()}


@pytest.mark.parametrize("name", TABLES)
def test_page_holds_the_table(name: str) -> None:
    """If this fails, paste what the function of that name in rotator.protocols.reference.telescopes returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split(f"<!-- {name}: begin -->\n")[1].split(f"<!-- {name}: end -->\n")[0]
    assert between == f"\n{TABLES[name]}\n"


def test_every_command_has_its_row() -> None:
    examples = [row.split("`")[1].encode() for row in lx200_table().splitlines()[2:]]
    assert examples == [lx200.encode(verb) for verb in lx200.VERBS]


@pytest.mark.parametrize(
    "row",
    [
        "`:GZ#` | Read azimuth | `235\\xdf00#`\n",
        "`:MS#` | Go to the target and follow the sky | `0`\n",
        "`:MA#` | Go to azimuth and elevation | `0`\n",
    ],
)
def test_row(row: str) -> None:
    assert row in lx200_table()
