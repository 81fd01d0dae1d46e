"""The GS-232A and B command sets as the manual lists them, read and written; and the answers, to the byte.

The lenient spellings are those of programs in the field: Hamlib and OscarWatch pad, FODTrack and people at a terminal
do not, Look4Sat's template gives decimals, a European Windows writes them with a comma.
"""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.protocols import gs232
from rotator.protocols.gs232 import VERBS, Command, Dialect, NoOrder, NotACommand, encode, parse
from tests.search import examples
from tests.tables import every_row

A_COMMANDS = [*"RLACMTN", "X1", "X2", "X3", "X4", *"SOFH", *"UDEB", "C2", "W", "O2", "F2", "H2"]
B_COMMANDS = ["P45", "P36", "Z", "H3"]
"""Only the GS-232B has these."""

CANONICAL = [
    *((f"{text}\r".encode(), Command(text)) for text in A_COMMANDS + B_COMMANDS if text not in ("M", "W")),
    (b"M000\r", Command("M", 0)),
    (b"M235\r", Command("M", 235)),
    (b"M450\r", Command("M", 450)),
    (b"M005 010 450\r", Command("M", interval_s=5, points=((10, None), (450, None)))),
    (b"M999 000 000\r", Command("M", interval_s=999, points=((0, None), (0, None)))),
    (b"W235 025\r", Command("W", 235, 25)),
    (b"W000 000\r", Command("W", 0, 0)),
    (b"W450 180\r", Command("W", 450, 180)),
    (b"W001 010 020\r", Command("W", interval_s=1, points=((10, 20),))),
    (b"W010 010 020 030 040\r", Command("W", interval_s=10, points=((10, 20), (30, 40)))),
]

W_235_25 = [
    b"W235 025",
    b"w235 025",
    b"W235 25",
    b"W 235 025",
    b"W235  025",
    b"W235\t025",
    b"  W235 025",
    b"\tW235 025",
    b"W235 025 \t ",
    b"W235025",
    b"W235,025",
    b"W235, 25",
    b"W235 ,25",
    b"W235.0 25.0",
    b"W235.00 25.00",
    b"W235,0 25,00",
    b"W235.0,25.0",
    b"W235.000000 25.000000",
    b"\0W235 025",
    b"\xff\xfe\x80W235 025",  # a port being plugged in
    b"\x1b\x13 \x7fW235 025",
    b"W235 025;",  # GS232-Remote
    b"W235 025 ; ",
    b"W235 025\0\0",
    b"W235025;",
    b"W2.35e+02 2.5e1",  # a C# program
    b"W235. 25.",
    b"W0235 0025",
    b"W235.00000000000000001 25.0000000000000000001",
    b"W235.0, 25.0",
]

OTHER_SPELLINGS = [
    (b"W5 7", Command("W", 5, 7)),
    (b"W005 007", Command("W", 5, 7)),
    (b"W114.8 9.05", Command("W", 114.8, 9.05)),  # Look4Sat
    (b"W235.5 25.0", Command("W", 235.5, 25)),  # eleven characters and yet no timed list
    (b"W114,8 9,05", Command("W", 114.8, 9.05)),
    (b"W12,5 25", Command("W", 12.5, 25)),
    (b"W235,25", Command("W", 235, 25)),  # where no blank separates them the comma does
    (b"m7", Command("M", 7)),
    (b"M 235", Command("M", 235)),
    (b"M114.8", Command("M", 114.8)),
    (b"M114,8", Command("M", 114.8)),
    (b"m005 10  20", Command("M", interval_s=5, points=((10, None), (20, None)))),
    (b"w1 2 3", Command("W", interval_s=1, points=((2, 3),))),
    (b" c2 ", Command("C2")),
    (b"\xffs", Command("S")),
    (b"M100;", Command("M", 100)),
    (b"C;", Command("C")),
    (b"c2\0", Command("C2")),
    (b"P45;", Command("P45")),
    (b"M005 010 020;", Command("M", interval_s=5, points=((10, None), (20, None)))),
]

NOTHING = [b"", b" ", b";", b" ;;\0", b"\t \t", b"\0", b"\0\0\0", b"\xff\xfe", b"\x1b\x07"]

