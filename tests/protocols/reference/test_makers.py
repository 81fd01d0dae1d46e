"""docs/protocols.md lists the commands of EasyComm, SPID and DCU-1 that the program knows, with its answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.protocols import dcu1, easycomm, spid
from rotator.protocols.reference.makers import dcu1_table, easycomm_table, spid_table

PAGE = Path(__file__).parents[3] / "docs" / "protocols.md"
TABLES = {"easycomm": easycomm_table(), "spid": spid_table(), "dcu1": dcu1_table()}


@pytest.mark.parametrize("name", TABLES)
def test_page_holds_the_table(name: str) -> None:
    """If this fails, paste what the function of that name in rotator.protocols.reference.makers returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split(f"<!-- {name}: begin -->\n")[1].split(f"<!-- {name}: end -->\n")[0]
    assert between == f"\n{TABLES[name]}\n"


def test_every_command_has_its_row() -> None:
    assert [row.split("`")[1] for row in easycomm_table().splitlines()[2:]] == [verb.text for verb in easycomm.VERBS]
    assert len(spid_table().splitlines()) == 2 + sum(len(row.models) for row in spid.ROWS)
    assert len(dcu1_table().splitlines()) == 2 + len(dcu1.VERBS)


@pytest.mark.parametrize(
    ("name", "row"),
    [
        ("easycomm", r"| `AZ` | I | Azimuth: go there; without a number: read it | `AZ` | `AZ235.0\n` |"),
        ("easycomm", r"| `VE` | II | Read the version | `VE` | `VEVERSION\n` |"),
        ("spid", "| `2F` | Go there | Rot1Prog | `57 35 39 35 30 00 00 00 00 00 00 2F 20` | nothing |"),
        (
            "spid",
            "| `1F` | Read the position | Rot2Prog | `57 00 00 00 00 00 00 00 00 00 00 1F 20` "
            "| `57 05 09 05 00 02 03 08 05 00 02 20` |",
        ),
        ("dcu1", "| `AI1` | Read azimuth | `AI1;` | `;235` |"),
    ],
)
def test_row(name: str, row: str) -> None:
    assert row in TABLES[name]
