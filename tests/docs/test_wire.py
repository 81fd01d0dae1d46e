"""The tables of docs/reference/wire.md: a row for each command that the program knows, with its answer."""

from __future__ import annotations

from docs.generate import PARTS
from rotator.protocols import dcu1, easycomm, gs232, lx200, prosistel, pstrotator, rc2800, rotctld, spid
from tests.tables import every_row

TABLES = {name: make() for name, make in PARTS["reference/wire.md"].items()}


def examples(name: str) -> list[str]:
    """The first cell of each row, without its marks."""
    return [row.split("`")[1] for row in TABLES[name].splitlines()[2:]]


def test_every_command_has_its_row() -> None:
    assert examples("gs232") == [verb.text for verb in gs232.VERBS]
    assert [verb.name for verb in rotctld.VERBS if f"\\{verb.name}" not in TABLES["rotctld"]] == []
    assert [each.rstrip("0123456789") for each in examples("easycomm")] == [verb.text for verb in easycomm.VERBS]
    assert [each.rstrip("235;") for each in examples("dcu1")] == [verb.text for verb in dcu1.VERBS]
    assert len(examples("rc2800")) == len(rc2800.VERBS)
    assert len(examples("prosistel")) == len(prosistel.VERBS)
    assert [each.encode() for each in examples("lx200")] == [lx200.encode(verb) for verb in lx200.VERBS]
    tags = [each.removeprefix("<PST>").lstrip("<").replace(">", "<").split("<")[0] for each in examples("pstrotator")]
    assert tags == [tag.text for tag in pstrotator.TAGS]
    cells = [row.split(" | ") for row in TABLES["spid"].splitlines()[2:]]
    shown = sorted((row[0].strip("`"), model) for row in cells for model in row[2].split(", "))
    assert shown == sorted((f"{row.command:02X}", model.value) for row in spid.ROWS for model in row.models)


@every_row(
    ("name", "row"),
    [
        ("gs232", r"`C2` | Read azimuth and elevation | A: `+0235+0025\r\n`, B: `AZ=235  EL=025\r\n`"),
        ("gs232", r"`P45` | Azimuth 0 to 450 degrees | A: `?>\r\n`, B: `Mode 450 degree\r\n`"),
        ("gs232", r"`N` | Read point number and number of points | `+0001+0003\r\n`"),
        ("gs232", "`M` | Maaa: go to azimuth; Msss aaa aaa ...: timed list\n"),
        ("rotctld", r"`p` | `\get_pos` | Read azimuth, then elevation | `235.00\n25.00\n`"),
        ("rotctld", r"`P 235 25` | `\set_pos` | Go there: azimuth, elevation | `RPRT 0\n`"),
        ("rotctld", r"`\get_conf max_az` | `\get_conf` | Read one value of `3`; `?`: all | `max_az=450.000000\n`"),
        ("rotctld", r"`Q` | `\quit` | Close the connection | the connection ends"),
        ("easycomm", r"`AZ` | I | Azimuth: go there; without number: read | `AZ235.0\n`"),
        ("easycomm", r"`VE` | II | Read the version | `VEVERSION\n`"),
        ("spid", "`2F` | Go there | Rot1Prog | `57 35393530 00 00000000 00 2F 20`\n"),
        ("spid", "| Rot2Prog | `57 00000000 00 00000000 00 1F 20` | `57 05090500 02 03080500 02 20`\n"),
        ("spid", "| Rot1Prog, Rot2Prog, MD-01 | `57 00000000 00 00000000 00 0F 20` | as `1F`\n"),
        ("dcu1", "`AI1;` | Read azimuth | `;235`\n"),
        ("rc2800", r"`A235.0` | Azimuth: go there | `A P= 235.0 S=9 S\r`"),
        ("prosistel", r"`\x02AG235\r` | `\x02AG2350\r` | Go there | `\x02A,G,R\r` | `\x02A,G,R\r`"),
        ("pstrotator", r"`<PST>AZ?</PST>` | Read azimuth | `AZ:235.0\r`"),
        ("pstrotator", "`<PST><PARK>1</PARK></PST>` | 1: go to the park position\n"),
        ("pstrotatoraz", "`GET /PstRotatorAz.htm` | Read azimuth; `/` too | `Bearing = 235 deg`\n"),
        ("lx200", r"`:GZ#` | Read azimuth | `235\xdf00#`"),
        ("lx200", "`:MS#` | Go to the target and follow the sky | `0`\n"),
        ("lx200", "`:MA#` | Go to azimuth and elevation | `0`\n"),
    ],
)
def test_row(name: str, row: str) -> None:
    assert row in TABLES[name]
