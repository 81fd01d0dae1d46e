"""The box in a terminal: what a person must find in the picture, whatever the size and the state."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from io import StringIO
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rich.console import Console, RenderableType
from rich.text import Text

from hw.ports import AngleSource, Axis, Direction
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.faults import Fault, FaultKind, Missing, Notice
from rotator.links.wire import Wire
from rotator.orders import Mode
from rotator.status import AxisStatus, Status
from rotator.views import frame, terminal
from rotator.views.terminal import Surroundings
from rotator.views.words import RELEASE, RELEASE_FAULT

GLASS = ("SAT A:235 E:025 ", "SIM A:231 E:024 ")
AZIMUTH = AxisStatus(
    0, 450, angle_deg=231.26, raw=0.5125, target_deg=235.0, drive=Direction.PLUS, moving=True, starts=12
)
ELEVATION = AxisStatus(0, 180, angle_deg=24.04, raw=0.17, starts=3)
STATUS = Status(
    at_s=10.0,
    azimuth=AZIMUTH,
    elevation=ELEVATION,
    wanted_azimuth_deg=235,
    wanted_elevation_deg=25,
    simulated=True,
    controlled_by="gs232b#1",
)
STILL = Fault(FaultKind.STANDS_STILL, Axis.ELEVATION, "its motor runs up, but the angle stays at 24.0° (0.00°/s)")
OPEN = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
WELDED = Fault(FaultKind.RELAY_WELDED, Axis.AZIMUTH, "it turns", act_now="CUT MOTOR POWER!", cut=True)
CHIMNEY = Sector("the chimney", Range(100.0, 130.0), Range(0.0, 40.0), 2.0)
MOUNT = Mount(Range(0.0, 450.0), Range(0.0, 180.0), horizon=((0.0, 5.0), (180.0, 12.0)), sectors=(CHIMNEY,))


def gone(axis: AxisStatus, fault: Fault) -> AxisStatus:
    """Its pot is out: the last angle is kept, the latest reading is not one."""
    return replace(axis, seen=False, raw=0.0, target_deg=None, drive=Direction.OFF, moving=False, fault=fault)


ASLEEP = replace(
    STATUS,
    azimuth=replace(AZIMUTH, target_deg=None, drive=Direction.OFF, moving=False),
    wanted_azimuth_deg=None,
    wanted_elevation_deg=None,
    controlled_by="",
)
BOTH_OUT = replace(STATUS, azimuth=gone(AZIMUTH, OPEN), elevation=gone(ELEVATION, replace(OPEN, axis=Axis.ELEVATION)))
BARE = replace(AZIMUTH, angle_deg=None, target_deg=None, drive=Direction.OFF, missing=tuple(Missing)[:3])
STATES = {
    "no order": ASLEEP,
    "tracking": STATUS,
    "stopped": replace(ASLEEP, latched="console"),
    "one fault": replace(STATUS, elevation=replace(ELEVATION, fault=STILL)),
    "both faulted": BOTH_OUT,
    "both faulted and stopped": replace(BOTH_OUT, latched="the panel"),
    "relay welded": replace(STATUS, azimuth=replace(AZIMUTH, fault=WELDED)),
    "uncalibrated": replace(ASLEEP, azimuth=BARE, elevation=replace(ELEVATION, missing=(Missing.LIMITS,))),
    "storm park": replace(STATUS, latched="console: storm park", storm=True),
    "homing": replace(ASLEEP, azimuth=replace(ASLEEP.azimuth, homing=True, source=AngleSource.COUNTED)),
    "panel": replace(STATUS, mode=Mode.MANUAL, mode_switch=True),
    "long names": replace(
        STATUS,
        controlled_by="a-very-long-name-of-a-link-in-the-file#1234",
        notices=("orders from rotctld#17 are ignored: another program moves the antenna now " * 3,),
    ),
}
SIZES = [(40, 12), (80, 24), (132, 43), (200, 60), (80, 60), (60, 18), (250, 14)]


@pytest.fixture
def wires() -> list[Wire]:
    return [
        Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3", b"W235 025\r", b""),
        Wire("rotctld", "rotctld", "127.0.0.1:4533", "2 clients", b"p\n", b"231.26\n24.04\n"),
    ]


BUSY = [
    Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3", b"C2\r" * 21, b"AZ=231  EL=024\r\n" * 4),
    Wire("rotctld-in-the-shack", "rotctld", "a-very-long-host-name.of-somebody.example.org:4533", "128 clients"),
]
LOG = [f"12:00:{second:02d} W gs232b: refused {'long ' * 20}" for second in range(40)]


def on_screen(what: RenderableType, columns: int, rows: int) -> list[str]:
    """The lines that a terminal of this size shows."""
    screen = Console(file=StringIO(), width=columns, height=rows, force_terminal=True, legacy_windows=False)
    lines = screen.render_lines(what, pad=False)
    return ["".join(segment.text for segment in line) for line in lines]


def show(
    status: Status = STATUS,
    wires: Sequence[Wire] = (),
    log: Sequence[str] = (),
    size: tuple[int, int] = (88, 40),
    **around: Any,
) -> str:
    what = terminal.picture("0.1.0", status, GLASS, wires, log, around=Surroundings(**around))
    return "\n".join(on_screen(what, *size))


def words(picture: str) -> str:
    """The text without its frames, wherever a line was broken."""
    return " ".join(picture.translate(dict.fromkeys(map(ord, "│┃"), " ")).split())


def row(picture: str, name: str, nth: int = 0) -> str:
    return [line for line in picture.splitlines() if line.startswith(f"│ {name}")][nth]


# --- every size, every state


@pytest.mark.parametrize(("columns", "rows"), SIZES)
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("typed", ["", "> resume_  Enter does it"])
def test_keys_stop_faults_and_angles_are_there(columns: int, rows: int, state: str, typed: str) -> None:
    status = STATES[state]
    picture = show(status, BUSY, LOG, (columns, rows), typed=typed, mount=MOUNT, trail=[(200.0, 20.0)])
    whole_and_clear(picture, status, columns, rows)
    assert typed in picture


def whole_and_clear(picture: str, status: Status, columns: int, rows: int) -> None:
    seen = picture.splitlines()
    assert len(seen) <= rows
    assert {len(line) for line in seen} == {columns}
    assert [line[0] + line[-1] for line in seen] == ["╭╮", *["││"] * (len(seen) - 2), "╰╯"]
    assert "space STOP   q quit" in picture
    assert re.search(r"park.*resume", picture), "the words that move or release it"
    for fault in status.faults:
        assert f"{fault.axis.value}: {fault.name}"[:24] in picture
        assert fault.act_now in picture
    if status.latched:
        assert "STOPPED by" in picture or "STORM PARK by" in picture or "CUT MOTOR" in picture
        assert RELEASE in picture
    elif status.faults and not all(fault.passing for fault in status.faults):
        assert RELEASE_FAULT in picture
    for axis in Axis:
        each = status.axis(axis)
        angle = "---" if each.shown_deg is None else f"{round(each.shown_deg, 1) + 0.0:.1f}°"
        assert re.search(rf"(az|el|azimuth|elevation)\s+{re.escape(angle)}", picture), axis
        assert each.seen or each.drive or ("no signal" if each.shown_deg is None else "last seen") in picture


ANGLES = st.none() | st.floats(-20.0, 470.0)
TEXTS = st.text(st.characters(codec="ascii", exclude_categories=["C"]), min_size=1, max_size=60)


@st.composite
def axes(draw: st.DrawFn, axis: Axis) -> AxisStatus:
    kind = draw(st.none() | st.sampled_from(FaultKind))
    return AxisStatus(
        draw(st.sampled_from([-180.0, 0.0, 10.0])),
        draw(st.sampled_from([90.0, 180.0, 360.0, 450.0, 540.0])),
        angle_deg=draw(ANGLES),
        target_deg=draw(ANGLES),
        drive=draw(st.sampled_from(Direction)),
        seen=draw(st.booleans()),
        missing=draw(st.sampled_from([(), (Missing.HOMING,), tuple(Missing)])),
        fault=Fault(kind, axis, draw(TEXTS), passing=draw(st.booleans())) if kind else None,
        notices=tuple(map(Notice, draw(st.lists(TEXTS, max_size=3)))),
        noise_deg=0.0,
        starts=draw(st.none() | st.integers(0, 999)),
    )


@given(
    st.integers(40, 250),
    st.integers(12, 80),
    axes(Axis.AZIMUTH),
    axes(Axis.ELEVATION),
    st.sampled_from(["", "console", "rotctld#12"]),
    st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_any_status_at_any_size(  # noqa: PLR0917 - hypothesis fills them in
    columns: int, rows: int, azimuth: AxisStatus, elevation: AxisStatus, latched: str, masked: bool
) -> None:
    status = replace(STATUS, azimuth=azimuth, elevation=elevation, latched=latched)
    picture = show(status, BUSY, LOG, (columns, rows), mount=MOUNT if masked else None)
    whole_and_clear(picture, status, columns, rows)


# --- one glance


def test_where_it_is_where_it_should_be_and_by_how_much_it_is_off() -> None:
    picture = show()
    assert re.match(r"│ azimuth +231\.3° ▕█+", row(picture, "azimuth"))
    assert re.match(r"│ target +235\.0° ▕█+", row(picture, "target"))
    assert re.match(r"│ off by +\+3\.7° ", row(picture, "off by"))
    assert "3.4° off target on the sky" in picture
    assert re.match(r"│ target +--- ▕ ", row(picture, "target", 1))
    narrow = show(size=(40, 12))
    assert "az 231.3° → 235.0° off +3.7° CW" in narrow
    assert "el 24.0° " in narrow


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
    assert "●" not in show(ASLEEP)
    changed: Any = {axis.value: replace(ASLEEP.axis(axis), drive=drive)}
    picture = show(replace(ASLEEP, **changed))
    assert picture.count("●") == 1
    assert lit + " " in picture
    assert picture.count("○") == 3


@pytest.mark.parametrize(
    ("state", "said"),
    [
        ("no order", "AT REST no orders"),
        ("tracking", "TURNING SAT A:235 E:025 orders from gs232b#1 (run/gs232)"),
        ("stopped", "STOPPED by console"),
        ("one fault", "FAULT elevation"),
        ("both faulted and stopped", "STOPPED by the panel"),
        ("relay welded", "CUT MOTOR POWER!"),
        ("uncalibrated", "UNCALIBRATED azimuth and elevation"),
        ("storm park", "STORM PARK by console"),
        ("homing", "HOMING azimuth: turns to its end stop"),
        ("panel", "The panel's switch is at MANUAL"),
    ],
)
def test_what_it_does_and_who_says_so(state: str, said: str, wires: list[Wire]) -> None:
    picture = words(show(STATES[state], wires))
    if state == "no order":
        said = "AT REST SAT A:235 E:025 no orders"
    assert said in re.sub(r"[┏┓━]+ ?", "", picture)


def test_a_list_says_at_which_point_it_is() -> None:
    assert "orders from gs232b#1, point 3 of 12" in show(replace(STATUS, timed_point=3, timed_points=12))


def test_on_target() -> None:
    there = replace(STATUS, azimuth=replace(AZIMUTH, angle_deg=234.6, drive=Direction.OFF, moving=False))
    assert "ON TARGET" in show(there)


def test_motor_starts_in_this_pass_where_relays_start_them() -> None:
    assert "motor starts in this pass: azimuth 12, elevation 3" in show()
    moteus = {axis.value: replace(STATUS.axis(axis), starts=None) for axis in Axis}
    assert "motor starts" not in show(replace(STATUS, **moteus))  # type: ignore[arg-type]


def test_without_a_reading_the_angle_is_the_last_one_seen() -> None:
    picture = show(BOTH_OUT)
    assert picture.count("last seen") == 2
    assert "0.0000" not in picture


def test_the_angle_s_source() -> None:
    counted = replace(STATUS, azimuth=replace(AZIMUTH, source=AngleSource.COUNTED))
    assert "counted" in row(show(counted), "off by")


# --- what else it shows


def test_the_display_as_it_looks() -> None:
    upper, lower = (line for line in show().splitlines() if "A:" in line)
    assert GLASS[0] in upper
    assert GLASS[1] in lower


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


@pytest.mark.parametrize(("columns", "rows"), SIZES)
@pytest.mark.parametrize("state", ["tracking", "both faulted and stopped"])
def test_a_link_that_is_out_is_named_at_every_size(columns: int, rows: int, state: str) -> None:
    """In the table where all links have room, in a line of its own elsewhere."""
    gone = Wire("usb", "gs232b", "/dev/ttyUSB0", "waiting for it")
    picture = show(STATES[state], [*BUSY, gone], LOG, (columns, rows))
    assert "3 links, out: usb" in picture or ("usb " in picture and "waiting" in picture)
    whole_and_clear(picture, STATES[state], columns, rows)


def test_on_a_small_terminal_their_number_is_told(wires: list[Wire]) -> None:
    assert "2 links, none out" in show(wires=wires, size=(40, 12))
    assert "2 links" not in show(wires=wires, size=(80, 24))


def test_bytes_that_are_no_text_are_escaped(wires: list[Wire]) -> None:
    wires[0].last_in = b"\x00\x1b[2J\xff"
    picture = show(wires=wires)
    assert r"\x00\x1b[2J\xff" in picture
    assert "\x1b" not in picture


def test_simulated_is_said_in_the_title() -> None:
    assert "SIMULATED" in show().splitlines()[0]
    assert "SIMULATED" not in show(replace(STATUS, simulated=False))


def test_a_fault_says_everything_and_what_to_do() -> None:
    picture = words(show(STATES["one fault"]))
    assert str(STILL) in picture
    assert "Check the motor's fuse and supply" in picture
    passing = replace(STATUS, elevation=replace(ELEVATION, fault=replace(STILL, passing=True)))
    assert "This ends by itself when the cause is gone." in show(passing)


def test_uncalibrated_says_what_is_missing_and_what_the_sensor_reads() -> None:
    picture = words(show(STATES["uncalibrated"]))
    assert "azimuth UNCALIBRATED: it needs calibration, limits, direction check (its sensor reads 0.5125)" in picture


def test_orders_without_effect_are_shown_with_the_reason() -> None:
    ignored = "orders from rotctld#1 are ignored: gs232b#1 has stopped the antenna; orders count again after a pause"
    assert ignored in words(show(replace(STATUS, notices=(ignored,))))


def test_log_and_keys() -> None:
    picture = show(log=["12:00:00 W gs232b: refused"])
    assert "12:00:00 W gs232b: refused" in picture
    for key in ("space STOP", "q quit", "park + Enter: storm park", "resume + Enter: go on"):
        assert key in picture


# --- what a larger terminal gains, and what a simple one can show


def test_a_wide_terminal_gains_longer_bars_and_the_sky() -> None:
    assert "◆" not in show(size=(80, 24))
    wide, wider = show(size=(132, 43)), show(size=(200, 60))
    for picture in (wide, wider):
        assert "◆ antenna" in picture
        assert len(re.findall("[◆◈]", picture)) == 2, "the antenna in the sky, and in the legend"
    assert row(wider, "azimuth").count("█") > row(wide, "azimuth").count("█")


def test_a_high_terminal_gains_the_sky_below_and_more_of_the_log() -> None:
    picture = show(log=LOG[:2], size=(80, 60))
    assert "◆ antenna" in picture
    assert show(log=LOG, size=(80, 60)).count("refused") > show(log=LOG, size=(80, 40)).count("refused")


@pytest.mark.parametrize("size", SIZES)
def test_plain_characters_have_the_same_places(size: tuple[int, int]) -> None:
    around: dict[str, Any] = {"mount": MOUNT, "trail": [(0.0, 0.0), (10.0, 30.0)]}
    fine, plain = (show(STATUS, BUSY, size=size, ascii_only=only, **around) for only in (False, True))
    assert not set(plain) - {chr(code) for code in range(128)} - set("°\n")
    letters = re.compile(r"[A-Z0-9a-np-z°]")
    assert [letters.findall(line) for line in plain.splitlines()[1:5]] == [
        letters.findall(line) for line in fine.splitlines()[1:5]
    ]


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
    picture = "\n".join(on_screen(terminal.sketch_picture(GLASS, (-1, 1), wires[:1]), 80, 24))
    for word in (*GLASS, "● CCW", "● UP", "○ CW", "○ DOWN", "F1EFW sketch", "SIMULATED", "q quit"):
        assert word in picture
