"""docs/reference/wire.md lists the commands of EasyComm, SPID, DCU-1, Prosistel and M2 that the program knows."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.protocols import dcu1, easycomm, prosistel, rc2800, spid
from rotator.protocols.reference.makers import dcu1_table, easycomm_table, prosistel_table, rc2800_table, spid_table

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "wire.md"
TABLES = {"easycomm": easycomm_table(), "spid": spid_table(), "dcu1": dcu1_table()}
TABLES |= {"prosistel": prosistel_table(), "rc2800": rc2800_table()}


@pytest.mark.parametrize("name", TABLES)
def test_page_holds_the_table(name: str) -> None:
    """If this fails, paste what the function of that name in rotator.protocols.reference.makers returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split(f"<!-- {name}: begin -->\n")[1].split(f"<!-- {name}: end -->\n")[0]
    assert between == f"\n{TABLES[name]}\n"


def commands(row: str) -> str:
    """The command of an example: its letters."""
    return row.split("`")[1].rstrip("0123456789")


def test_every_command_has_its_row() -> None:
    assert [commands(row) for row in easycomm_table().splitlines()[2:]] == [verb.text for verb in easycomm.VERBS]
    assert [row.split("`")[1].rstrip("235;") for row in dcu1_table().splitlines()[2:]] == [
        verb.text for verb in dcu1.VERBS
    ]
    assert len(rc2800_table().splitlines()) == 2 + len(rc2800.VERBS)
    assert len(prosistel_table().splitlines()) == 2 + len(prosistel.VERBS)
    cells = [row.split(" | ") for row in spid_table().splitlines()[2:]]
    shown = sorted((row[0].strip("`"), model) for row in cells for model in row[2].split(", "))
    assert shown == sorted((f"{row.command:02X}", model.value) for row in spid.ROWS for model in row.models)


@pytest.mark.parametrize(
    ("name", "row"),
    [
        ("easycomm", r"`AZ` | I | Azimuth: go there; without number: read | `AZ235.0\n`"),
        ("easycomm", r"`VE` | II | Read the version | `VEVERSION\n`"),
        ("spid", "`2F` | Go there | Rot1Prog | `57 35393530 00 00000000 00 2F 20`\n"),
        (
            "spid",
            "`1F` | Read the position | Rot2Prog | `57 00000000 00 00000000 00 1F 20` "
            "| `57 05090500 02 03080500 02 20`\n",
        ),
        (
            "spid",
            "`0F` | Stop everything | Rot1Prog, Rot2Prog, MD-01 | `57 00000000 00 00000000 00 0F 20` | as `1F`\n",
        ),
        ("dcu1", "`AI1;` | Read azimuth | `;235`\n"),
        ("rc2800", r"`A235.0` | Azimuth: go there | `A P= 235.0 S=9 S\r`"),
        (
            "prosistel",
            r"`\x02AG235\r` | `\x02AG2350\r` | Go there "
            r"| `\x02A,G,R\r` | `\x02A,G,R\r`",
        ),
    ],
)
def test_row(name: str, row: str) -> None:
    assert row in TABLES[name]
