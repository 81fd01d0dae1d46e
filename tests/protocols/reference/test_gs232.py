"""docs/reference/wire.md lists the commands that the program knows, with the answers that it gives."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.protocols import gs232, rotctld
from rotator.protocols.reference.gs232 import gs232_table, rotctld_table

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "wire.md"


@pytest.mark.parametrize(("name", "table"), [("gs232", gs232_table()), ("rotctld", rotctld_table())])
def test_page_holds_the_table(name: str, table: str) -> None:
    """If this fails, paste what gs232_table() or rotctld_table() of rotator.protocols.reference.gs232 returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split(f"<!-- {name}: begin -->\n")[1].split(f"<!-- {name}: end -->\n")[0]
    assert between == f"\n{table}\n"


def test_every_command_has_its_row() -> None:
    assert [row.split("`")[1] for row in gs232_table().splitlines()[2:]] == [verb.text for verb in gs232.VERBS]
    assert [verb.name for verb in rotctld.VERBS if f"\\{verb.name}" not in rotctld_table()] == []


@pytest.mark.parametrize(
    "row",
    [
        r"`C2` | Read azimuth and elevation | A: `+0235+0025\r\n`, B: `AZ=235  EL=025\r\n`",
        r"`P45` | Azimuth 0 to 450 degrees | A: `?>\r\n`, B: `Mode 450 degree\r\n`",
        r"`N` | Read point number and number of points | `+0001+0003\r\n`",
        "`M` | Maaa: go to azimuth; Msss aaa aaa ...: timed list\n",
    ],
)
def test_gs232_row(row: str) -> None:
    assert row in gs232_table()


@pytest.mark.parametrize(
    "row",
    [
        r"`p` | `\get_pos` | Read azimuth, then elevation | `235.00\n25.00\n`",
        r"`P 235 25` | `\set_pos` | Go there: azimuth, elevation | `RPRT 0\n`",
        r"`\get_conf max_az` | `\get_conf` | Read one value of `3`; `?`: all | `max_az=450.000000\n`",
        r"`Q` | `\quit` | Close the connection | the connection ends",
    ],
)
def test_rotctld_row(row: str) -> None:
    assert row in rotctld_table()
