"""The box in a terminal: what a person must find in the picture, and plain lines that change only with the box."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from io import StringIO
from typing import Any

import pytest
from rich.console import Console, RenderableType
from rich.text import Text

from hw.ports import Axis, Direction
from rotator.faults import Fault, FaultKind, Missing, Notice
from rotator.links.wire import Wire
from rotator.status import AxisStatus, Status
from rotator.views import frame, terminal

WIDTH = 100
GLASS = ("SAT A:235 E:025 ", "SIM A:231 E:024 ")
STATUS = Status(
    at_s=10.0,
    azimuth=AxisStatus(0, 450, angle_deg=231.26, raw=0.5125, target_deg=235.0, drive=Direction.PLUS, moving=True),
    elevation=AxisStatus(0, 180, angle_deg=24.04, raw=0.17),
    wanted_azimuth_deg=235,
    wanted_elevation_deg=25,
    simulated=True,
    controlled_by="gs232b#1",
)
FAULT = Fault(FaultKind.STANDS_STILL, Axis.ELEVATION, "0.1°/s", "1.0°/s")


@pytest.fixture
def wires() -> list[Wire]:
    return [
        Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3", b"W235 025\r", b""),
        Wire("rotctld", "rotctld", "127.0.0.1:4533", "2 clients", b"p\n", b"231.26\n24.04\n"),
    ]


def text(what: RenderableType) -> str:
    console = Console(file=StringIO(), record=True, width=WIDTH)
    console.print(what)
    return console.export_text()


def show(status: Status = STATUS, wires: Sequence[Wire] = (), log: Sequence[str] = ()) -> str:
    return text(terminal.picture("0.1.0", status, GLASS, wires, log))


def words(picture: str) -> str:
    """The text without its frames, wherever a line was broken."""
    return " ".join(picture.translate(dict.fromkeys(map(ord, "│┃"), " ")).split())


def axis_row(picture: str, axis: Axis) -> str:
    return next(row for row in picture.splitlines() if axis.value in row)


# --- the picture


def test_the_display_as_it_looks() -> None:
    upper, lower = (row for row in show().splitlines() if "A:" in row)
    assert GLASS[0] in upper
    assert GLASS[1] in lower


def test_both_axes() -> None:
    azimuth = axis_row(show(), Axis.AZIMUTH)
    for word in ("231.3°", "235.0°", "0…450°", "0.5125 measured"):
        assert word in azimuth
    elevation = axis_row(show(), Axis.ELEVATION)
    for word in ("24.0°", "---", "0…180°", "0.1700 measured"):
        assert word in elevation


@pytest.mark.parametrize(
    ("axis", "drive", "lit"),
    [
        (Axis.AZIMUTH, Direction.PLUS, "● CW"),
        (Axis.AZIMUTH, Direction.MINUS, "● CCW"),
        (Axis.ELEVATION, Direction.PLUS, "● UP"),
        (Axis.ELEVATION, Direction.MINUS, "● DOWN"),
    ],
)
def test_the_relay_that_is_on_is_lit(axis: Axis, drive: Direction, lit: str) -> None:
    still = replace(STATUS, azimuth=replace(STATUS.azimuth, drive=Direction.OFF))
    assert "●" not in show(still)
    changed: Any = {axis.value: replace(still.axis(axis), drive=drive)}
    picture = show(replace(still, **changed))
    assert picture.count("●") == 1
    assert lit + " " in picture
    assert picture.count("○") == 3


def test_the_bar_shows_the_antenna_and_its_target_on_the_range() -> None:
    there = replace(STATUS.azimuth, angle_deg=0.0, target_deg=450.0)
    bar = axis_row(show(replace(STATUS, azimuth=there)), Axis.AZIMUTH)
    assert re.search("█─{8,}│", bar)


@pytest.mark.parametrize(("angle_deg", "shown"), [(-3.0, "█─{8,}"), (453.0, "─{8,}█")])
def test_beyond_an_end_the_antenna_stands_at_the_end(angle_deg: float, shown: str) -> None:
    azimuth = replace(STATUS.azimuth, angle_deg=angle_deg, target_deg=None)
    assert re.search(rf"---\s+{shown}\s", axis_row(show(replace(STATUS, azimuth=azimuth)), Axis.AZIMUTH))


def test_links_with_the_last_bytes_each_way(wires: list[Wire]) -> None:
    picture = show(wires=wires)
    for word in ("gs232b ", "run/gs232", "open as", r"W235 025\r"):
        assert word in picture
    for word in ("rotctld", "127.0.0.1:4533", "2 clients", r"p\n", r"231.26\n24.04\n"):
        assert word in picture


def test_where_to_connect_stays_readable_while_links_are_busy(wires: list[Wire]) -> None:
    for wire in wires:
        wire.last_in, wire.last_out = b"C2\r" * 21, b"AZ=231  EL=024\r\n" * 4
    picture = show(wires=wires)
    for wire in wires:
        assert f"{wire.name} " in picture
        assert f"{wire.where} " in picture
    assert picture.count(r"C2\r ") == 2, "the latest bytes end the column"
    assert picture.count(r"EL=024\r\n ") == 2


def test_bytes_that_are_no_text_are_escaped(wires: list[Wire]) -> None:
    wires[0].last_in = b"\x00\x1b[2J\xff"
    picture = show(wires=wires)
    assert r"\x00\x1b[2J\xff" in picture
    assert "\x1b" not in picture


def test_who_gives_the_orders() -> None:
    assert "under gs232b#1" in show()
    assert "under nobody's orders" in show(replace(STATUS, controlled_by=""))
    assert "point 3 of 12" in show(replace(STATUS, timed_point=3, timed_points=12))


def test_simulated_is_said_in_the_title() -> None:
    assert "SIMULATED" in show().splitlines()[0]
    assert "SIMULATED" not in show(replace(STATUS, simulated=False))


def test_a_fault_says_everything() -> None:
    picture = words(show(replace(STATUS, elevation=replace(STATUS.elevation, fault=FAULT))))
    assert str(FAULT) in picture


def test_a_latched_stop_says_who_and_how_on() -> None:
    assert "held by console: nothing moves until resume" in show(replace(STATUS, latched="console"))


@pytest.mark.parametrize(
    "missing",
    [
        (Missing.CALIBRATION,),
        (Missing.LIMITS,),
        (Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK),
    ],
)
def test_uncalibrated_says_so_and_what_is_missing_first(missing: tuple[Missing, ...]) -> None:
    picture = words(show(replace(STATUS, azimuth=replace(STATUS.azimuth, missing=missing))))
    assert f"UNCALIBRATED: {missing[0].text}" in picture


def test_log_and_keys() -> None:
    picture = show(log=["12:00:00 W gs232b: refused"])
    assert "12:00:00 W gs232b: refused" in picture
    for key in ("space STOP", "q quit", "park, resume: type the word and Enter"):
        assert key in picture


def test_it_fits_its_width(wires: list[Wire]) -> None:
    wires[1].where = "a-very-long-host-name.of-somebody.example.org:4533"
    rows = show(wires=wires, log=["long " * 50]).splitlines()
    assert {len(row.rstrip()) for row in rows if row.strip()} == {frame.WIDTH}


@pytest.mark.parametrize(("columns", "rows"), [(80, 24), (100, 30), (60, 20), (40, 12), (80, 10)])
@pytest.mark.parametrize("trouble", [False, True])
def test_on_a_small_terminal_its_frame_is_whole_and_what_matters_stays(
    wires: list[Wire], columns: int, rows: int, trouble: bool
) -> None:
    for wire in wires:
        wire.last_in, wire.last_out = b"C2\r" * 21, b"AZ=231  EL=024\r\n" * 4
    now = STATUS
    if trouble:
        hot = (Notice("motor hot: 30 min"),)
        elevation = replace(STATUS.elevation, fault=FAULT, missing=(Missing.LIMITS,), notices=hot)
        now = replace(STATUS, latched="panel", elevation=elevation)
    screen = Console(file=StringIO(), width=columns, height=rows, force_terminal=True, legacy_windows=False)
    log = [f"12:00:0{second} W gs232b: refused {'long ' * 20}" for second in range(6)]
    lines = screen.render_lines(terminal.picture("0.1.0", now, GLASS, wires, log), pad=False)
    seen = ["".join(segment.text for segment in line) for line in lines]
    assert len(seen) <= rows
    assert {len(line) for line in seen} == {min(columns, frame.WIDTH)}
    assert [line[0] + line[-1] for line in seen] == ["╭╮", *["││"] * (len(seen) - 2), "╰╯"]
    whole = words("\n".join(seen))
    assert "space STOP q quit park, resume: type the word and Enter" in whole
    for word in ("held by panel", "elevation: motor runs and pot stands", "azimuth 231.3°", *GLASS):
        assert word in whole or (not trouble and word.startswith(("held", "elevation:")))
    if columns >= 60 and rows >= 20:
        for axis in Axis:
            assert re.search(rf"{axis.value} .*°.*0…\d+°.*\d\.\d{{4}} measured", "\n".join(seen))
        for word in ("gs232b ", "run/gs232 ", "127.0.0.1:4533 ", *GLASS):
            assert word in "\n".join(seen)
        assert trouble or any("12:00:05" in line for line in seen), "the newest log line"


def test_a_table_takes_what_room_there_is() -> None:
    cells = [Text("0123456789")]
    columns = [
        frame.Column("a", cells),
        frame.Column("b", cells, least=4, rank=1, end=True),
        frame.Column("c", cells, least=4),
    ]

    def last(width: int) -> str:
        return frame.table(columns, width, rank=0, head_rank=0, rule_rank=0)[-1].text.plain

    assert last(36) == "0123456789   0123456789   0123456789"
    assert last(35) == "0123456789  0123456789  0123456789"
    assert last(30) == "0123456789  …56789  0123456789"
    assert last(27) == "0123456789   0123456789", "the one that matters least is left out"
    assert last(20) == "0123456789  0123456…"


def test_the_arduino(wires: list[Wire]) -> None:
    picture = text(terminal.sketch_picture(GLASS, (-1, 1), wires[:1]))
    for word in (*GLASS, "● CCW", "● UP", "○ CW", "○ DOWN", "F1EFW sketch", "SIMULATED", "q quit"):
        assert word in picture


# --- plain lines


def test_greeting(wires: list[Wire]) -> None:
    assert terminal.greeting("0.1.0", "sim", wires) == [
        "rotator 0.1.0: a SIMULATED rotor",
        "  gs232b      run/gs232  (open as /dev/pts/3)",
        "  rotctld     127.0.0.1:4533  (2 clients)",
    ]
    assert terminal.greeting("0.1.0", "pi", []) == ["rotator 0.1.0: the rotor on this Pi"]


def test_line() -> None:
    assert terminal.line(STATUS) == "azimuth 231° to 235.0° CW  elevation 24°"


def test_the_line_stays_while_only_noise_changes() -> None:
    moments = [
        replace(STATUS, at_s=at_s, azimuth=replace(STATUS.azimuth, angle_deg=231.26 + noise, raw=0.5 + noise))
        for at_s, noise in [(1.0, 0.0), (2.0, 0.1), (3.0, -0.1)]
    ]
    assert len({terminal.line(moment) for moment in moments}) == 1


def test_a_pot_that_reads_just_below_zero_is_at_zero() -> None:
    assert "azimuth 0°" in terminal.line(replace(STATUS, azimuth=replace(STATUS.azimuth, angle_deg=-0.04)))


def test_trouble_in_a_line() -> None:
    now = replace(STATUS, latched="console", elevation=AxisStatus(0, 180, fault=FAULT, missing=(Missing.LIMITS,)))
    line = terminal.line(now)
    assert "elevation --- UNCALIBRATED (limits; reads None)" in line
    assert "STOPPED by console" in line
    assert line.endswith(f"FAULT {FAULT}")


def test_orders_without_effect_are_shown_with_the_reason() -> None:
    ignored = "orders from rotctld#1 are ignored: gs232b#1 has stopped the antenna; they count again after 10 s"
    now = replace(STATUS, notices=(ignored,))
    assert ignored in words(show(now))
    assert ignored not in terminal.line(now), "the plain lines stand among those of the log, which has it"