NO_ORDER = [
    b"M",
    b"m;",
    b"W",
    b"W ",
    b"W1x0 020",
    b"W235",
    b"W235 -25",
    b"W-10 025",
    b"W+235 025",
    b"W23525",
    b"W2350255",
    b"W235 025x",
    b"W235 025\x1a",
    b"W235 025W240 030",
    b"W1e1 10",
    b"Wnan nan",
    b"W235,5,25,5",
    b"W235,5 25.5 1",
    b"W000 010 020",  # an interval is 001 to 999 seconds
    b"W010 010 020 030",  # an azimuth without its elevation
    b"W010 010.5 020.5 030.5 040.5",
    b"M000 010 020",
    b"M-10",
    b"M235 025",  # a list of one azimuth: the manual wants two, and 25 is likely to be an elevation
    b"M23;",  # the last digit may be what became a semicolon
    b"W235 02;",
    b"W235 02\0",
    b"W235 2.5;",
]
"""They begin with M or W and are no order: they clear the timed list."""
NO_COMMAND = [
    b"Z" * 86,
    b"XW235 025",
    b"X",
    b"X0",
    b"X5",
    b"C3",
    b"CC",
    b"C 2",
    b"S1",
    b"S2;",
    b"TS",
    b"P",
    b"P40",
    b"H4",
    b"AZ235.0 EL25.0",
    b"P 235 25",
    b"\xb5235",
    b"?",
    b">",
]


def test_the_manuals_commands_are_all_here_and_no_others() -> None:
    assert sorted(verb.text for verb in VERBS) == sorted(A_COMMANDS + B_COMMANDS)
    assert [verb.text for verb in VERBS if verb.only_b] == B_COMMANDS


@every_row(("line", "command"), CANONICAL)
def test_reads_what_it_writes_and_writes_what_it_reads(line: bytes, command: Command) -> None:
    assert parse(line[:-1], Dialect.B) == command
    assert encode(command) == line
    assert parse(line[:-1].lower(), Dialect.B) == command


@every_row(("line", "command"), CANONICAL)
def test_a_gs232a_knows_all_but_four(line: bytes, command: Command) -> None:
    if command.verb in B_COMMANDS:
        with pytest.raises(NotACommand):
            parse(line[:-1], Dialect.A)
    else:
        assert parse(line[:-1], Dialect.A) == command


@every_row("line", W_235_25)
@every_row("dialect", Dialect)
def test_every_spelling_of_one_order(line: bytes, dialect: Dialect) -> None:
    assert parse(line, dialect) == Command("W", 235, 25)


@every_row(("line", "command"), OTHER_SPELLINGS)
def test_other_spellings(line: bytes, command: Command) -> None:
    assert parse(line, Dialect.B) == command


@every_row("line", NOTHING)
def test_a_line_with_nothing_in_it_is_no_command_and_no_mistake(line: bytes) -> None:
    assert parse(line, Dialect.B) is None


@every_row("line", NO_COMMAND)
def test_what_is_no_command(line: bytes) -> None:
    with pytest.raises(NotACommand) as mistake:
        parse(line, Dialect.B)
    assert mistake.type is NotACommand


@every_row("line", NO_ORDER)
def test_an_m_or_w_that_is_no_order(line: bytes) -> None:
    with pytest.raises(NoOrder):
        parse(line, Dialect.B)


@every_row("at", range(1, 8))
def test_a_damaged_byte_never_makes_another_order(at: int) -> None:
    """But for a digit that turns into a blank, a point or a comma: that is how others write other angles."""
    for damage in set(range(256)) - set(b"0123456789 \t.,"):
        line = bytearray(b"W123 045")
        line[at] = damage
        with pytest.raises(NotACommand):
            parse(bytes(line), Dialect.B)


