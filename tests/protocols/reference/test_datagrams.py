"""docs/reference/wire.md lists PstRotator's tags that the program knows, with its answers."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.protocols import pstrotator
from rotator.protocols.reference.datagrams import pstrotator_table, pstrotatoraz_table

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "wire.md"


def test_page_holds_the_table() -> None:
    """If this fails, paste what pstrotator_table() of rotator.protocols.reference.datagrams returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split("<!-- pstrotator: begin -->\n")[1].split("<!-- pstrotator: end -->\n")[0]
    assert between == f"\n{pstrotator_table()}\n"


def test_page_holds_the_requests() -> None:
    """If this fails, paste what pstrotatoraz_table() of rotator.protocols.reference.datagrams returns."""
    page = PAGE.read_text(encoding="utf-8")
    between = page.split("<!-- pstrotatoraz: begin -->\n")[1].split("<!-- pstrotatoraz: end -->\n")[0]
    assert between == f"\n{pstrotatoraz_table()}\n"
    assert "`GET /PstRotatorAz.htm` | Read azimuth; `/` too | `Bearing = 235 deg`\n" in pstrotatoraz_table()


def test_every_tag_has_its_row() -> None:
    examples = [row.split("`")[1].removeprefix("<PST>") for row in pstrotator_table().splitlines()[2:]]
    assert [example.lstrip("<").replace(">", "<").split("<")[0] for example in examples] == [
        tag.text for tag in pstrotator.TAGS
    ]


@pytest.mark.parametrize(
    "row",
    [
        r"`<PST>AZ?</PST>` | Read azimuth | `AZ:235.0\r`",
        "`<PST><PARK>1</PARK></PST>` | 1: go to the park position\n",
    ],
)
def test_row(row: str) -> None:
    assert row in pstrotator_table()
