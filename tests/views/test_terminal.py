"""The box in a terminal: where it points, where it should, who says so, what is wrong, and what else it shows."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.links.wire import Wire
from tests.tables import every_row
from tests.views.screens import (
    ASLEEP,
    AZIMUTH,
    BOTH_OUT,
    BUSY,
    ELEVATION,
    GLASS,
    LOG,
    SIZES,
    STATES,
    STATUS,
    STILL,
    row,
    show,
)
from tests.views.test_terminal_sizes import whole_and_clear


def words(picture: str) -> str:
    """The text without its frames, wherever a line was broken."""
    return " ".join(picture.translate(dict.fromkeys(map(ord, "│┃"), " ")).split())


# --- one glance


def test_where_it_is_where_it_should_be_and_by_how_much_it_is_off() -> None:
    picture = show()
    assert re.match(r"│ azimuth +231\.3° ▕█+", row(picture, "azimuth"))
    assert re.match(r"│ target +235\.0° ▕█+", row(picture, "target"))
    assert re.match(r"│ off by +\+3\.7° ", row(picture, "off by"))
    assert "3.4° off target on the sky" in picture
    assert re.match(r"│ target +--- ▕ ", row(picture, "target", 1))
    narrow = show(size=(40, 12))
    assert "az 231.3° → 235.0° +3.7° CW measured" in narrow
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
        ("tracking", "TURNING SAT A:235 E:025 orders from gs232b (run/gs232)"),
        ("stopped", "STOPPED by the keyboard"),
        ("one fault", "FAULT elevation"),
        ("both faulted and stopped", "STOPPED by the panel"),
        ("relay welded", "CUT MOTOR POWER!"),
        ("uncalibrated", "UNCALIBRATED azimuth and elevation"),
        ("storm park", "STORM PARK by the keyboard"),
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
    assert "orders from gs232b, point 3 of 12" in show(replace(STATUS, timed_point=3, timed_points=12))


def test_an_axis_that_has_lost_its_order_is_not_on_target() -> None:
    """As after a fault that a person has acknowledged: only the other axis goes on."""
    lost = replace(AZIMUTH, target_deg=None, drive=Direction.OFF, moving=False)
    there = replace(ELEVATION, angle_deg=24.8, target_deg=25.0)
    picture = words(show(replace(STATUS, azimuth=lost, elevation=there)))
    assert "ELEVATION ON TARGET, AZIMUTH AT REST" in picture


def test_motor_starts_in_this_pass_where_relays_start_them() -> None:
    assert "motor starts in this pass: azimuth 12, elevation 3" in show()
    moteus = {axis.value: replace(STATUS.axis(axis), starts=None) for axis in Axis}
    assert "motor starts" not in show(replace(STATUS, **moteus))  # type: ignore[arg-type]


def test_without_a_reading_the_angle_is_the_last_one_seen() -> None:
    picture = show(BOTH_OUT)
    assert picture.count("last seen") == 2
    assert "0.0000" not in picture


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


@every_row(("columns", "rows"), SIZES)
@every_row("state", ["tracking", "both faulted and stopped"])
def test_a_link_that_is_out_is_named_at_every_size(columns: int, rows: int, state: str) -> None:
    """In the table where all links have room, in a line of its own elsewhere."""
    gone = Wire("usb", "gs232b", "/dev/ttyUSB0", "waiting for it")
    picture = show(STATES[state], [*BUSY, gone], LOG, (columns, rows))
    assert "3 links, out: usb" in picture or ("usb " in picture and "waiting" in picture)
    whole_and_clear(picture, STATES[state], columns, rows)


def test_on_a_small_terminal_their_number_is_told(wires: list[Wire]) -> None:
    assert "2 links, all ready" in show(wires=wires, size=(40, 12))
    assert "2 links" not in show(wires=wires, size=(80, 24))


def test_bytes_that_are_no_text_are_escaped(wires: list[Wire]) -> None:
    wires[0].last_in = b"\x00\x1b[2J\xff"
    picture = show(wires=wires)
    assert r"\x00\x1b[2J\xff" in picture
    assert "\x1b" not in picture


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


def test_what_stands_as_a_note_has_no_second_line_in_the_log() -> None:
    why = "orders from rotctld are ignored: stopped by {}: nothing moves until resume"
    picture = words(
        show(
            replace(ASLEEP, latched="console#3", notices=(why.format("console#3"),)),
            log=["04:05:06 W " + why.format("a rotator command"), "04:05:01 I rotctld#2 moves the antenna"],
        )
    )
    assert picture.count(why.format("a rotator command")) == 1
    assert "rotctld#2 moves the antenna" in picture


def test_log_keys_and_whether_it_is_simulated() -> None:
    picture = show(log=["12:00:00 W gs232b: refused"])
    assert "SIMULATED" in picture.splitlines()[0]
    assert "SIMULATED" not in show(replace(STATUS, simulated=False))
    assert "12:00:00 W gs232b: refused" in picture
    for key in ("space STOP", "q quit", "park + Enter: storm park", "resume + Enter: go on"):
        assert key in picture


@every_row("size", [(40, 12), (60, 16), (80, 24), (200, 50)])
@every_row("drive", Direction)
def test_what_an_angle_is_worth_stands_beside_the_lamps(size: tuple[int, int], drive: Direction) -> None:
    """An angle that was last seen is never called measured, whichever relay is on; a healthy one says its source."""
    out = replace(BOTH_OUT, azimuth=replace(BOTH_OUT.azimuth, drive=drive))
    picture = show(out, size=size)
    assert picture.count("last seen") == 2
    assert "measured" not in picture
    assert size[0] < 80 or "CW" in picture
    for source in AngleSource:
        healthy = replace(STATUS, azimuth=replace(STATUS.azimuth, drive=drive, source=source))
        assert re.search(rf"{source.value[:4]}", show(healthy, size=size))


@every_row("size", [(40, 12), (60, 16), (80, 24), (200, 50)])
def test_an_angle_that_is_reckoned_by_time_says_so_and_how_far_it_may_be_off(size: tuple[int, int]) -> None:
    azimuth = replace(STATUS.azimuth, source=AngleSource.MODELLED, angle_deg=137.04, error_deg=5.3)
    picture = show(replace(STATUS, azimuth=azimuth), size=size)
    assert "≈137.0°" in picture
    assert "± 6°" in picture
    assert "± ?" in show(replace(STATUS, azimuth=replace(azimuth, error_deg=math.inf)), size=size)