@pytest.mark.parametrize(("letter", "most", "step"), [("M", 3800, " 007"), ("W", 1900, " 007 008")])
def test_the_longest_lists(letter: str, most: int, step: str) -> None:
    """The manual's memory: 3800 azimuths, or 1900 pairs."""
    line = (letter + "005" + step * most).encode()
    assert len(line) <= gs232.MAX_LINE
    command = parse(line, Dialect.A)
    assert command is not None
    assert len(command.points) == most
    assert encode(command) == line + b"\r"
    with pytest.raises(NotACommand):
        parse(line + step.encode(), Dialect.A)


@settings(max_examples=examples(200), deadline=None)
@given(st.integers(1, 999), st.lists(st.tuples(st.integers(0, 450), st.integers(0, 180)), max_size=20))
def test_any_order_in_whole_degrees_survives_the_wire(interval_s: int, points: list[tuple[int, int]]) -> None:
    commands = [Command("W", azimuth, elevation) for azimuth, elevation in points]
    if points:
        commands.append(Command("W", interval_s=interval_s, points=tuple(points)))
        azimuths = [azimuth for azimuth, _ in (*points, points[0])]
        commands.append(Command("M", interval_s=interval_s, points=tuple((azimuth, None) for azimuth in azimuths)))
    for command in commands:
        assert parse(encode(command).removesuffix(b"\r"), Dialect.A) == command


@every_row(
    ("azimuth_deg", "elevation_deg", "a", "b"),
    [
        (235, 25, b"+0235+0025\r\n", b"AZ=235  EL=025\r\n"),
        (0, 0, b"+0000+0000\r\n", b"AZ=000  EL=000\r\n"),
        (450, 180, b"+0450+0180\r\n", b"AZ=450  EL=180\r\n"),
        (234.5, 24.5, b"+0235+0025\r\n", b"AZ=235  EL=025\r\n"),  # half up: 24 would be the even one
        (235.5, 25.49, b"+0236+0025\r\n", b"AZ=236  EL=025\r\n"),
        (235.99, 25.99, b"+0236+0026\r\n", b"AZ=236  EL=026\r\n"),  # rounded, never cut off
        (-0.4, -3, b"+0000+0000\r\n", b"AZ=000  EL=000\r\n"),
    ],
)
def test_position_replies(azimuth_deg: float, elevation_deg: float, a: bytes, b: bytes) -> None:
    assert gs232.position_reply(Dialect.A, azimuth_deg, elevation_deg) == a
    assert gs232.position_reply(Dialect.B, azimuth_deg, elevation_deg) == b
    assert gs232.azimuth_reply(Dialect.A, azimuth_deg) == a[:5] + b"\r\n"
    assert gs232.elevation_reply(Dialect.A, elevation_deg) == a[5:]
    assert gs232.azimuth_reply(Dialect.B, azimuth_deg) == b[:6] + b"\r\n"
    assert gs232.elevation_reply(Dialect.B, elevation_deg) == b[8:]


MANUAL_LISTS = {
    (Dialect.A, 1): [*"RLACMTN", "X1", "X2", "X3", "X4", *"SOF"],
    (Dialect.B, 1): [*"RLACMTNSOF", "X1", "X2", "X3", "X4"],
    (Dialect.A, 2): [*"UDE", "C2", *"WTNS", "O2", "F2", "B"],
    (Dialect.B, 2): [*"UDE", "C2", *"WTNS", "O2", "F2", "B"],
    (Dialect.B, 3): ["P45", "P36", "Z"],
}
"""Pages 19 (A), 19 and 20 (B)."""
TITLES = {1: "COMMAND LIST 1", 2: "HELP COMMAND 2", 3: "HELP COMMAND 3"}


@every_row(("which", "commands"), MANUAL_LISTS.items())
def test_the_help_lists_have_the_manuals_titles_commands_and_order(
    which: tuple[Dialect, int], commands: list[str]
) -> None:
    dialect, number = which
    screen = gs232.help_reply(number, dialect, 450, north=False)
    title, *rows = screen.decode().split("\r\n")
    assert title == f"---------- {TITLES[number]} ----------"
    assert rows[-1] == ""
    assert screen.count(b"\n") == screen.count(b"\r") == len(rows)
    assert [row.split()[0] for row in rows[: len(commands)]] == commands
    if number < 3:
        assert len(rows) == len(commands) + 1
